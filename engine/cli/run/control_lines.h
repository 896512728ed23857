// Places of the controls on the screen, as lines on standard output: for scripts that click with a real pointer, which
// should not know pixels.
//
//   control start/touch 40 120 330 168        left, top, right, below, pixels; whenever it has moved
//   control start/touch gone
//
// Read by tests/desktop/desktop.py.
#pragma once

#include "view/viewer/panels/widgets.h"

namespace palpate::app {

/// Prints only the changes since the picture before: a window at rest prints nothing.
///
/// Names are those of viewer::notePlace; scripts cannot find controls without one.
class ControlLines {
 public:
  /// Once a picture. `scale`: pixels of a point.
  void print(double scale);

 private:
  viewer::WidgetPlaces before_;
};

}  // namespace palpate::app
