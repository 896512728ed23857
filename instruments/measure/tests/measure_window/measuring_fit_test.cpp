// The measuring window in each language in the smallest window that is promised, 640x480, and in one that is just wide
// enough for its column: no text is cut and none lies over another. tools/check-translations counts the lines
// "overflow: ...".
#include <gtest/gtest.h>

#include "made_measurement.h"
#include "measure/window/measuring_window.h"
#include "palpate/base/language.h"
#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "view/tests/viewer/text_fit.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {
namespace {

struct Size {
  int width, height;
};
/// The second has a column beside the photographs.
constexpr std::array<Size, 2> kSizes = {{{640, 480}, {800, 600}}};

class MeasuringTranslations : public testing::TestWithParam<const char*> {
 protected:
  MeasuringTranslations() { fillView(view, photographs_); }
  void SetUp() override { useLanguage(GetParam()); }
  void TearDown() override { useLanguage("en"); }

  /// In all its tabs.
  void expectFits(const std::string& what) {
    for (const Size& size : kSizes) {
      for (const MeasuringTab tab : {MeasuringTab::before, MeasuringTab::after, MeasuringTab::result, MeasuringTab::all,
                                     MeasuringTab::numbers}) {
        view.tab = tab;
        for (int frame = 0; frame < 3; ++frame) draw(size);
        expectTextsFit(GetParam(), "measuring, " + what + ", tab " + std::to_string(static_cast<int>(tab)));
      }
    }
  }

  MeasuringView view;

 private:
  void draw(const Size& size) {
    gui_.begin(Vec2(size.width, size.height), 1.0, 1.0 / 60.0, {});
    widgetPlaces().clear();
    measuringWindow(view, {0.0f, 0.0f, static_cast<float>(size.width), static_cast<float>(size.height)}, requests_);
    gui_.end();
  }

  const view::OffscreenContext context_;
  window::Gui gui_;
  const MadePhotographs photographs_ = madePhotographs();
  MeasuringRequests requests_;
};

TEST_P(MeasuringTranslations, OfTheResultFit) {
  expectFits("result");
  view.settings.contact_px = Vec2(150.0, 180.0);
  for (const MeasuringTool tool : {MeasuringTool::contact, MeasuringTool::dots}) {
    view.tool = tool;
    expectFits("correcting");
  }
}

TEST_P(MeasuringTranslations, OfNothingChosenYetFit) {
  view = {};
  view.open = true;
  expectFits("nothing chosen");
}

TEST_P(MeasuringTranslations, OfARefusalAndOfWorkUnderWayFit) {
  auto refused = std::make_shared<measure::Measurement>(*view.measured);
  refused->findings = {{measure::Severity::refusal, "moved", "The body moved between the pictures: 4.1 mm."}};
  view.measured = refused;
  view.overlay.accepted = false;
  view.overlay.verdict = "refused: " + refused->findings.front().text;
  view.form.place_words = "no place \"T6 lefd\"; did you mean T6 left?";
  view.form.at_mm.reset();
  expectFits("refusal");
  view.working = true;
  view.stage = "finding dots";
  view.done = 0.5;
  expectFits("work under way");
}

INSTANTIATE_TEST_SUITE_P(Of, MeasuringTranslations, testing::Values("en", "de", "es"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace palpate::viewer
