// A close view from beside the finger, in the lower left of the picture: how deep it presses is seen while the whole
// body is. It follows the finger that presses deepest.
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

/// Nothing where the look shows none, no finger is there or the page is too small for one.
std::optional<LensPlace> lensPlace(const Look& look, std::span<const FingerMark> fingers, const Vec2f& page);

/// What it shows of the deepest finger: out of the skin is up. `camera` is that of the picture.
Frustum lensFrustum(std::span<const FingerMark> fingers, const Camera& camera, double aspect);

}  // namespace palpate::view
