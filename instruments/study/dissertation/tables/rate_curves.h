// Frames as curves over the triangles rendered, printed and measured alike, and the cost of a triangle on them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "dissertation/numbers/printed_numbers.h"
#include "dissertation/tables/rendering_rates.h"

namespace palpate::study {

/// x and y of a curve.
struct RateCurve {
  std::vector<double> x{};
  std::vector<double> y{};

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
};

RateCurve inverse(RateCurve milliseconds);

/// The three kinds of frame that the tables distinguish.
struct FrameKind {
  const char* name;
  std::vector<PrintedTiming> PrintedTimings::*printed;
  std::vector<FrameRow> TreeRates::*measured;
  std::optional<double> (*us)(const FrameRow& row);
};

inline constexpr std::array<FrameKind, 3> kFrameKinds{
    {{"drawing", &PrintedTimings::drawing, &TreeRates::drawing, [](const FrameRow& row) { return row.draw_us; }},
     {"untouched", &PrintedTimings::untouched, &TreeRates::untouched,
      [](const FrameRow& row) { return std::optional(row.untouchedMicroseconds()); }},
     {"touched", &PrintedTimings::touched, &TreeRates::touched,
      [](const FrameRow& row) { return std::optional(row.touchedMicroseconds()); }}}};
inline constexpr const FrameKind& kDrawing = kFrameKinds[0];
inline constexpr const FrameKind& kTouched = kFrameKinds[2];

/// ms over triangles.
RateCurve printedCurve(const std::vector<PrintedTiming>& timings);
/// Frames without a value are left out.
RateCurve measuredCurve(const TreeRates& rates, const FrameKind& kind);

/// Slope of time = cost x triangles, us a triangle, by least squares; 0 for no frames.
double costPerTriangle(const RateCurve& milliseconds);

}  // namespace palpate::study
