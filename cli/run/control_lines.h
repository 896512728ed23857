// Where the controls are on the screen, as lines on standard output: for scripts that click with a real pointer, which
// should not know pixels.
//
//   control start/touch 40 120 330 168        left, top, right, below, pixels; whenever it has moved
//   control start/touch gone
//
// Read by tests/desktop/desktop.py.
#pragma once

#include "view/viewer/panels/widgets.h"

namespace palpate::app {

/// Says only what changed since the picture before: a window at rest says nothing.
///
/// Names are those of viewer::notePlace; what is drawn without one cannot be found by a script.
class ControlLines {
 public:
  /// Once a picture. `scale`: pixels of a point.
  void tell(double scale);

 private:
  viewer::WidgetPlaces before_;
};

}  // namespace palpate::app
