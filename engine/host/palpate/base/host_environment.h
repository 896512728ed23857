// Files and threads for the core (environment.h). Programs call installHost (scene/host.h), which brings them too.
#pragma once

#include "palpate/base/environment.h"

namespace palpate {

/// Before any other thread runs.
void installHostEnvironment();

}  // namespace palpate
