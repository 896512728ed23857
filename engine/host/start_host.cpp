// palpate::palpate compiles this into each program that links the installed package: such a program has files and
// threads before its main begins. The programs of this project call installHost themselves.
#include "palpate/scene/host.h"

namespace {

[[maybe_unused]] const bool kInstalled = (palpate::installHost(), true);

}  // namespace
