// Modes that other products add to the window of `palpate run`, each with its options.
#pragma once

#include <functional>
#include <memory>

#include "cli/kit/options.h"
#include "view/viewer/modes/mode.h"

namespace palpate::app {

/// Makes a mode, once the command line has been read.
using ModeMaker = std::function<std::unique_ptr<viewer::Mode>()>;
/// Adds the mode's options to `palpate run`.
using OfferedMode = ModeMaker (*)(Command& command);
/// Call before the commands are added; once per mode.
void offerRunMode(OfferedMode mode);

}  // namespace palpate::app
