#include "cli/serve/finger_control.h"

#include <algorithm>
#include <utility>

namespace palpate::app::serving {

namespace {

/// Longest step of the clock for a move: a page that froze does not fling the finger.
constexpr double kLongestStepS = 0.1;
constexpr double kMinStepMm = 1.0;

}  // namespace

FingerControl::FingerControl(std::vector<ControlledFinger> fingers, const Box3& body, PointServo point,
                             HaltDevices halt, const ControlLimits& limits)
    : fingers_(std::move(fingers)),
      body_(body),
      point_(std::move(point)),
      halt_(std::move(halt)),
      limits_(limits),
      hands_(fingers_.size()) {
  for (std::size_t i = 0; i < hands_.size(); ++i) hands_[i].target.radius_mm = fingers_[i].radius_mm;
}

bool FingerControl::hasFreeFinger() const {
  return std::any_of(fingers_.begin(), fingers_.end(),
                     [](const ControlledFinger& finger) { return finger.device.empty(); });
}

std::string FingerControl::handleRequest(WatcherId who, Role role, const Request& request, double now_s) {
  if (who == holder_) holder_heard_s_ = now_s;
  if (const auto* to = std::get_if<Point>(&request)) return point(who, role, *to, now_s);
  if (std::holds_alternative<Take>(request)) return acquireControl(who, role, now_s);
  if (const auto* halt = std::get_if<Pause>(&request)) return pause(role, halt->on, now_s);
  if (std::holds_alternative<Say>(request))
    return role == Role::instruct ? "" : "only an instructor can message everyone";
  if (std::holds_alternative<Listen>(request)) return {};
  if (who != holder_) return "another user controls the finger";
  if (const auto* lift = std::get_if<Lift>(&request)) {
    if (lift->finger >= hands_.size()) return "no such finger";
    release(lift->finger, now_s);
  } else {
    left(who, now_s);
  }
  return {};
}

std::string FingerControl::acquireControl(WatcherId who, Role role, double now_s) {
  if (role < Role::control) return "this token is for looking on";
  if (who == holder_) return {};
  if (holder_ != 0 && role != Role::instruct) return "another user controls the finger";
  releaseAll(now_s);
  holder_ = who;
  holder_heard_s_ = now_s;
  return {};
}

std::string FingerControl::point(WatcherId who, Role role, const Point& request, double now_s) {
  if (role < Role::control) return "this token is for looking on";
  if (request.finger >= hands_.size()) return "no such finger";
  if (!fingers_[request.finger].device.empty()) return "a device moves this finger";
  if (paused_) return "paused by the instructor";
  if (holder_ == 0) acquireControl(who, role, now_s);
  if (who != holder_) return "another user controls the finger";
  const Vec3 margin = Vec3::Constant(limits_.margin_mm);
  if (!Box3(body_.min() - margin, body_.max() + margin).contains(request.place)) return "the place is not on the body";
  Hand& hand = hands_[request.finger];
  device::FingerTarget& target = hand.target;
  target.place = reachable(hand, request.place, now_s);
  target.normal = request.normal;
  target.present = true;
  target.pressed = request.pressed;
  target.by = request.force_n ? device::PressBy::force : device::PressBy::depth;
  target.depth_mm = std::min(request.depth_mm, limits_.depth_mm);
  target.force_n = std::min(request.force_n.value_or(0.0), limits_.force_n);
  target.max_depth_mm = limits_.depth_mm;
  hand.heard_s = now_s;
  hand.released_s = -1.0;
  point_(request.finger, target);
  return {};
}

/// Limits a finger that keeps pressing to the distance that it may have moved since.
Vec3 FingerControl::reachable(const Hand& hand, const Vec3& place, double now_s) const {
  if (!hand.target.present || !hand.target.pressed) return place;
  const double step_s = std::clamp(now_s - hand.heard_s, 0.0, kLongestStepS);
  const double most_mm = kMinStepMm + limits_.speed_mm_per_s * step_s;
  const Vec3 way = place - hand.target.place;
  const double length = way.norm();
  return length <= most_mm ? place : Vec3(hand.target.place + way * (most_mm / length));
}

void FingerControl::release(std::size_t finger, double now_s) {
  Hand& hand = hands_[finger];
  if (!hand.target.present || hand.released_s >= 0.0) return;
  hand.target.pressed = false;
  hand.released_s = now_s;
  point_(finger, hand.target);
}

void FingerControl::releaseAll(double now_s) {
  for (std::size_t i = 0; i < hands_.size(); ++i) release(i, now_s);
}

std::string FingerControl::pause(Role role, bool on, double now_s) {
  if (role != Role::instruct) return "only an instructor can pause";
  if (std::exchange(paused_, on) == on) return {};
  if (on) releaseAll(now_s);
  if (halt_) halt_(on);
  return {};
}

void FingerControl::left(WatcherId who, double now_s) {
  if (who != holder_) return;
  releaseAll(now_s);
  holder_ = 0;
}

void FingerControl::tick(double now_s) {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    if (hand.target.pressed && now_s - hand.heard_s > limits_.silence_s) release(i, now_s);
    if (hand.released_s < 0.0 || now_s - hand.released_s < limits_.leaving_s) continue;
    hand.target.present = false;
    hand.released_s = -1.0;
    point_(i, hand.target);
  }
  if (holder_ != 0 && now_s - holder_heard_s_ > limits_.idle_s) left(holder_, now_s);
}

void FingerControl::close(double now_s) {
  releaseAll(now_s);
  holder_ = 0;
  paused_ = true;
}

}  // namespace palpate::app::serving
