// Where the commands of training find a class over the network.
#pragma once

#include "palpate/training/session/class_part.h"

namespace palpate::app {

/// By a program that has the network, before any command runs.
void installClassPart(const training::ClassPart& part);

/// What was installed. Where nothing was, this process becomes the program of `palpate class`, which goes on with the
/// words that were typed. Throws Error, which says which package is missing.
const training::ClassPart& classPart();

}  // namespace palpate::app
