// The measuring view against pictures that a person has looked at. Photograph, dots and numbers are made up, so that
// no measuring has a say in it.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "made_measurement.h"
#include "measure/window/measuring_window.h"
#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "pictures/image_compare.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {
namespace {

class MeasuringPictures : public testing::Test {
 protected:
  MeasuringPictures() { fillView(view, pictures_); }

  void expect(const std::string& name, int width, int height) {
    const view::Target target(width, height);
    for (int frame = 0; frame < 3; ++frame) {
      gui_.begin(Vec2(width, height), 1.0, 1.0 / 60.0, {});
      widgetPlaces().clear();
      measuringWindow(view, {0.0f, 0.0f, static_cast<float>(width), static_cast<float>(height)}, requests);
      gui_.end();
    }
    target.bind();
    glClearColor(0.35f, 0.35f, 0.35f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.present(target.width(), target.height());
    support::Tolerance tolerance;
    tolerance.bad_in_block = 0.03;
    support::expectPicture(name, target.read(), view::rendererName(), tolerance);
  }

  MeasuringView view;
  MeasuringRequests requests;

 private:
  const view::OffscreenContext context_;
  window::Gui gui_;
  const MadePhotographs pictures_ = madePhotographs();
};

TEST_F(MeasuringPictures, OfTheResult) { expect("measuring_result", 1000, 700); }

TEST_F(MeasuringPictures, OfDotsThatAreCorrected) {
  view.tab = MeasuringTab::after;
  view.tool = MeasuringTool::dots;
  view.selected = ChosenMark{Photo::after, 35};
  view.zoom = 2.0;
  expect("measuring_dots", 800, 500);
}

TEST_F(MeasuringPictures, OfAllPhotographsInANarrowWindow) {
  view.tab = MeasuringTab::all;
  view.settings.contact_px = Vec2(150.0, 180.0);
  expect("measuring_narrow", 500, 400);
  view.tab = MeasuringTab::numbers;
  expect("measuring_narrow_numbers", 500, 400);
}

TEST_F(MeasuringPictures, OfARefusalWhileItIsMeasuredAgain) {
  auto refused = std::make_shared<measure::Measurement>(*view.measured);
  refused->findings = {{measure::Severity::refusal, "moved",
                        "The body (or the camera) moved between the pictures: 4.1 mm, more than a drift of 0.4 mm "
                        "allows. Hold the breath and repeat, or allow more drift."}};
  view.measured = refused;
  view.overlay.accepted = false;
  view.overlay.verdict = "refused: " + refused->findings.front().text;
  expect("measuring_refused", 800, 500);
  view.working = true;
  view.stage = "finding dots";
  view.done = 0.5;
  view.tab = MeasuringTab::before;
  expect("measuring_working", 500, 400);
}

}  // namespace
}  // namespace palpate::viewer
