// The eye is on the side away from the finger, a little above the skin; the near plane cuts away anything between it
// and the finger.
#include "palpate/view/overlays/lens.h"

#include <algorithm>
#include <cmath>

#include "palpate/view/overlays/section.h"

namespace palpate::view {

namespace {

constexpr float kLensMargin = 14.0f;
/// The scale bar is below.
constexpr float kLensFoot = 46.0f;
/// Smaller pages have no room next to the finger.
constexpr float kSmallestPage = 300.0f;
constexpr double kShownMm = 84.0;  ///< width of the view
constexpr double kLensEyeMm = 300.0;
/// Distance of the near plane: a shoulder may be before the finger. The foot of the lens is 110 mm nearer than the
/// finger.
constexpr double kLensNearMm = 120.0;
constexpr double kLensFarMm = 1500.0;
/// The eye's height over the skin: enough to see into the dent, even near a shoulder blade.
constexpr double kAboveRad = 0.62;

/// Along the skin, away from the side that the finger comes from.
Vec3 acrossFrom(const FingerMark& finger, const Vec3& normal, const Camera& camera) {
  Vec3 right = Vec3::UnitY().cross(normal);
  constexpr double kMin = 0.1;
  if (right.norm() < kMin) right = camera.right() - camera.right().dot(normal) * normal;
  return (finger.left ? 1.0 : -1.0) * right.normalized();
}

}  // namespace

std::optional<LensPlace> lensPlace(const Look& look, std::span<const FingerMark> fingers, const Vec2f& page) {
  if (!look.lens || sectionFinger(fingers) == nullptr || page.minCoeff() < kSmallestPage) return std::nullopt;
  LensPlace place;
  place.size.x() = std::round(std::clamp(0.24f * page.x(), 160.0f, 340.0f));
  place.size.y() = std::round(0.72f * place.size.x());
  place.corner = {kLensMargin, page.y() - place.size.y() - kLensFoot};
  return place;
}

Frustum lensFrustum(std::span<const FingerMark> fingers, const Camera& camera, double aspect) {
  const FingerMark& finger = *sectionFinger(fingers);
  const bool touches = finger.contact.touch != contact::Touch::free;
  const Vec3 middle = touches ? finger.contact.proxy : finger.contact.tip;
  const Vec3 normal = touches ? finger.contact.normal : camera.backward();
  const Vec3 backward = std::cos(kAboveRad) * acrossFrom(finger, normal, camera) + std::sin(kAboveRad) * normal;
  const Vec3 right = normal.cross(backward).normalized();
  const Vec3 up = backward.cross(right);
  const Vec3 half_width = 0.5 * kShownMm * right;
  const Vec3 half_height = 0.5 * kShownMm / aspect * up;
  // The finger is above the skin: more room there.
  const Vec3 centre = middle + 0.25 * half_height;
  const Screen screen{centre - half_width - half_height, centre + half_width - half_height,
                      centre - half_width + half_height};
  return makeFrustum(screen, centre + kLensEyeMm * backward, kLensNearMm, kLensFarMm);
}

}  // namespace palpate::view
