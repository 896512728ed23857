// Fills in the sentences of rates_findings.txt and the verdicts that the numbers decide.
#include "dissertation/tables/rendering_rates.h"

#include <algorithm>
#include <cmath>

#include "dissertation/numbers/printed_numbers.h"
#include "dissertation/tables/rate_curves.h"
#include "dissertation_findings_texts.h"

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

FindingValues shapeOfRates(const RatesMeasurement& found) {
  const WholeModelRow& first = found.whole.front();
  const WholeModelRow& last = found.whole.back();
  const ModelRate small = rateHere(first);
  const ModelRate large = rateHere(last);
  const ModelRate printed_small = ratePrinted(first.triangles);
  const ModelRate printed_large = ratePrinted(last.triangles);
  const double here = exponent(small, large);
  const double then = exponent(printed_small, printed_large);
  const auto [slowest, fastest] = std::minmax({small.per_s / printed_small.per_s, large.per_s / printed_large.per_s});
  return {{"power", -here},
          {"printed_power", -then},
          {"per_s", {small.per_s, large.per_s}},
          {"triangles", {small.triangles, large.triangles}},
          {"printed_per_s", {printed_small.per_s, printed_large.per_s}},
          {"speed", slowest > 1.0   ? "faster"
                    : fastest < 1.0 ? "slower"
                                    : "mixed"},
          {"gain", {slowest, fastest}},
          {"same_law", std::abs(here - then) <= kSameExponent},
          {"tick_us", {first.tick_us, last.tick_us}}};
}

FindingValues tickBesideFrames(const RatesMeasurement& found) {
  const FrameRow& smallest = found.bsp.touched.front();
  const FrameRow& largest = found.bsp.touched.back();
  const double small_us = smallest.touchedMicroseconds();
  const double large_us = largest.touchedMicroseconds();
  return {{"tick_us", found.tick_us},    {"small_us", small_us},
          {"small", smallest.triangles}, {"large_us", large_us},
          {"large", largest.triangles},  {"times", {small_us / found.tick_us, large_us / found.tick_us}}};
}

/// Drawing's share of a touched frame; null where it was not measured.
FindingValues shareOfDrawing(const RatesMeasurement& found) {
  if (found.renderer.empty()) return {};
  const PrintedTimings printed = printedNumbers().table_3_2;
  return {{"here",
           costPerTriangle(measuredCurve(found.bsp, kDrawing)) / costPerTriangle(measuredCurve(found.bsp, kTouched))},
          {"printed", costPerTriangle(printedCurve(printed.drawing)) / costPerTriangle(printedCurve(printed.touched))}};
}

FindingValues costOfTriangles(const RatesMeasurement& found) {
  const PrintedNumbers printed = printedNumbers();
  FindingValues kinds = FindingValues::array();
  for (const FrameKind& kind : kFrameKinds) {
    const double here = costPerTriangle(measuredCurve(found.bsp, kind));
    if (here == 0.0) continue;
    const double then = costPerTriangle(printedCurve(printed.table_3_2.*kind.printed));
    kinds.push_back({{"name", kind.name}, {"here_ns", 1e3 * here}, {"printed_us", then}, {"times", then / here}});
  }
  return {{"kinds", kinds},
          {"drawing", shareOfDrawing(found)},
          {"triangles", 1e3 / costPerTriangle(measuredCurve(found.bsp, kTouched))}};
}

double mostFindMicroseconds(const RatesMeasurement& found) {
  double most = 0.0;
  for (const TreeRates* rates : {&found.bsp, &found.octree}) {
    for (const FrameRow& row : rates->touched) most = std::max(most, row.find_us);
  }
  return most;
}

FindingValues ratesOfTrees(const RatesMeasurement& found) {
  const PrintedNumbers printed = printedNumbers();
  const Gain gain = rateGain(printed.appendix_b.touched, printed.table_3_2.touched);
  const double bsp = costPerTriangle(measuredCurve(found.bsp, kTouched));
  const double octree = costPerTriangle(measuredCurve(found.octree, kTouched));
  const bool same = std::abs(octree / bsp - 1.0) <= kSameCost;
  return {{"printed_gain", {gain.least, gain.most}},
          {"bsp_ns", 1e3 * bsp},
          {"octree_ns", 1e3 * octree},
          {"octree", same           ? "same"
                     : octree < bsp ? "less"
                                    : "more"},
          {"same", kSameCost},
          {"less", 1.0 - octree / bsp},
          {"more", octree / bsp - 1.0},
          {"find_us", mostFindMicroseconds(found)}};
}

const char* halfRateVerdict(const Extent& here, const Extent& printed) {
  if (here.least >= printed.least && here.most <= printed.most) return "all";
  return here.least > printed.most || here.most < printed.least ? "none" : "some";
}

FindingValues graphicRates(const RatesMeasurement& found) {
  if (found.renderer.empty()) return {};
  Extent here;
  for (const WholeModelRow& row : found.whole) here.add(*row.picture_us / row.touchedMicroseconds());
  Extent printed;
  for (const PrintedRate& rate : printedNumbers().table_3_1) printed.add(rate.haptic_fps / rate.graphic_fps);
  return {
      {"printed", printed}, {"renderer", found.renderer}, {"here", here}, {"holds", halfRateVerdict(here, printed)}};
}

}  // namespace

std::vector<std::string> ratesFindings(const RatesMeasurement& found) {
  FindingValues no_pictures;
  if (found.renderer.empty()) no_pictures = {{"why", found.no_renderer}};
  return formatFindings(texts::rates_findings, {{"shape", shapeOfRates(found)},
                                                {"tick", tickBesideFrames(found)},
                                                {"cost", costOfTriangles(found)},
                                                {"trees", ratesOfTrees(found)},
                                                {"graphic", graphicRates(found)},
                                                {"no_pictures", no_pictures}});
}

}  // namespace palpate::study
