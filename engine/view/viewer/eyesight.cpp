#include "view/viewer/eyesight.h"

#include "palpate/base/language.h"

namespace palpate::viewer {

void Eyesight::enforceUsableMode(ViewerState& viewer) {
  view::StereoMode& mode = viewer.state.stereo.mode;
  const view::UsableMode usable = view::usableMode(mode, quad_buffer_offered_, last_usable_);
  if (usable.mode != mode) {
    viewer.report(Severity::warning, trf("{}; a screen for shutter glasses needs `--stereo quad-buffer`", usable.note));
  }
  mode = last_usable_ = usable.mode;
}

view::StereoSettings Eyesight::settings(ViewerState& viewer) {
  viewer.quad_buffer_offered = quad_buffer_offered_;
  enforceUsableMode(viewer);
  view::StereoSettings stereo = viewer.state.stereo;
  const HeadSettings& head = viewer.state.head;
  head_.settings.expected_mm = head.expected_mm;
  head_.settings.offset_mm = head.offset_mm;
  viewer.head.eyes_mm = head_.eyesAt(viewer.now_s);
  viewer.head.state = head_.stateAt(viewer.now_s);
  stereo.head.reset();
  if (head.on) stereo.head = view::TrackedHead{viewer.head.eyes_mm, head.screen_height_mm};
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
