// Figures say what their data say: labels, units, colours and places.
#include "report/charts/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/text.h"
#include "report/charts/drawing.h"
#include "report/charts/plot_layout.h"
#include "support/error_message.h"
#include "support/png_pixels.h"
#include "support/temporary_folder.h"

namespace palpate::figures {

namespace {

constexpr Rect kPanel{0.0, 0.0, 500.0, 360.0};

Plot ratesPlot() {
  Plot plot{.title = "Rates"};
  plot.x = {.label = "triangles", .scale = Scale::logarithmic};
  plot.y = {.label = "rate", .unit = "FPS"};
  plot.series.push_back({.name = "touched", .x = {2915, 6261, 8163, 20389, 41582}, .y = {104, 51, 34, 12, 6}});
  plot.series.push_back({.name = "graphics <all>",
                         .x = {2915, 6261, 8163, 20389, 41582},
                         .y = {198, 92, 65, 25, 11},
                         .stroke = Stroke::dashed,
                         .marker = Marker::square});
  return plot;
}

Plot mapPlot() {
  Plot plot{.title = "Half major axis"};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm"};
  plot.y = {.label = "y", .unit = "mm"};
  plot.field = Field{.origin = Vec2(-100.0, -50.0),
                     .step = Vec2(10.0, 10.0),
                     .columns = 21,
                     .rows = 11,
                     .label = "half major axis",
                     .unit = "mm",
                     .from = 0.0,
                     .to = 10.0};
  sampleField(*plot.field, [](double x, double y) {
    return y > 30.0 ? std::numeric_limits<double>::quiet_NaN() : 5.0 + 0.04 * x + 0.02 * y;
  });
  return plot;
}

MeshView triangleView() {
  MeshView view{.title = "One triangle"};
  view.positions = {Vec3(-50, -50, 0), Vec3(50, -50, 0), Vec3(0, 50, 0)};
  view.triangles = {{0, 1, 2}};
  view.ambient = 1.0;
  return view;
}

Figure manyPanels() {
  Figure figure{.title = "Everything", .panels = {ratesPlot(), mapPlot(), triangleView()}, .columns = 2};
  figure.note = "A note that tells what differs from the printed picture, long enough to need a second line of text.";
  auto& map = std::get<Plot>(figure.panels[1]);
  map.field->contour_levels = {2.0, 4.0, 6.0, 8.0};
  map.places = {{Vec2(0, 0), "P1"}, {Vec2(2, 2), "P2"}, {Vec2(-80, -40), "P3"}, {Vec2(100, -50), "P4"}};
  std::get<MeshView>(figure.panels[2]).places = {{Vec3(0, 0, 0), "proxy"}, {Vec3(1, 1, 0), "anchor"}};
  std::get<MeshView>(figure.panels[2]).colour_key = ColourKey{.label = "strain", .unit = "%", .from = -20, .to = 20};
  return figure;
}

Pixels drawn(const Plot& plot) {
  Canvas canvas = Canvas::png(kPanel.right, kPanel.bottom, 1.0);
  drawPlot(canvas, plot, kPanel);
  return decodePng(canvas.finish());
}

Pixels drawn(const MeshView& view) {
  Canvas canvas = Canvas::png(kPanel.right, kPanel.bottom, 1.0);
  drawMeshView(canvas, view, kPanel);
  return decodePng(canvas.finish());
}

PlotLayout computeLayout(const Plot& plot) { return computeLayout(plot, kPanel, Canvas::png(1.0, 1.0, 1.0)); }

// Every opened tag is closed in order and no angle bracket stands loose.
bool isWellFormed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos || xml.find('<', at + 1) < end) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag[0] == '?' || tag[0] == '!' || tag.back() == '/') continue;
    const std::string name = tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" \n") - (tag[0] == '/' ? 1 : 0));
    if (tag[0] != '/') {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

int distance(std::uint32_t a, std::uint32_t b) {
  int worst = 0;
  for (const int shift : {0, 8, 16}) {
    worst = std::max(worst, std::abs(static_cast<int>(a >> shift & 0xffu) - static_cast<int>(b >> shift & 0xffu)));
  }
  return worst;
}

}  // namespace

