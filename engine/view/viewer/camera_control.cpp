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
      if (const auto& place = pointer_.placeOf(seen_.active_finger)) {
        flyTo(centredInFreePart(seen_.camera, place->point, seen_.state.shown, seen_.size_points));
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
  const Shown& shown = seen_.state.shown;
  if (const auto box = modes_.homeBox()) return flyTo(fitToFreePart(*box, shown, side, seen_.size_points));
  flyTo(homeView(*world_, shown, side, seen_.size_points));
}

void CameraControl::flyTo(const view::Camera& camera) {
  seen_.opened.camera_moved = true;
  pointer_.fly(camera, seen_, now_s_, kFlightS);
}

bool CameraControl::flyToPlace(const Vec3& point) {
  constexpr double kReachMm = 60.0;  // from the skin, for a place next to a landmark
  constexpr double kCloser = 0.4;    // a hand's breadth around it
  const auto place = view::skinNear(world_->surface, point, kReachMm);
  if (!place) return false;
  const bool behind = place->normal.z() >= 0.0;
  const auto side = behind ? view::StandardView::back : view::StandardView::front;
  view::Camera camera = homeView(*world_, seen_.state.shown, side, seen_.size_points);
  camera.distance_mm *= kCloser;
  flyTo(centredInFreePart(camera, place->point, seen_.state.shown, seen_.size_points));
  if (pointer_.pressed(seen_.active_finger)) return false;
  pointer_.put(seen_.active_finger, *place);
  return true;
}

void CameraControl::showBody(const view::Camera& camera) {
  standard_view_ = static_cast<int>(view::StandardView::back);
  pointer_.fly(camera, seen_, now_s_, kFlightS);
}

}  // namespace palpate::viewer
