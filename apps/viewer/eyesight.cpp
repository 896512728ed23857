#include "apps/viewer/eyesight.h"

#include <algorithm>

namespace palpate::viewer {

void Eyesight::keepUsable(Session& session) {
  view::StereoMode& mode = session.state.stereo.mode;
  const view::UsableMode usable = view::usableMode(mode, quad_buffer_offered_, last_usable_);
  if (usable.mode != mode) {
    session.report(Severity::warning, usable.note + "; a screen for shutter glasses needs `--stereo quad-buffer`");
  }
  mode = last_usable_ = usable.mode;
}

view::StereoSettings Eyesight::settings(Session& session) {
  session.quad_buffer_offered = quad_buffer_offered_;
  keepUsable(session);
  view::StereoSettings stereo = session.state.stereo;
  const HeadSettings& head = session.state.head;
  head_.settings.expected_mm = head.expected_mm;
  head_.settings.offset_mm = head.offset_mm;
  session.eyes_mm = head_.eyesAt(session.now_s);
  session.head = head_.stateAt(session.now_s);
  stereo.head.reset();
  if (head.on) stereo.head = view::TrackedHead{session.eyes_mm, head.screen_height_mm};
  return stereo;
}

std::vector<window::InputEvent> asOneEyeSees(std::span<const window::InputEvent> events, view::StereoMode mode,
                                             int width, int height) {
  std::vector<window::InputEvent> seen(events.begin(), events.end());
  if (!view::hasTwoParts(mode)) return seen;
  const Vec2 whole(width, height);
  const view::EyePicture eye = view::eyePictureIn(mode, width, height);
  for (window::InputEvent& event : seen) {
    event.at =
        view::placeInEye(mode, event.at.cwiseQuotient(whole)).cwiseProduct(Vec2(eye.seen_width, eye.seen_height));
  }
  return seen;
}

namespace {

/// A frame that was in time takes back as much of the suspicion as several slow ones of its length brought.
constexpr double kForgiving = 2.0;
constexpr double kMostPatience = 64.0;

}  // namespace

ShadingGuard::Change ShadingGuard::frame(double between_s, double cost_s, bool counts) {
  if (!counts || between_s > settings_.hitch_s) return Change::none;
  if (!simple_) {
    const bool slow = between_s > settings_.slow_s;
    slow_s_ = std::max(0.0, slow_s_ + (slow ? between_s : -kForgiving * between_s));
    if (slow_s_ < settings_.slow_for_s) return Change::none;
    simple_ = true;
    slow_s_ = spare_s_ = 0.0;
    return Change::simpler;
  }
  const bool spare = std::max(between_s * settings_.spare_share, cost_s) < settings_.spare_share * settings_.slow_s;
  spare_s_ = spare ? spare_s_ + between_s : 0.0;
  if (spare_s_ < patience_ * settings_.spare_for_s) return Change::none;
  simple_ = false;
  patience_ = std::min(kMostPatience, 2.0 * patience_);
  spare_s_ = 0.0;
  return Change::as_wished;
}

}  // namespace palpate::viewer
