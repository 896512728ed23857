// A recorded session as the window plays it: what was felt, on the body it was felt on, with its marks.
//
//   NAME.session ─ read beside the display ─► RecordedTouch ─► frozen picture, plots, marks on the bar
#pragma once

#include <filesystem>

#include "view/viewer/files/recorded_touch.h"

namespace palpate::viewer {

/// The newest part of it that is no longer than kLongestReplayS and was felt on one body, as it was recorded: nothing
/// is computed but the body. Throws Error when the file cannot be read or the body not be built.
RecordedTouch touchOfSession(const std::filesystem::path& file);

}  // namespace palpate::viewer
