// A field as an image of colours, bilinear between its values or in boxes, with its contour lines and their numbers
// over it.
#include "palpate/base/language.h"
#include "report/charts/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/charts/lettering.h"

namespace palpate::figures {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
// Pixels of the colour image a CSS pixel; matches the PNG's.
constexpr double kFieldScale = 2.0;

double valueAt(const Field& field, int column, int row) {
  return field.values[static_cast<std::size_t>(row) * field.columns + column];
}

// Mean of the values that are inside; nothing where less than half of the weight is.
struct Weighted {
  double sum = 0.0;
  double weight = 0.0;

  void add(double share, double value) {
    if (!std::isfinite(value)) return;
    sum += share * value;
    weight += share;
  }
  double mean() const { return weight >= 0.5 ? sum / weight : kNothing; }
};

double lengthOf(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

// The contour's number, once, where it hides no other text.
void labelContour(Canvas& canvas, const std::vector<Vec2>& line, const std::string& text, const Rect& frame) {
  constexpr int kTries = 24;
  const TextStyle style{.size_px = 10.0, .across = Align::middle, .halo = true};
  for (int i = 0; i < kTries; ++i) {
    // From the middle outwards, to both sides in turn.
    const double share = 0.5 + (i % 2 == 0 ? 0.5 : -0.5) * i / kTries;
    const Vec2& at = line[static_cast<std::size_t>(share * static_cast<double>(line.size() - 1))];
    if (!isFree(canvas, canvas.textBox(at, text, style), frame)) continue;
    canvas.text(at, text, style);
    return;
  }
}

}  // namespace

double fieldAt(const Field& field, const Vec2& place) {
  const Vec2 cell = (place - field.origin).cwiseQuotient(field.step);
  if (cell.x() < -0.5 || cell.y() < -0.5 || cell.x() > field.columns - 0.5 || cell.y() > field.rows - 0.5) {
    return kNothing;
  }
  if (field.cells) {
    const auto nearest = [](double at, int count) {
      return std::clamp(static_cast<int>(std::lround(at)), 0, count - 1);
    };
    return valueAt(field, nearest(cell.x(), field.columns), nearest(cell.y(), field.rows));
  }
  const double x = std::clamp(cell.x(), 0.0, field.columns - 1.0);
  const double y = std::clamp(cell.y(), 0.0, field.rows - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(field.columns - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(field.rows - 2, 0));
  const int right = std::min(column + 1, field.columns - 1);
  const int above = std::min(row + 1, field.rows - 1);
  const double u = x - column;
  const double v = y - row;
  Weighted sum;
  sum.add((1.0 - u) * (1.0 - v), valueAt(field, column, row));
  sum.add(u * (1.0 - v), valueAt(field, right, row));
  sum.add((1.0 - u) * v, valueAt(field, column, above));
  sum.add(u * v, valueAt(field, right, above));
  return sum.mean();
}

void drawField(Canvas& canvas, const Field& field, const PlotLayout& layout) {
  const Rect& frame = layout.frame;
  const int columns = static_cast<int>(std::lround(frame.width() * kFieldScale));
  const int rows = static_cast<int>(std::lround(frame.height() * kFieldScale));
  const Range& x = layout.x.range;
  const Range& y = layout.y.range;
  const Range& colours = layout.field_range;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(static_cast<std::size_t>(columns) * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 place(x.from + (column + 0.5) / columns * (x.to - x.from),
                       y.to - (row + 0.5) / rows * (y.to - y.from));
      const double share = (fieldAt(field, place) - colours.from) / (colours.to - colours.from);
      pixels.push_back(std::isfinite(share) ? toPremultipliedArgb(mapColour(field.colours, share)) : 0);
    }
  }
  canvas.image(frame, columns, rows, pixels);
}

void drawContours(Canvas& canvas, const Field& field, const PlotLayout& layout) {
  constexpr double kWorthALabel = 60.0;  // pixels of line
  for (const double level : field.contour_levels) {
    std::vector<Vec2> longest;
    for (std::vector<Vec2> line : contourLines(field, level)) {
      for (Vec2& point : line) point = layout(point);
      canvas.path(line, false, Pen{withAlpha(kInk, 0.75), 0.9});
      if (lengthOf(line) > lengthOf(longest)) longest = std::move(line);
    }
    if (lengthOf(longest) > kWorthALabel)
      labelContour(canvas, longest, fmt::format("{:.6g}", WrittenNumber{level}), layout.frame);
  }
}

}  // namespace palpate::figures
