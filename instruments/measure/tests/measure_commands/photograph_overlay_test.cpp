// The overlay as a picture: photographs where they belong, marks where they are, words that hide none.
#include "measure/pages/photograph_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/png_pixels.h"
#include "support/temporary_folder.h"

namespace palpate::figures {
namespace {

measure::Photograph plain(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  measure::Photograph picture{.name = "it", .width_px = width, .height_px = height};
  for (int i = 0; i < width * height; ++i) picture.rgb.insert(picture.rgb.end(), {red, green, blue});
  return picture;
}

measure::OverlayPanel makePanel(const char* title, measure::PanelPicture picture) {
  measure::OverlayPanel panel;
  panel.title = title;
  panel.picture = picture;
  return panel;
}

constexpr measure::OverlayColour kPureGreen{0.0f, 1.0f, 0.0f};

/// Two panels of 400 x 600 pixels: before red, after blue; a green square, filled, in the middle of the second.
struct Case {
  measure::Photograph before = plain(400, 600, 200, 0, 0);
  measure::Photograph after = plain(400, 600, 0, 0, 200);
  OverlayPage page;

  Case() {
    measure::OverlayPanel first = makePanel("before: dots", measure::PanelPicture::before);
    first.legend = {{.words = "grid of 99 dots", .colour = kPureGreen, .is_line = true}};
    measure::OverlayPanel second = makePanel("after: dots", measure::PanelPicture::after);
    second.lines = {{.places_px = {{190, 290}, {210, 290}, {210, 310}, {190, 310}},
                     .colour = kPureGreen,
                     .width = 12.0f,
                     .closed = true}};
    second.scale_bar_px = 100.0;
    measure::OverlayPanel third = makePanel("result", measure::PanelPicture::before_faded);
    page.overlay.panels = {first, second, third};
    page.overlay.verdict = "refused: The body moved.";
    page.overlay.findings = {"refused: The body moved.", "warning: The field is not quite of the fitted form."};
    page.before = &before;
    page.after = &after;
  }
};

/// The middle of a panel on a page of 1240, a pixel a unit.
Vec2 panelCentre(int panel) {
  const double width = (1240.0 - 24.0 - 20.0) / 3.0;
  return {12.0 + panel * (width + 10.0) + 0.5 * width, 12.0 + 13.0 + 6.0 + 0.75 * width};
}

TEST(PhotographOverlay, PutsThePicturesAndTheirMarksIntoTheirPanels) {
  const Case made;
  const Pixels pixels = decodePng(overlayPng(made.page));
  EXPECT_EQ(pixels.width, 1240);
  const Vec2 first = panelCentre(0);
  const Vec2 second = panelCentre(1);
  const Vec2 third = panelCentre(2);
  EXPECT_EQ(pixels.at(first.x(), first.y()), 0xc80000u);
  EXPECT_EQ(pixels.at(second.x() + 60.0, second.y()), 0x0000c8u);
  EXPECT_EQ(pixels.at(second.x() + 10.0, second.y()), 0x00ff00u);  // on the square's line
  EXPECT_EQ(pixels.at(third.x(), third.y()), 0xe17373u);           // 45 % towards white
}

TEST(PhotographOverlay, IsAsSharpAsItIsAskedFor) {
  const Case made;
  const Pixels small = decodePng(overlayPng(made.page));
  const Pixels large = decodePng(overlayPng(made.page, 2.0));
  EXPECT_EQ(large.width, 2480);
  EXPECT_NEAR(large.height, 2 * small.height, 2);
}

TEST(PhotographOverlay, SaysEverythingAndNoTextHidesAnother) {
  const Case made;
  const auto texts = collectDrawnTexts(made.page);
  for (const char* wanted : {"before: dots", "grid of 99 dots", "50 mm", "refused: The body moved.",
                             "warning: The field is not quite of the fitted form."}) {
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [&](const DrawnText& text) { return text.text == wanted; }))
        << wanted;
  }
  EXPECT_EQ(std::count_if(texts.begin(), texts.end(),
                          [&](const DrawnText& text) { return text.text == made.page.overlay.verdict; }),
            1);  // the reason that is the verdict is not said twice
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_GE(texts[i].left, 0.0);
    EXPECT_LE(texts[i].right, 1240.0);
    for (std::size_t k = i + 1; k < texts.size(); ++k) {
      const bool apart = texts[i].right <= texts[k].left || texts[k].right <= texts[i].left ||
                         texts[i].bottom <= texts[k].top || texts[k].bottom <= texts[i].top;
      EXPECT_TRUE(apart) << texts[i].text << " | " << texts[k].text;
    }
  }
}

TEST(PhotographOverlay, LongFindingsAreWrapped) {
  Case made;
  std::string longest;
  for (int i = 0; i < 80; ++i) longest += "breath ";
  made.page.overlay.verdict = "refused: " + longest;
  made.page.overlay.findings = {longest};
  for (const DrawnText& text : collectDrawnTexts(made.page)) EXPECT_LE(text.right, 1240.0) << text.text;
}

TEST(PhotographOverlay, WithoutPhotographsShowsTheMarksAlone) {
  Case made;
  made.page.before = made.page.after = nullptr;
  const Pixels pixels = decodePng(overlayPng(made.page));
  const std::size_t green = static_cast<std::size_t>(std::count(pixels.values.begin(), pixels.values.end(), 0x00ff00u));
  EXPECT_GT(green, 1000u);  // now it fills its panel
}

TEST(PhotographOverlay, IsWrittenAsPngAndSvg) {
  const support::TemporaryFolder folder;
  const Case made;
  writeOverlay(made.page, folder / "it.png");
  writeOverlay(made.page, folder / "it.svg");
  EXPECT_EQ(readFile(folder / "it.png", 1 << 24), overlayPng(made.page));
  EXPECT_NE(readFile(folder / "it.svg", 1 << 24).find("refused: The body moved."), std::string::npos);
  EXPECT_EQ(support::thrownMessage([&] { writeOverlay(made.page, folder / "it.jpg"); }),
            (folder / "it.jpg").string() + ": an overlay's name must end in .png or .svg");
}

}  // namespace
}  // namespace palpate::figures
