#include "view/viewer/editing/pointer.h"

#include <algorithm>
#include <cmath>

#include "view/viewer/state/home_view.h"

namespace palpate::viewer {

namespace {

using Kind = window::Command::Kind;

constexpr double kRingStepMm = 2.0;
constexpr double kFineRingStepMm = 0.2;
constexpr double kCentreFlightS = 0.2;
/// A finger that slides off the skin's outline follows the nearest skin within this, mm.
constexpr double kEdgeReachMm = 60.0;
/// A hand resting on the mouse moves it by less, pixels.
constexpr double kAtRestPixels = 6.0;
/// Force at which a resisting cursor moves half as fast, N.
constexpr double kHalfSpeedN = 8.0;

}  // namespace

void Pointer::look(const PickScreen& screen, std::shared_ptr<const scene::World> world) {
  screen_ = screen;
  world_ = std::move(world);
}

void Pointer::reset() {
  for (Finger& finger : fingers_) finger = {};
}

view::Ray Pointer::rayAt(const Vec2& pixel) const {
  const Vec2 place = view::placeInEye(screen_.stereo, pixel.cwiseQuotient(screen_.size));
  return view::rayThrough(screen_.screen, screen_.eye, place.x(), place.y());
}

std::optional<SkinPlace> Pointer::skinAt(const Vec2& pixel) const {
  if (!world_) return std::nullopt;
  return view::skinAlong(world_->surface, rayAt(pixel));
}

/// Past the outline a pressed finger continues along the nearest skin instead of stopping dead.
void Pointer::moveFinger(std::size_t finger, const Vec2& pixel) {
  auto place = skinAt(pixel);
  Finger& moved = fingers_[finger];
  moved.mouse_at_rest.reset();
  moved.named = false;
  if (!place && moved.pressed && moved.place) {
    const view::Ray ray = rayAt(pixel);
    const double along = (moved.place->point - ray.origin).dot(ray.direction);
    place = view::skinNear(world_->surface, ray.origin + along * ray.direction, kEdgeReachMm);
  }
  if (place) moved.place = place;
}

void Pointer::hover(std::size_t finger, const Vec2& pixel) {
  mouse_ = pixel;
  const Finger& hovering = fingers_[finger];
  if (hovering.pressed) return;  // it stays where it was placed
  if (hovering.mouse_at_rest && (pixel - *hovering.mouse_at_rest).norm() < kAtRestPixels) return;
  moveFinger(finger, pixel);
}

void Pointer::press(Finger& finger) { finger.pressed = finger.fresh = finger.place.has_value(); }

Vec3 Pointer::pivotAt(const Vec2& pixel, const view::Camera& camera) const {
  const auto place = skinAt(pixel);
  return place ? place->point : camera.centre;
}

void Pointer::deepen(TouchSettings& touch, double notches) {
  if (touch.by == device::PressBy::force) {
    touch.force_n = std::clamp(touch.force_n + notches * kForcePerNotchN, 0.0, kMaxForceN);
  } else {
    touch.depth_mm = std::clamp(touch.depth_mm + notches * kDepthPerNotchMm, 0.0, kMaxDepthMm);
  }
}

bool Pointer::apply(const window::Command& command, BodyView& seen, double now_s) {
  return applyToFinger(command, seen) || applyToCamera(command, seen, now_s);
}

bool Pointer::applyToFinger(const window::Command& command, BodyView& seen) {
  const std::size_t active = seen.active_finger;
  switch (command.kind) {
    case Kind::hover:
      hover(active, command.at);
      return true;
    case Kind::press:
      moveFinger(active, command.at);
      press(fingers_[active]);
      return true;
    case Kind::hold:
      // To the present place under the mouse: the body may have been turned.
      if (!command.over_gui && !fingers_[active].mouse_at_rest) moveFinger(active, command.at);
      press(fingers_[active]);
      return true;
    case Kind::slide:
      moveFinger(active, command.at);
      return true;
    case Kind::lift:
      fingers_[active].pressed = false;
      fingers_[active].tapped = fingers_[active].fresh;
      return true;
    case Kind::lift_all:
      for (Finger& finger : fingers_) finger.pressed = false;
      return true;
    case Kind::take_finger:
      // The other finger keeps its target depth.
      fingers_[active].depth_mm = seen.state.touch.depth_mm;
      fingers_[active].force_n = seen.state.touch.force_n;
      seen.active_finger = command.finger;
      return true;
    case Kind::deepen: {
      const double force = seen.fingers[active].force.norm();
      const bool resists = seen.state.touch.resisting_cursor && command.amount != std::round(command.amount);
      deepen(seen.state.touch, command.amount / (resists ? 1.0 + force / kHalfSpeedN : 1.0));
      return true;
    }
    default:
      return false;
  }
}

bool Pointer::applyToCamera(const window::Command& command, BodyView& seen, double now_s) {
  view::Camera& camera = seen.camera;
  switch (command.kind) {
    case Kind::grab:
      flight_.reset();
      pivot_ = pivotAt(command.at, camera);
      return true;
    case Kind::orbit:
      camera = view::orbited(camera, pivot_, command.by, screen_.size.y());
      seen.opened.camera_moved = true;
      return true;
    case Kind::pan:
      camera = view::panned(camera, pivot_, command.by, screen_.size.y());
      seen.opened.camera_moved = true;
      return true;
    case Kind::zoom:
      flight_.reset();
      camera = view::zoomed(camera, pivotAt(command.at, camera), command.amount);
      seen.opened.camera_moved = true;
      return true;
    case Kind::centre:
      if (const auto place = skinAt(command.at))
        fly(centredInFreePart(camera, place->point, seen.state.shown, seen.size_points), seen, now_s, kCentreFlightS);
      seen.opened.camera_moved = true;
      return true;
    default:
      return false;
  }
}

bool Pointer::step(window::Action action, bool fine, const BodyView& seen) {
  using window::Action;
  Vec3 direction;
  const view::Camera& camera = seen.camera;
  switch (action) {
    case Action::ring_left:
      direction = -camera.right();
      break;
    case Action::ring_right:
      direction = camera.right();
      break;
    case Action::ring_up:
      direction = camera.up();
      break;
    case Action::ring_down:
      direction = -camera.up();
      break;
    default:
      return false;
  }
  Finger& finger = fingers_[seen.active_finger];
  if (!finger.place) finger.place = skinAt(0.5 * screen_.size);
  if (!finger.place || !world_) return true;
  const Vec3 wanted = finger.place->point + (fine ? kFineRingStepMm : kRingStepMm) * direction;
  const Vec3 towards = (wanted - screen_.eye).normalized();
  // Along the line of sight, as the mouse would; behind an outline to the nearest skin.
  auto place = view::skinAlong(world_->surface, {screen_.eye, towards});
  if (!place || (place->point - wanted).norm() > kEdgeReachMm) {
    place = view::skinNear(world_->surface, wanted, kEdgeReachMm);
  }
  if (place) rest(finger, *place);
  return true;
}

void Pointer::demonstrate(std::size_t finger, const SkinPlace& place, bool pressed) {
  fingers_[finger].place = place;
  fingers_[finger].pressed = pressed;
}

void Pointer::put(std::size_t finger, const SkinPlace& place) {
  rest(fingers_[finger], place);
  fingers_[finger].named = true;
}

void Pointer::rest(Finger& finger, const SkinPlace& place) {
  finger.place = place;
  finger.mouse_at_rest = mouse_;
  finger.named = false;
}

device::FingerTarget Pointer::target(std::size_t finger, const BodyView& seen, const scene::Scene& scene) const {
  const Finger& from = fingers_[finger];
  const TouchSettings& touch = seen.state.touch;
  const bool active = finger == seen.active_finger;
  device::FingerTarget target;
  target.present = from.place.has_value();
  target.pressed = from.pressed || from.tapped;
  target.by = touch.by;
  target.depth_mm = active ? touch.depth_mm : from.depth_mm;
  target.force_n = active ? touch.force_n : from.force_n;
  target.max_depth_mm = std::min(kMaxDepthMm, scene.contact.finger.max_depth_mm);
  target.radius_mm = fingerRadius(scene, finger);
  if (from.place) {
    target.place = from.place->point;
    target.normal = from.place->normal;
  }
  return target;
}

void Pointer::targetsSent() {
  for (Finger& finger : fingers_) finger.fresh = finger.tapped = false;
}

void Pointer::fly(const view::Camera& to, const BodyView& seen, double now_s, double seconds) {
  flight_ = Flight{seen.camera, to, now_s, seen.state.reduced_motion ? 0.0 : seconds};
}

void Pointer::advance(BodyView& seen, double now_s) {
  if (!flight_) return;
  const double share = flight_->seconds > 0.0 ? (now_s - flight_->start_s) / flight_->seconds : 1.0;
  seen.camera = view::between(flight_->from, flight_->to, share);
  if (share >= 1.0) flight_.reset();
}

}  // namespace palpate::viewer
