#include "view/viewer/eyesight.h"

#include "palpate/base/language.h"

namespace palpate::viewer {

void Eyesight::enforceUsableMode(view::StereoMode& mode, Conversation& user) {
  const view::UsableMode usable = view::usableMode(mode, quad_buffer_offered_, last_usable_);
  if (usable.mode != mode) {
    user.report(Severity::warning, trf("{}; a screen for shutter glasses needs `--stereo quad-buffer`", usable.note));
  }
  mode = last_usable_ = usable.mode;
}

view::StereoSettings Eyesight::settings(BodyView& seen, Conversation& user) {
  seen.quad_buffer_offered = quad_buffer_offered_;
  enforceUsableMode(seen.state.stereo.mode, user);
  view::StereoSettings stereo = seen.state.stereo;
  const HeadSettings& head = seen.state.head;
  head_.settings.expected_mm = head.expected_mm;
  head_.settings.offset_mm = head.offset_mm;
  seen.head.eyes_mm = head_.eyesAt(user.now_s);
  seen.head.state = head_.stateAt(user.now_s);
  stereo.head.reset();
  if (head.on) stereo.head = view::TrackedHead{seen.head.eyes_mm, head.screen_height_mm};
  return stereo;
}

std::vector<window::InputEvent> mapEventsToEye(std::span<const window::InputEvent> events, view::StereoMode mode,
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

}  // namespace palpate::viewer
