// The curve of section.h as a chart: axes that fit it, a grid in round steps, rest, deformed. Each picture.
#include "palpate/base/language.h"
#include "palpate/view/overlays/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

namespace {

constexpr float kLeft = 34.0f;        ///< room for the numbers of the heights
constexpr float kBelow = 30.0f;       ///< and for those of the widths, with their unit
constexpr float kWordsAbove = 24.0f;  ///< room for the text
constexpr float kRight = 12.0f;

/// From mm to the page.
struct Axes {
  Vec2 low, high;        ///< mm
  Vec2f corner, extent;  ///< upper left and size of the field, points

  Vec2f at(const Vec2& mm) const {
    const Vec2 share = (mm - low).cwiseQuotient(high - low);
    return corner + Vec2f(static_cast<float>(share.x()) * extent.x(), static_cast<float>(1.0 - share.y()) * extent.y());
  }
};

Axes axesFor(std::span<const SectionPoint> curve, const SectionChart& chart) {
  Axes axes;
  axes.low = {-kSectionHalfWidthMm, 0.0};
  axes.high = {kSectionHalfWidthMm, 0.0};
  for (const SectionPoint& point : curve) {
    axes.low.y() = std::min({axes.low.y(), point.rest.y(), point.deformed.y()});
    axes.high.y() = std::max({axes.high.y(), point.rest.y(), point.deformed.y()});
  }
  if (chart.cap_mm) axes.low.y() = std::min(axes.low.y(), -*chart.cap_mm);
  // A flat skin at rest still gets a scale.
  constexpr double kMinMm = 2.0;
  const double range = std::max(axes.high.y() - axes.low.y(), kMinMm);
  const double room = 0.08 * range;
  axes.low.y() -= chart.cap_mm ? 0.25 * range : room;  // text goes below the cap
  axes.high.y() += room;
  axes.corner = chart.corner + Vec2f(kLeft, kWordsAbove);
  axes.extent = chart.size - Vec2f(kLeft + kRight, kWordsAbove + kBelow);
  return axes;
}

void drawGrid(Drawing& page, const Axes& axes, const LabelInks& inks) {
  const float half_line = 0.5f * page.measure("0", TextSize::small).y();
  const auto heights = roundMarks(axes.low.y(), axes.high.y(), 4);
  const double height_step = heights.size() > 1 ? heights[1] - heights[0] : 1.0;
  for (const double height : heights) {
    const Vec2f left = axes.at({axes.low.x(), height});
    page.line(left, axes.at({axes.high.x(), height}), inks.grid);
    page.text({left.x() - 5.0f, left.y() - half_line}, markText(height, height_step), inks.letter, Align::right,
              TextSize::small);
  }
  const auto widths = roundMarks(axes.low.x(), axes.high.x(), 5);
  for (const double width : widths) {
    const Vec2f foot = axes.at({width, axes.low.y()});
    page.line(foot, axes.at({width, axes.high.y()}), inks.grid);
    page.text({foot.x(), foot.y() + 2.0f}, markText(width, 1.0), inks.letter, Align::centre, TextSize::small);
  }
  const Vec2f end = axes.at({axes.high.x(), axes.low.y()});
  page.text({end.x(), end.y() + 15.0f}, "mm", inks.letter, Align::right, TextSize::small);
}

/// Labels the ends by their letters in the picture.
void drawEnds(Drawing& page, const Axes& axes, const SectionEnds& ends, const LabelInks& inks) {
  const float y = axes.at({0.0, axes.low.y()}).y() + 15.0f;
  page.text({axes.corner.x() - kLeft + 6.0f, y}, ends.low, inks.letter, Align::left, TextSize::small);
  const float unit = page.measure("mm", TextSize::small).x() + 8.0f;
  page.text({axes.corner.x() + axes.extent.x() - unit, y}, ends.high, inks.letter, Align::right, TextSize::small);
}

/// Explains why the dent is shallower than the finger's depth.
void drawCap(Drawing& page, const Axes& axes, double cap_mm, const LabelInks& inks) {
  page.line(axes.at({axes.low.x(), -cap_mm}), axes.at({axes.high.x(), -cap_mm}), inks.deformed);
  std::string words = trf("drawn {:g} mm deep at most", cap_mm);
  if (page.measure(words, TextSize::small).x() > axes.extent.x()) words = trf("at most {:g} mm", cap_mm);
  const Vec2f place = axes.at({axes.high.x(), -cap_mm}) - Vec2f(2.0f, -1.0f);
  page.text(place, words, inks.deformed, Align::right, TextSize::small);
}

/// The part of a line of points that lies within the field.
void drawCurve(Drawing& page, const Axes& axes, std::span<const SectionPoint> curve, Vec2 SectionPoint::*place,
               const Ink& ink, float thickness) {
  std::vector<Vec2f> line;
  for (const SectionPoint& point : curve) {
    const Vec2& mm = point.*place;
    if (mm.x() >= axes.low.x() && mm.x() <= axes.high.x()) line.push_back(axes.at(mm));
  }
  page.curve(line, ink, thickness);
}

void drawLineLabels(Drawing& page, const SectionChart& chart, const LabelInks& inks) {
  const float y = chart.corner.y() + 6.0f;
  float x = chart.corner.x() + 8.0f;
  for (const auto& [words, ink] : {std::pair<std::string_view, Ink>{tr("section"), inks.letter},
                                   {tr("rest"), inks.rest},
                                   {tr("deformed"), inks.deformed}}) {
    page.text({x, y}, words, ink, Align::left, TextSize::small);
    x += page.measure(words, TextSize::small).x() + 12.0f;
  }
}

}  // namespace

void drawSection(Drawing& page, std::span<const SectionPoint> curve, const SectionChart& chart, const LabelInks& inks) {
  if (curve.empty()) return;
  page.box(chart.corner, chart.corner + chart.size, inks.plate, 5.0f);
  const Axes axes = axesFor(curve, chart);
  drawGrid(page, axes, inks);
  drawEnds(page, axes, chart.ends, inks);
  if (chart.cap_mm) drawCap(page, axes, *chart.cap_mm, inks);
  drawCurve(page, axes, curve, &SectionPoint::rest, inks.rest, 1.5f);
  drawCurve(page, axes, curve, &SectionPoint::deformed, inks.deformed, 2.2f);
  drawLineLabels(page, chart, inks);
}

}  // namespace palpate::view
