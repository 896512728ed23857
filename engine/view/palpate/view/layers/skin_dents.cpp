#include "palpate/view/layers/skin_dents.h"

#include <algorithm>

#include "palpate/scene/skin_contact.h"
#include "palpate/scene/world.h"

namespace palpate::view {

namespace {

/// Half axes of a press's region between which it stops being a dent and becomes a body that gives way, mm. For a half
/// Gaussian; layers keep a press local.
constexpr double kWidestDentMm = 50.0;
constexpr double kNoDentMm = 100.0;
/// Beyond the finger's own radius, this far from a press the dent is too shallow to be seen, mm.
constexpr double kDentReachMm = 55.0;

/// A drag is taken out of the way only while this much of the normal remains (cosine).
constexpr double kStillAlong = 0.9;

/// The direction nearest to a press's normal along which no drag moves anything: its own above all, which over a curved
/// body has a share of the normal too, then those of the other fingers.
Vec3 dentDirection(const deform::Contact& press, std::span<const deform::Contact> all) {
  const Vec3 normal = press.normal.normalized();
  Vec3 way = normal;
  Vec3 own = Vec3::Zero();
  const auto leaveOut = [&](const Vec3& drag) {
    const Vec3 along = drag - own.dot(drag) * own;
    if (along.norm() < 1e-6) return;
    const Vec3 unit = along.normalized();
    const Vec3 without = (way - way.dot(unit) * unit).normalized();
    if (without.dot(normal) < kStillAlong) return;
    way = without;
    if (own.isZero()) own = unit;
  };
  leaveOut(press.drag_mm);
  for (const deform::Contact& other : all) leaveOut(other.drag_mm);
  return way;
}

SkinDent dentOf(const deform::Contact& press, const Vec3& place, const Vec3& way, double radius_mm) {
  const double half_axis_mm = press.normal_region.half_major.norm();
  const double wide = (half_axis_mm - kWidestDentMm) / (kNoDentMm - kWidestDentMm);
  const double share = press.layered ? 1.0 : 1.0 - std::clamp(wide, 0.0, 1.0);
  return {place.cast<float>(), way.cast<float>(), static_cast<float>(std::min(half_axis_mm, kDentReachMm + radius_mm)),
          static_cast<float>(share)};
}

}  // namespace

std::vector<SkinDent> collectDents(std::span<const FingerMark> fingers, const scene::World& world, double lift_mm) {
  std::vector<deform::Contact> presses;
  std::vector<double> radii_mm;
  for (const FingerMark& finger : fingers) {
    auto press = scene::contactOf(world, finger.contact);
    if (!press) press = scene::dentOf(world, finger.contact);
    if (!press) continue;
    presses.push_back(*press);
    radii_mm.push_back(finger.radius_mm);
  }
  std::vector<SkinDent> dents;
  for (std::size_t i = 0; i < presses.size(); ++i) {
    const Vec3& anchor = presses[i].anchor;
    const Vec3 place = world.breath ? world.breath->rest(anchor, lift_mm) : anchor;
    dents.push_back(
        dentOf(presses[i], place - world.deformable->origin, dentDirection(presses[i], presses), radii_mm[i]));
  }
  return dents;
}

}  // namespace palpate::view
