// A camera as a line of text, so that a view can be mailed, kept in notes and pasted back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/view/camera.h"

namespace palpate::viewer {

/// "palpate-view x y z yaw_deg pitch_deg distance_mm height_deg", in mm and degrees.
std::string viewAsText(const view::Camera& camera);

/// Nothing for any other text, and for numbers that no camera has: they are not finite, the distance is not positive,
/// the pitch reaches straight up or down.
std::optional<view::Camera> viewFromText(std::string_view text);

}  // namespace palpate::viewer
