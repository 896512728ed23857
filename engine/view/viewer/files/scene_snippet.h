// The present state as text, for mails, notes, bug reports: as a scene file, and the camera as a line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/view/camera.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

/// The scene with all changes, the look and the camera. Fingers in contact replace the scene's own, each with a script
/// that presses where and as deep as it does now; a comment has its output.
std::string sceneSnippet(const EditedScene& edited, const BodyView& seen);

// A camera as a line of text, so that a view can be mailed, kept in notes and pasted back.

/// "palpate-view x y z yaw_deg pitch_deg distance_mm height_deg", in mm and degrees.
std::string viewAsText(const view::Camera& camera);

/// Empty for any other text, and for numbers that no camera has: they are not finite, the distance is not positive, the
/// pitch reaches straight up or down.
std::optional<view::Camera> viewFromText(std::string_view text);

}  // namespace palpate::viewer
