#include "view/viewer/camera_control.h"

#include <iterator>

namespace palpate::viewer {

namespace {

constexpr double kFlightS = 0.35;

}  // namespace

bool CameraControl::act(window::Action action) {
  using view::StandardView;
  using window::Action;
  switch (action) {
    case Action::centre_on_finger:
      if (const auto& place = pointer_.placeOf(viewer_.active_finger)) {
        flyTo(view::centredOn(viewer_.camera, place->point));
      }
      return true;
    case Action::next_view:
    case Action::previous_view: {
      constexpr int kViews = static_cast<int>(std::size(view::kStandardViewNames));
      standard_view_ = (standard_view_ + (action == Action::next_view ? 1 : kViews - 1)) % kViews;
      setView(static_cast<StandardView>(standard_view_));
      return true;
    }
    case Action::view_back:
      setView(StandardView::back);
      return true;
    case Action::view_right:
      setView(StandardView::right);
      return true;
    case Action::view_above:
      setView(StandardView::above);
      return true;
    default:
      return false;
  }
}

void CameraControl::setView(view::StandardView side) {
  standard_view_ = static_cast<int>(side);
  const Shown& shown = viewer_.state.shown;
  if (const auto box = modes_.homeBox()) return flyTo(viewOf(*box, shown, side, viewer_.size_points));
  flyTo(homeView(*world_, shown, side, viewer_.size_points));
}

void CameraControl::flyTo(const view::Camera& camera) {
  viewer_.opened.camera_moved = true;
  pointer_.fly(camera, viewer_, kFlightS);
}

void CameraControl::showBody(const view::Camera& camera) {
  standard_view_ = static_cast<int>(view::StandardView::back);
  pointer_.fly(camera, viewer_, kFlightS);
}

}  // namespace palpate::viewer
