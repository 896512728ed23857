// What the window shows without a world, against pictures that a person has looked at (image_compare.h).
#pragma once

#include <epoxy/gl.h>

#include <string>

#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "pictures/image_compare.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

/// Of `points`, over the grey that stands for the body. `draw` is called as often as windows take to fit their
/// contents.
template <class Draw>
void expectGuiPicture(window::Gui& gui, const std::string& name, const Vec2& points, double pixels_per_point,
                      const Draw& draw) {
  constexpr int kFramesToSettle = 3;
  constexpr double kLetter = 0.03;  // of a block: what a lost letter leaves, also in a large picture
  const Vec2 pixels = pixels_per_point * points;
  const view::Target target(static_cast<int>(pixels.x()), static_cast<int>(pixels.y()));
  for (int frame = 0; frame < kFramesToSettle; ++frame) {
    gui.begin(points, pixels_per_point, 1.0 / 60.0, {});
    widgetPlaces().clear();
    draw();
    gui.end();
  }
  target.bind();
  glClearColor(0.35f, 0.35f, 0.35f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  gui.present(target.width(), target.height());
  support::Tolerance tolerance;
  tolerance.bad_in_block = kLetter;
  support::expectPicture(name, target.read(), view::rendererName(), tolerance);
}

}  // namespace palpate::viewer
