#include "view/viewer/panels/hints.h"

#include <algorithm>

#include "palpate/view/orbit.h"

namespace palpate::viewer {

namespace {

constexpr std::size_t kFinger = 0;
constexpr double kComesS = 1.0;
constexpr double kPressesS = 3.0;
constexpr double kLeavesS = 0.6;
constexpr double kComesFromMm = 90.0;  ///< from the right
/// Next to the spinous process of T6, in the map plane.
const Vec2 kBesideT6(24.0, 38.0);

std::optional<SkinPlace> skinOver(const scene::World& world, const Vec2& place) {
  const double top = mesh::boundingBox(world.body->skin).max().z() + 1.0;
  return view::skinAlong(world.surface, {Vec3(place.x(), place.y(), top), -Vec3::UnitZ()});
}

double eased(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}  // namespace

void Intro::begin(const scene::World& world, double now_s) {
  const Vec3 middle = mesh::boundingBox(world.body->skin).center();
  const Vec2 wanted = world.body->anatomy.bones.empty() ? Vec2(middle.x(), middle.y()) : kBesideT6;
  const auto place = skinOver(world, wanted);
  running_ = place.has_value();
  if (place) goal_ = place->point;
  began_s_ = now_s;
}

void Intro::end(Pointer& pointer) {
  if (!running_) return;
  running_ = false;
  pointer.reset();
}

void Intro::advance(Pointer& pointer, const scene::World& world, double now_s) {
  if (!running_) return;
  const double t = now_s - began_s_;
  if (t > kComesS + kPressesS + kLeavesS) return end(pointer);
  const double away = kComesFromMm * (1.0 - eased(t / kComesS));
  const auto place = skinOver(world, {goal_.x() + away, goal_.y()});
  if (place) pointer.demonstrate(kFinger, *place, t > kComesS && t < kComesS + kPressesS);
}

}  // namespace palpate::viewer