TEST(Figure, SvgIsWellFormedAndNamesItsSeriesAxesAndUnits) {
  const std::string svg = renderSvg({.panels = {ratesPlot()}});
  EXPECT_TRUE(isWellFormed(svg));
  for (const char* text : {"Rates", "triangles", "rate (FPS)", "touched", "graphics &lt;all&gt;", "10000"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(Figure, BytesOfANameThatAreNoLettersAreMarked) {
  const Figure figure{.title = "sz\xe9ne", .panels = {ratesPlot()}};
  const std::string svg = renderSvg(figure);
  EXPECT_TRUE(isWellFormed(svg));
  EXPECT_NE(svg.find("sz\xef\xbf\xbdne"), std::string::npos);
  EXPECT_FALSE(renderPng(figure).empty());
}

TEST(Figure, EqualFiguresGiveEqualFiles) {
  EXPECT_EQ(renderSvg(manyPanels()), renderSvg(manyPanels()));
  EXPECT_EQ(renderPng(manyPanels()), renderPng(manyPanels()));
}

TEST(Figure, NoTextCoversAnotherOrLeavesThePage) {
  const Figure figure = manyPanels();
  const Pixels page = decodePng(renderPng(figure, 1.0));
  const std::vector<DrawnText> texts = collectDrawnTexts(figure);
  ASSERT_GT(texts.size(), 40u);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const DrawnText& a = texts[i];
    EXPECT_TRUE(a.left >= 0.0 && a.top >= 0.0 && a.right <= page.width && a.bottom <= page.height) << a.text;
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      const DrawnText& b = texts[j];
      const bool apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      EXPECT_TRUE(apart) << a.text << " covers " << b.text;
    }
  }
}

TEST(Figure, AMapShowsTheColourOfItsValueAtEveryPlace) {
  const Plot plot = mapPlot();
  const PlotLayout layout = computeLayout(plot);
  const Pixels pixels = drawn(plot);
  for (const Vec2& place : {Vec2(-80, -40), Vec2(0, 0), Vec2(55, 13), Vec2(90, 20)}) {
    const Vec2 at = layout(place);
    const double share = (5.0 + 0.04 * place.x() + 0.02 * place.y()) / 10.0;
    const std::uint32_t expected = toPremultipliedArgb(mapColour(ColourMap::viridis, share)) & 0xffffffu;
    EXPECT_LE(distance(pixels.at(at.x(), at.y()), expected), 4) << place.transpose();
  }
}

TEST(Figure, AFieldOfCellsIsOneColourFromEdgeToEdgeOfEach) {
  Plot plot = mapPlot();
  plot.field->cells = true;
  const PlotLayout layout = computeLayout(plot);
  const Pixels pixels = drawn(plot);
  const std::uint32_t expected = toPremultipliedArgb(mapColour(ColourMap::viridis, 0.5)) & 0xffffffu;
  for (const Vec2& place : {Vec2(-4, -4), Vec2(0, 0), Vec2(4, 4)}) {
    const Vec2 at = layout(place);
    EXPECT_EQ(pixels.at(at.x(), at.y()), expected) << place.transpose();
  }
}

TEST(Figure, ALabelStandsInTheMiddleOfItsPlace) {
  Figure figure{.panels = {mapPlot()}};
  std::get<Plot>(figure.panels[0]).labels.push_back({.at = Vec2(20.0, 10.0), .text = "42"});
  const std::vector<DrawnText> texts = collectDrawnTexts(figure);
  const auto label = std::find_if(texts.begin(), texts.end(), [](const DrawnText& text) { return text.text == "42"; });
  ASSERT_NE(label, texts.end());
  const double margin = 12.0;  // of a figure around its panel
  const PlotLayout layout =
      computeLayout(mapPlot(), {margin, margin, margin + figure.panel_width_px, margin + figure.panel_height_px},
                    Canvas::png(1.0, 1.0, 1.0));
  const Vec2 at = layout(Vec2(20.0, 10.0));
  EXPECT_NEAR(0.5 * (label->left + label->right), at.x(), 1.0);
  EXPECT_NEAR(0.5 * (label->top + label->bottom), at.y(), 1.5);
}

TEST(Figure, OutsideTheFieldThePaperShows) {
  const Plot plot = mapPlot();
  const Vec2 outside = computeLayout(plot)({0.0, 45.0});
  EXPECT_EQ(drawn(plot).at(outside.x(), outside.y()), 0xffffffu);
}

TEST(Figure, AnEqualAspectKeepsCirclesRound) {
  const PlotLayout layout = computeLayout(mapPlot());
  EXPECT_NEAR((layout({10.0, 0.0}) - layout({0.0, 0.0})).norm(), (layout({0.0, 10.0}) - layout({0.0, 0.0})).norm(),
              1e-9);
}

TEST(Figure, ASeriesGoesThroughItsPoints) {
  Plot plot = ratesPlot();
  plot.series[0].marker = Marker::circle;
  const Vec2 at = computeLayout(plot)({8163.0, 34.0});
  EXPECT_LE(distance(drawn(plot).at(at.x(), at.y()), toPremultipliedArgb(kBlue) & 0xffffffu), 2);
}

TEST(Figure, PointsThatCannotBeShownInterruptACurve) {
  Plot plot{.x = {.from = 0.0, .to = 4.0}, .y = {.from = 0.0, .to = 2.0}};
  plot.series.push_back({.name = "gap", .x = {0, 1, 2, 3, 4}, .y = {1, 1, std::nan(""), 1, 1}});
  const PlotLayout layout = computeLayout(plot);
  const Pixels pixels = drawn(plot);
  const auto colour_at = [&](double x) { return pixels.at(layout({x, 1.0}).x(), layout({x, 1.0}).y()); };
  EXPECT_LE(distance(colour_at(0.5), toPremultipliedArgb(kBlue) & 0xffffffu), 40);
  EXPECT_GT(distance(colour_at(1.6), toPremultipliedArgb(kBlue) & 0xffffffu), 100);
}

TEST(Figure, ATriangleIsShownInItsColourWithTheNearOneInFront) {
  MeshView view = triangleView();
  view.colour = kGreen;
  EXPECT_LE(distance(drawn(view).at(250.0, 200.0), toPremultipliedArgb(kGreen) & 0xffffffu), 1);
  for (const Vec3& corner : {Vec3(-50, -50, 10), Vec3(50, -50, 10), Vec3(0, 50, 10)}) view.positions.push_back(corner);
  view.triangles = {{3, 4, 5}, {0, 1, 2}};
  view.colours = {kBlue, kGreen};
  EXPECT_LE(distance(drawn(view).at(250.0, 200.0), toPremultipliedArgb(kBlue) & 0xffffffu), 1);
}

TEST(Figure, EmptyDataGiveAnEmptyPictureInsteadOfAFailure) {
  EXPECT_TRUE(isWellFormed(renderSvg({.panels = {Plot{}, MeshView{}}})));
  EXPECT_TRUE(isWellFormed(renderSvg({})));
}

TEST(Figure, WritesBothFormats) {
  const support::TemporaryFolder folder;
  writePng({.panels = {ratesPlot()}}, folder.path() / "rates.png");
  writeSvg({.panels = {ratesPlot()}}, folder.path() / "rates.svg");
  EXPECT_EQ(decodePng(readFile(folder.path() / "rates.png", 1 << 24)).width, static_cast<int>(2 * 544));
  EXPECT_TRUE(isWellFormed(readFile(folder.path() / "rates.svg", 1 << 24)));
}

TEST(Figure, AFileThatCannotBeWrittenIsNamed) {
  const std::string file = "/dev/null/at/all.png";
  EXPECT_EQ(support::thrownMessage([&] { writePng({}, file); }).substr(0, file.size() + 1), file + ":");
  EXPECT_NE(support::thrownMessage([&] { writeSvg({}, "/dev/null/at/all.svg"); }), "no error");
}

}  // namespace palpate::figures
