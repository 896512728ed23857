// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/tables/rendering_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dissertation/numbers/printed_numbers.h"
#include "dissertation/tables/rate_curves.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

// Exponents as near as this are called the same law: the printed rates have two digits, which makes 0.1 between a short
// pair of models.
constexpr double kSameExponent = 0.15;
// Costs as near as this are called the same.
constexpr double kSameCost = 0.1;

struct ModelRate {
  double triangles = 0.0;
  double per_s = 0.0;
};

// The p of rate ~ triangles^-p between two models.
double exponent(const ModelRate& small, const ModelRate& large) {
  return std::log(small.per_s / large.per_s) / std::log(large.triangles / small.triangles);
}

ModelRate rateHere(const WholeModelRow& row) {
  return {static_cast<double>(row.triangles), 1e6 / row.touchedMicroseconds()};
}

// The printed rate of the model of that many triangles, or of the one nearest to it.
ModelRate ratePrinted(std::size_t triangles) {
  const auto printed = printedNumbers().table_3_1;
  const auto apart = [&](const PrintedRate& rate) { return std::abs(rate.triangles - static_cast<double>(triangles)); };
  const PrintedRate nearest = *std::min_element(
      printed.begin(), printed.end(), [&](const PrintedRate& a, const PrintedRate& b) { return apart(a) < apart(b); });
  return {static_cast<double>(nearest.triangles), nearest.haptic_fps};
}

std::string speedVerdict(double gain_small, double gain_large) {
  const double least = std::min(gain_small, gain_large);
  const double most = std::max(gain_small, gain_large);
  if (least > 1.0) return fmt::format("{} to {} times as fast as in 2008", rounded(least), rounded(most));
  return most < 1.0 ? "slower than in 2008" : "faster than in 2008 on one of them only";
}

std::string shapeFinding(const RatesMeasurement& found) {
  const WholeModelRow& first = found.whole.front();
  const WholeModelRow& last = found.whole.back();
  const ModelRate small = rateHere(first);
  const ModelRate large = rateHere(last);
  const ModelRate printed_small = ratePrinted(first.triangles);
  const ModelRate printed_large = ratePrinted(last.triangles);
  const double here = exponent(small, large);
  const double then = exponent(printed_small, printed_large);
  return fmt::format(
      "Table 3.1 in the dissertation's way: the rate falls with the number of triangles to the power {} (printed {}), "
      "from {} to {} frames a second between {} and {} triangles (printed {:g} to {:g}): {}, and {}. Our tick takes {} "
      "us and {} us on the same two models.",
      rounded(-here), rounded(-then), rounded(small.per_s), rounded(large.per_s), counted(small.triangles),
      counted(large.triangles), printed_small.per_s, printed_large.per_s,
      speedVerdict(small.per_s / printed_small.per_s, large.per_s / printed_large.per_s),
      std::abs(here - then) <= kSameExponent ? "the law is the same" : "the law is another", rounded(first.tick_us),
      rounded(last.tick_us));
}

std::string tickFinding(const RatesMeasurement& found) {
  const FrameRow& smallest = found.bsp.touched.front();
  const FrameRow& largest = found.bsp.touched.back();
  return fmt::format(
      "Ours renders nothing for haptics: a tick walks from triangle to triangle and takes {} us, the mean over "
      "strokes. "
      "A touched frame in the dissertation's way with a BSP tree takes {} us with {} triangles and {} us with {}: {} "
      "and "
      "{} times as long.",
      rounded(found.tick_us), rounded(smallest.touchedMicroseconds()), counted(smallest.triangles),
      rounded(largest.touchedMicroseconds()), counted(largest.triangles),
      rounded(smallest.touchedMicroseconds() / found.tick_us), rounded(largest.touchedMicroseconds() / found.tick_us));
}

// " Drawing is ..." where it was measured.
std::string drawingShare(const RatesMeasurement& found) {
  if (found.renderer.empty()) return "";
  const PrintedTimings printed = printedNumbers().table_3_2;
  const double here =
      costPerTriangle(measuredCurve(found.bsp, kDrawing)) / costPerTriangle(measuredCurve(found.bsp, kTouched));
  const double then = costPerTriangle(printedCurve(printed.drawing)) / costPerTriangle(printedCurve(printed.touched));
  return fmt::format(" Drawing is {} of a touched frame here; in 2008 it was {}.", percent(here), percent(then));
}

