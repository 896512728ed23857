// What is drawn over the photographs, from a measurement whose places are known: a grid of 40 px for 30 mm, upright.
#include "palpate/measure/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/measure/skin_chart.h"

namespace palpate::measure {
namespace {

constexpr double kDrawnPxPerMm = 40.0 / 30.0;

/// Skin 0,0 is the dot in the middle, at 300,300 px; up is up.
Vec2 drawnPlaceOf(const Vec2& skin_mm) {
  return {300.0 + kDrawnPxPerMm * skin_mm.x(), 300.0 - kDrawnPxPerMm * skin_mm.y()};
}

constexpr int kGridReach = 5;

Measurement gridOnly() {
  Measurement m;
  for (int row = -kGridReach; row <= kGridReach; ++row) {
    for (int column = -kGridReach; column <= kGridReach; ++column) {
      m.grid.dots.push_back({{column, row}, {drawnPlaceOf(30.0 * Vec2(column, row)), 80.0}});
    }
  }
  m.grid.spacing_px = 40.0;
  m.grid.strays = {{{111.0, 222.0}, 60.0}};
  m.chart = std::make_shared<const SkinChart>(m.grid, 30.0, HeadTowards::top);
  return m;
}

/// Dragged upwards by 20 mm in the middle of a field, the body moved 3 mm to the right; one dot is hidden.
Measurement drawnMeasurement() {
  Measurement m = gridOnly();
  FieldFit fit;
  fit.field.contact_mm = m.chart->skinAt({300.0, 300.0});
  const double log_weight = -2.0 * std::log(50.0);
  fit.field.log_shape = {log_weight, 0.0, log_weight};
  fit.field.peak_mm = {0.0, 20.0};
  fit.at_2_mm = {2.0, {80.0, 2.0}, {60.0, 1.0}, {80.0 / 60.0, 0.02}, {90.0, 1.5}};
  fit.at_4_mm = {4.0, {60.0, 1.0}, {45.0, 1.0}, {80.0 / 60.0, 0.02}, {90.0, 1.5}};
  fit.peak_mm = {20.0, 0.5};
  const Vec2 drift(3.0, 0.0);
  for (const GridDot& dot : m.grid.dots) {
    MeasuredDot made;
    made.site = dot.site;
    made.before_px = dot.dot.place_px;
    made.skin_mm = m.chart->skinAt(made.before_px);
    made.drift_mm = drift;
    const bool hidden = dot.site.column == 2 && dot.site.row == -3;
    if (!hidden) {
      made.moved_mm = displacementAt(fit.field, made.skin_mm) + drift;
      made.after_px = Vec2(made.before_px + kDrawnPxPerMm * Vec2(made.moved_mm.x(), -made.moved_mm.y()));
      m.after_dots.push_back({*made.after_px, 80.0});
      ++m.matched;
    }
    m.dots.push_back(made);
  }
  m.after_dots.push_back({{555.0, 66.0}, 80.0});
  m.fit = fit;
  return m;
}

std::vector<Vec2> markPlaces(const OverlayPanel& panel, MarkForm form) {
  std::vector<Vec2> places;
  for (const OverlayMark& mark : panel.marks) {
    if (mark.form == form) places.push_back(mark.place_px);
  }
  return places;
}

bool explains(const OverlayPanel& panel, const std::string& words) {
  return std::any_of(panel.legend.begin(), panel.legend.end(),
                     [&](const LegendEntry& entry) { return entry.words.find(words) != std::string::npos; });
}

TEST(Overlay, JoinsNeighboursOfTheGridAndCrossesStrays) {
  const OverlayPanel panel = buildOverlay(gridOnly()).panels.at(0);
  EXPECT_EQ(panel.picture, PanelPicture::before);
  constexpr std::size_t kSide = 2 * kGridReach + 1;
  ASSERT_EQ(panel.lines.size(), 2 * kSide * (kSide - 1));
  for (const OverlayLine& line : panel.lines) {
    ASSERT_EQ(line.places_px.size(), 2u);
    EXPECT_NEAR((line.places_px[1] - line.places_px[0]).norm(), 40.0, 1e-9);
  }
  EXPECT_EQ(markPlaces(panel, MarkForm::cross), (std::vector<Vec2>{{111.0, 222.0}}));
  EXPECT_TRUE(explains(panel, "stray mark"));
}

TEST(Overlay, ShowsWhereAHiddenDotIsExpected) {
  const Measurement m = drawnMeasurement();
  const OverlayPanel panel = buildOverlay(m).panels.at(1);
  EXPECT_EQ(panel.picture, PanelPicture::after);
  EXPECT_EQ(markPlaces(panel, MarkForm::ring).size(), m.matched);
  const auto hidden = markPlaces(panel, MarkForm::square);
  ASSERT_EQ(hidden.size(), 1u);
  const Vec2 skin(60.0, -90.0);
  const double up = 20.0 * std::exp(-skin.squaredNorm() / 2500.0);
  EXPECT_NEAR((hidden[0] - drawnPlaceOf(skin + Vec2(3.0, up))).norm(), 0.0, 0.5);
  EXPECT_EQ(markPlaces(panel, MarkForm::cross), (std::vector<Vec2>{{555.0, 66.0}}));
}

TEST(Overlay, ArrowsAreTheMotionWithoutTheBodysOwn) {
  const Measurement m = drawnMeasurement();
  const OverlayPanel panel = buildOverlay(m, 3.0).panels.at(2);
  EXPECT_EQ(panel.picture, PanelPicture::before_faded);
  ASSERT_EQ(panel.arrows.size(), m.matched);
  const auto middle = std::find_if(panel.arrows.begin(), panel.arrows.end(), [](const OverlayArrow& arrow) {
    return (arrow.from_px - Vec2(300.0, 300.0)).norm() < 1.0;
  });
  ASSERT_NE(middle, panel.arrows.end());
  EXPECT_NEAR((middle->to_px - Vec2(300.0, 300.0 - 3.0 * 20.0 * kDrawnPxPerMm)).norm(), 0.0, 0.5);
}

TEST(Overlay, TheEllipseStandsWhereItWasFoundWithItsBand) {
  const OverlayPanel panel = buildOverlay(drawnMeasurement()).panels.at(2);
  const auto ellipse = std::find_if(panel.lines.begin(), panel.lines.end(), [](const OverlayLine& line) {
    return line.closed && !line.filled && !line.dashed;
  });
  ASSERT_NE(ellipse, panel.lines.end());
  for (const Vec2& place : ellipse->places_px) {
    // Upright: 80 mm up, 60 mm aside.
    const Vec2 off = (place - Vec2(300.0, 300.0)) / kDrawnPxPerMm;
    EXPECT_NEAR(std::hypot(off.x() / 60.0, off.y() / 80.0), 1.0, 0.01);
  }
  const auto band =
      std::find_if(panel.lines.begin(), panel.lines.end(), [](const OverlayLine& line) { return line.filled; });
  ASSERT_NE(band, panel.lines.end());
  double outermost = 0.0;
  for (const Vec2& place : band->places_px)
    outermost = std::max(outermost, std::abs(place.y() - 300.0) / kDrawnPxPerMm);
  EXPECT_NEAR(outermost, 84.0, 0.3);  // two sd of 2 mm
  EXPECT_NEAR(panel.scale_bar_px, 50.0 * kDrawnPxPerMm, 0.5);
}

TEST(Overlay, DrawsTheContourThatWasRead) {
  Measurement m = drawnMeasurement();
  EXPECT_FALSE(explains(buildOverlay(m).panels.at(2), "contour"));
  m.contour = ContourReading{.contour_2_mm = {{0.0, 0.0}, {30.0, 0.0}, {30.0, 30.0}}};
  const OverlayPanel panel = buildOverlay(m).panels.at(2);
  EXPECT_TRUE(explains(panel, "2 mm contour"));
  EXPECT_FALSE(explains(panel, "4 mm contour"));
}

TEST(Overlay, MarksTheContactThatWasGiven) {
  Measurement m = drawnMeasurement();
  m.settings.contact_px = Vec2(305.0, 310.0);
  const OverlayPanel panel = buildOverlay(m).panels.at(0);
  EXPECT_EQ(markPlaces(panel, MarkForm::ring), (std::vector<Vec2>{{305.0, 310.0}}));
  ASSERT_EQ(markPlaces(panel, MarkForm::star).size(), 1u);
  EXPECT_NEAR((markPlaces(panel, MarkForm::star)[0] - Vec2(300.0, 300.0)).norm(), 0.0, 0.5);
}

TEST(Overlay, SaysWhetherItIsAcceptedAndWhyNot) {
  Measurement m = drawnMeasurement();
  Overlay overlay = buildOverlay(m);
  EXPECT_TRUE(overlay.accepted);
  EXPECT_EQ(
      overlay.verdict,
      "accepted: half axes at 2 mm 80.0 ± 2.0 and 60.0 ± 1.0 mm, ratio 1.33 ± 0.02, direction 90.0 ± 1.5 degrees; "
      "peak 20.0 ± 0.5 mm");
  m.findings = {{Severity::warning, "form", "Not quite."}, {Severity::refusal, "moved", "The body moved."}};
  overlay = buildOverlay(m);
  EXPECT_FALSE(overlay.accepted);
  EXPECT_EQ(overlay.verdict, "refused: The body moved.");
  EXPECT_EQ(overlay.findings, (std::vector<std::string>{"warning: Not quite.", "refused: The body moved."}));
}

TEST(Overlay, OfNothingIsThreeEmptyPanels) {
  const Overlay overlay = buildOverlay(Measurement());
  ASSERT_EQ(overlay.panels.size(), 3u);
  for (const OverlayPanel& panel : overlay.panels) EXPECT_TRUE(panel.marks.empty() && panel.lines.empty());
  EXPECT_FALSE(overlay.accepted);
  EXPECT_EQ(overlay.verdict, "refused: nothing was measured");
}

}  // namespace
}  // namespace palpate::measure
