// The measuring view against pictures that a person has looked at. Photograph, dots and numbers are made up, so that
// no measuring has a say in it.
#include <gtest/gtest.h>
#include <imgui.h>

#include "made_measurement.h"
#include "measure/window/measuring_window.h"
#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "view/tests/viewer/gui_picture.h"

namespace palpate::viewer {
namespace {

class MeasuringPictures : public testing::Test {
 protected:
  MeasuringPictures() { fillView(view, pictures_); }

  void expect(const std::string& name, int width, int height) {
    expectGuiPicture(gui_, name, Vec2(width, height), 1.0, [&] {
      measuringWindow(view, {0.0f, 0.0f, static_cast<float>(width), static_cast<float>(height)}, requests);
    });
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
