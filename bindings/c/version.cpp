// Which library was loaded.
#include "palpate.h"

const char* palpate_version() noexcept { return PALPATE_VERSION; }
