// A close view of the finger from the side, in the lower left of the picture: it shows the depth while the whole body
// is in view. It follows the finger that presses deepest.
#pragma once

#include <optional>
#include <span>

#include "palpate/view/camera.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/look.h"

namespace palpate::view {

/// A rectangle of the page, points; `corner` is its upper left.
struct LensPlace {
  Vec2f corner, size;
};

/// Empty where the look has none, without a finger, or on too small a page.
std::optional<LensPlace> lensPlace(const Look& look, std::span<const FingerMark> fingers, const Vec2f& page);

/// The view of the deepest finger: out of the skin is up. `camera` is that of the picture.
Frustum lensFrustum(std::span<const FingerMark> fingers, const Camera& camera, double aspect);

}  // namespace palpate::view
