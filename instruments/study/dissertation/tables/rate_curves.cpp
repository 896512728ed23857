// Data flow: rows of the printed tables and of the measurement -> here -> plots, findings and numbers of the study.
#include "dissertation/tables/rate_curves.h"

#include "dissertation/numbers/number_row.h"

namespace palpate::study {

RateCurve inverse(RateCurve milliseconds) {
  for (double& y : milliseconds.y) y = 1000.0 / y;
  return milliseconds;
}

RateCurve printedCurve(const std::vector<PrintedTiming>& timings) {
  RateCurve curve;
  for (const PrintedTiming& timing : timings) curve.add(timing.triangles, parsePrinted(timing.ms).value);
  return curve;
}

RateCurve measuredCurve(const TreeRates& rates, const FrameKind& kind) {
  RateCurve curve;
  for (const FrameRow& row : rates.*kind.measured) {
    if (const auto time = kind.us(row)) curve.add(row.triangles, 1e-3 * *time);
  }
  return curve;
}

double costPerTriangle(const RateCurve& milliseconds) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < milliseconds.x.size(); ++i) {
    products += 1e3 * milliseconds.x[i] * milliseconds.y[i];
    squares += milliseconds.x[i] * milliseconds.x[i];
  }
  return squares > 0.0 ? products / squares : 0.0;
}

}  // namespace palpate::study
