#include "palpate/view/overlays/sink_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

constexpr int kSinkRingPoints = 40;
/// Above the skin, so that the lines do not sink in, mm.
constexpr double kSinkLiftMm = 1.0;
/// Search range above the skin, mm: a back is flat enough under a ring.
constexpr double kOutsideMm = 60.0;

constexpr Paint kRingPaint{255, 255, 255, 255};
constexpr Paint kInnerPaint{255, 255, 255, 190};
constexpr Paint kRimPaint{18, 20, 26, 200};

std::vector<Vec3> circleOn(const scene::World& world, const contact::FingerOutput& finger, double radius_mm) {
  const Vec3 u = finger.normal.unitOrthogonal();
  const Vec3 v = finger.normal.cross(u);
  std::vector<Vec3> path;
  for (int i = 0; i <= kSinkRingPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSinkRingPoints;
    const Vec3 flat = finger.proxy + radius_mm * (std::cos(angle) * u + std::sin(angle) * v);
    const Vec3 outside = kOutsideMm * finger.normal;
    const tree::Crossing skin = tree::firstFrontCrossing(world.surface.geometry->tree, flat + outside, flat - outside);
    path.push_back((skin.triangle == kNoIndex ? flat : skin.point) + kSinkLiftMm * finger.normal);
  }
  return path;
}

}  // namespace

double sinkRadius(double depth_mm) { return kSinkRimMm + kSinkOpensMm * std::min(depth_mm, 1.0 * kMaxSinkRings); }

std::vector<Lines> sinkRings(const scene::World& world, const contact::FingerOutput& finger) {
  if (finger.touch == contact::Touch::free || !(finger.depth_mm > 0.0)) return {};
  Lines rim{4.4, {}};
  Lines bold{2.4, {}};
  Lines inner{1.2, {}};
  const std::vector<Vec3> outside = circleOn(world, finger, sinkRadius(finger.depth_mm));
  rim.addPath(outside, kRimPaint);
  bold.addPath(outside, kRingPaint);
  const int whole = std::min(kMaxSinkRings, static_cast<int>(std::floor(finger.depth_mm)));
  for (int mm = 0; mm <= whole; ++mm) inner.addPath(circleOn(world, finger, sinkRadius(mm)), kInnerPaint);
  return {std::move(inner), std::move(rim), std::move(bold)};
}

}  // namespace palpate::view
