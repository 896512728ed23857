// What is seen and felt at this moment as text, for mails, notes, bug reports: as a scene file, and the camera as a
// line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/view/camera.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

/// The scene with all changes, the look and the camera. Fingers that touch take the place of the scene's own, each with
/// a script that presses where it is as deep as it is now; what it felt stands in a comment.
std::string sceneSnippet(const ViewerState& viewer);

// A camera as a line of text, so that a view can be mailed, kept in notes and pasted back.

/// "palpate-view x y z yaw_deg pitch_deg distance_mm height_deg", in mm and degrees.
std::string viewAsText(const view::Camera& camera);

/// Nothing for any other text, and for numbers that no camera has: they are not finite, the distance is not positive,
/// the pitch reaches straight up or down.
std::optional<view::Camera> viewFromText(std::string_view text);

}  // namespace palpate::viewer