std::string costFinding(const RatesMeasurement& found) {
  const PrintedNumbers printed = printedNumbers();
  std::string costs;
  for (const FrameKind& kind : kFrameKinds) {
    const double here = costPerTriangle(measuredCurve(found.bsp, kind));
    if (here == 0.0) continue;
    const double then = costPerTriangle(printedCurve(printed.table_3_2.*kind.printed));
    costs += fmt::format("{}{} {} ns (printed {} us, {} times as much)", costs.empty() ? "" : ", ", kind.name,
                         rounded(1e3 * here), rounded(then), rounded(then / here));
  }
  const double touched = costPerTriangle(measuredCurve(found.bsp, kTouched));
  return fmt::format(
      "Table 3.2: a triangle rendered costs {}.{} A haptic loop of 1 kHz would have time for {} triangles a frame.",
      costs, drawingShare(found), rounded(1e3 / touched));
}

double mostFindMicroseconds(const RatesMeasurement& found) {
  double most = 0.0;
  for (const TreeRates* rates : {&found.bsp, &found.octree}) {
    for (const FrameRow& row : rates->touched) most = std::max(most, row.find_us);
  }
  return most;
}

std::string treesVerdict(double bsp, double octree) {
  if (std::abs(octree / bsp - 1.0) <= kSameCost) {
    return fmt::format("the same within {}, so the printed gain is not seen here, and its cause is not known",
                       percent(kSameCost));
  }
  return octree < bsp ? fmt::format("{} less, so a gain is seen here too", percent(1.0 - octree / bsp))
                      : fmt::format("{} more, so the printed gain is not seen here", percent(octree / bsp - 1.0));
}

std::string treesFinding(const RatesMeasurement& found) {
  const PrintedNumbers printed = printedNumbers();
  const Gain gain = rateGain(printed.appendix_b.touched, printed.table_3_2.touched);
  const double bsp = costPerTriangle(measuredCurve(found.bsp, kTouched));
  const double octree = costPerTriangle(measuredCurve(found.octree, kTouched));
  return fmt::format(
      "Figures 3.16 to 3.18: at equal numbers of triangles the octree is printed as {} to {} faster when touched. Here "
      "a "
      "triangle costs {} ns with the BSP tree and {} ns with the octree: {}. Finding the leaves takes {} us of a frame "
      "at "
      "most. How many triangles each tree renders for the same box is another question (`palpate study hdb`).",
      percent(gain.least), percent(gain.most), rounded(1e3 * bsp), rounded(1e3 * octree), treesVerdict(bsp, octree),
      rounded(mostFindMicroseconds(found)));
}

std::string halfRateVerdict(const Extent& here, const Extent& printed) {
  if (here.least >= printed.least && here.most <= printed.most) return "it holds here as well";
  if (here.least > printed.most || here.most < printed.least) {
    return "it does not hold here, so it is no property of the method alone";
  }
  return "it holds for some of the models here";
}

std::string graphicFinding(const RatesMeasurement& found) {
  if (found.renderer.empty()) return "Pictures could not be measured: " + found.no_renderer + ".";
  Extent here;
  for (const WholeModelRow& row : found.whole) here.add(*row.picture_us / row.touchedMicroseconds());
  Extent printed;
  for (const PrintedRate& rate : printedNumbers().table_3_1) printed.add(rate.haptic_fps / rate.graphic_fps);
  return fmt::format(
      "\"The haptic rendering rate is almost half of the graphic\" (Table 3.1: {} to {}): with {} as the renderer it "
      "is "
      "{} to {}; {}. Our own pictures are another matter: `palpate study bench frame`.",
      rounded(printed.least), rounded(printed.most), found.renderer, rounded(here.least), rounded(here.most),
      halfRateVerdict(here, printed));
}

}  // namespace

std::vector<std::string> ratesFindings(const RatesMeasurement& found) {
  return {shapeFinding(found), tickFinding(found), costFinding(found), treesFinding(found), graphicFinding(found)};
}

}  // namespace palpate::study
