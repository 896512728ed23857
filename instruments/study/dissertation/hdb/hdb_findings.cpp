// Fills in the sentences of hdb_findings.txt and the verdicts that the numbers decide.
#include "dissertation/hdb/hdb_measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dissertation/numbers/number_row.h"
#include "dissertation/numbers/printed_numbers.h"
#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

/// The stroke that a box of 2008 is held against, mm/s: that of the benchmark's slide.
constexpr double kUsualStroke = 200.0;
// Leads up to which every stroke should get through, and from which none should.
constexpr double kTooSmall = 0.5;
constexpr double kLargeEnough = 1.25;

/// The printed times of a touched frame with a BSP tree, s.
Extent printedDelays() {
  const auto rows = printedNumbers().table_3_2.touched;
  return {1e-3 * parsePrinted(rows.front().ms).value, 1e-3 * parsePrinted(rows.back().ms).value};
}

FindingValues shareValues(double share) {
  return {{"amount", share == 0.0 ? "none" : share == 1.0 ? "all" : "some"}, {"share", share}};
}

FindingValues edgeRuleValues(const HdbMeasurement& found) {
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  const double worst = std::max(mostPunctured(found.recommended), mostPunctured(found.fine_recommended));
  const std::size_t cells = found.recommended.size() + found.fine_recommended.size();
  return {{"held", worst == 0.0},
          {"all_strokes", static_cast<std::size_t>(found.plan.strokes) * cells},
          {"strokes", found.plan.strokes},
          {"models", {found.plan.triangles, found.plan.fine_triangles}},
          {"worst", shareValues(worst)},
          {"m_per_s", metresPerSecond(usual.speed_mm_s)},
          {"delay_ms", usual.delay_ticks},
          {"edge_mm", usual.edge_mm},
          {"triangles", usual.triangles},
          {"of_leaves", usual.triangles / quarterRow(found).bsp_triangles},
          {"of_model", usual.triangles / static_cast<double>(found.plan.triangles)}};
}

FindingValues marginOfDepth(const HdbMeasurement& found) {
  const double margin = safeMargin(found);
  const double e12 = mostPunctured(found.fine_e12);
  return {{"margin", std::isinf(margin) ? "not_enough"
                     : margin == 0.0    ? "not_needed"
                                        : "enough"},
          {"share", margin},
          {"depths_mm", {found.plan.depths_mm.front(), found.plan.depths_mm.back()}},
          {"e12_fails", e12 > 0.0},
          {"e12", shareValues(e12)},
          {"model", found.plan.fine_triangles},
          {"longest_edge_mm", found.fine_triangle_edge}};
}

FindingValues boxLeadValues(const HdbMeasurement& found) {
  const double below = leastPunctured(found.leads, kTooSmall);
  const double above = mostPunctured(found.leads, kLargeEnough);
  return {{"decides", below > 0.5 && above < 0.5}, {"too_small", kTooSmall},      {"below", shareValues(below)},
          {"large_enough", kLargeEnough},          {"above", shareValues(above)}, {"some_above", above > 0.0}};
}

FindingValues quarterBoxSpeedValues(const HdbMeasurement& found) {
  const Extent printed = printedDelays();
  const auto safe = [&](double share, double delay) {
    return safeSpeed(share * found.longest_edge, delay, found.depth_mm);
  };
  const auto metres = [&](double share) -> FindingValues {
    return {metresPerSecond(safe(share, printed.least)), metresPerSecond(safe(share, printed.most))};
  };
  const bool by_tenth = safe(kTenth, printed.most) >= kUsualStroke;
  const bool by_quarter = safe(kPrintedBoxShare, printed.most) >= kUsualStroke;
  const double at_100_hz = safe(kPrintedBoxShare, 0.01);
  const double fastest = *std::max_element(found.plan.speeds_mm_s.begin(), found.plan.speeds_mm_s.end());
  return {{"printed_ms", {1e3 * printed.least, 1e3 * printed.most}},
          {"quarter_mm", kPrintedBoxShare * found.longest_edge},
          {"quarter", metres(kPrintedBoxShare)},
          {"tenth", metres(kTenth)},
          {"stroke", metresPerSecond(kUsualStroke)},
          {"held_by", by_tenth && by_quarter ? "both"
                      : by_quarter           ? "quarter"
                                             : "neither"},
          {"at_100_hz", metresPerSecond(at_100_hz)},
          {"times", at_100_hz / fastest}};
}

FindingValues quarterBoxCostValues(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const auto all = static_cast<double>(found.plan.triangles);
  return {{"model", all},
          {"exact", quarter.exact_triangles},
          {"exact_share", quarter.exact_triangles / all},
          {"bsp", quarter.bsp_triangles},
          {"bsp_share", quarter.bsp_triangles / all},
          {"octree", quarter.octree_triangles},
          {"octree_share", quarter.octree_triangles / all},
          {"bsp_us", quarter.bsp_us},
          {"octree_us", quarter.octree_us},
          {"exact_us", quarter.exact_us},
          {"tick_us", found.tick_us}};
}

/// Share of the strokes that only the leaves' overhang saved, in the worst case.
double hiddenByLeaves(const HdbMeasurement& found) {
  double hidden = 0.0;
  for (std::size_t i = 0; i < found.punctures.size(); ++i) {
    hidden = std::max(hidden, found.punctures[i].punctured - found.leaf_punctures[i].punctured);
  }
  return hidden;
}

/// From the coarsest model to the finest: tick with the hybrid over tick with the coherent list.
const char* hybridGainRange(double on_smallest, double on_largest) {
  if (on_smallest < 1.0 && on_largest < 1.0) return "everywhere";
  if (on_smallest >= 1.0 && on_largest >= 1.0) return "nowhere";
  return on_largest < 1.0 ? "fine" : "coarse";
}

/// The hybrid on the largest model, against the other lists in the same run; null where none was measured.
FindingValues boxListValues(const HdbMeasurement& found) {
  const ListCosts& costs = found.lists;
  if (costs.models.empty()) return {};
  const std::size_t model = costs.models.back();
  const ListRow& leaves = *findListRow(costs, model, hdb::HdbQuery::leaves);
  const ListRow& exact = *findListRow(costs, model, hdb::HdbQuery::triangles);
  const ListRow& coherent = *findListRow(costs, model, hdb::HdbQuery::coherent);
  const ListRow& linked = *findListRow(costs, model, hdb::HdbQuery::linked);
  FindingValues to_coherent = FindingValues::array();
  std::vector<double> ratios;
  for (const std::size_t other : costs.models) {
    ratios.push_back(findListRow(costs, other, hdb::HdbQuery::linked)->tick_us /
                     findListRow(costs, other, hdb::HdbQuery::coherent)->tick_us);
    to_coherent.push_back({{"times", ratios.back()}, {"model", other}});
  }
  return {{"same", std::all_of(costs.rows.begin(), costs.rows.end(), [](const ListRow& row) { return row.same; })},
          {"model", model},
          {"linked", linked.listed},
          {"coherent", coherent.listed},
          {"leaves", leaves.listed},
          {"linked_moved", linked.moved},
          {"linked_tested", linked.tested},
          {"exact_tested", exact.tested},
          {"coherent_tested", coherent.tested},
          {"to_exact", linked.tick_us / exact.tick_us},
          {"to_leaves", linked.tick_us / leaves.tick_us},
          {"to_coherent", to_coherent},
          {"pays", hybridGainRange(ratios.front(), ratios.back())},
          {"default_share", costs.default_us.back() / linked.tick_us},
          {"linked_bytes", linked.bytes / static_cast<double>(model)},
          {"coherent_bytes", coherent.bytes / static_cast<double>(model)},
          {"make_share", linked.make_us / costs.build_us.back()}};
}

}  // namespace

double mostPunctured(const std::vector<PunctureRow>& rows, double from_lead, double to_lead) {
  double most = 0.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() >= from_lead && row.lead() <= to_lead) most = std::max(most, row.punctured);
  }
  return most;
}

double leastPunctured(const std::vector<PunctureRow>& rows, double to_lead) {
  double least = 1.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() <= to_lead) least = std::min(least, row.punctured);
  }
  return least;
}

const PunctureRow& rowAt(const std::vector<PunctureRow>& rows, double speed_mm_s, int delay_ticks) {
  const auto distance = [&](const PunctureRow& row) {
    return std::abs(row.speed_mm_s - speed_mm_s) + 1e3 * std::abs(row.delay_ticks - delay_ticks);
  };
  return *std::min_element(rows.begin(), rows.end(),
                           [&](const PunctureRow& a, const PunctureRow& b) { return distance(a) < distance(b); });
}

double safeMargin(const HdbMeasurement& found) {
  double unsafe = -1.0;
  for (const MarginRow& row : found.margins) {
    if (row.punctured > 0.0) unsafe = std::max(unsafe, row.share);
  }
  double safe = std::numeric_limits<double>::infinity();
  for (const MarginRow& row : found.margins) {
    if (row.share > unsafe) safe = std::min(safe, row.share);
  }
  return safe;
}

std::vector<std::string> hdbFindings(const HdbMeasurement& found) {
  const double through = found.else_if_punctured;
  return formatFindings(
      texts::hdb_findings,
      {{"rule", edgeRuleValues(found)},
       {"margin", marginOfDepth(found)},
       {"lead", boxLeadValues(found)},
       {"quarter", quarterBoxSpeedValues(found)},
       {"cost", quarterBoxCostValues(found)},
       {"leaves", {{"hidden", hiddenByLeaves(found)}}},
       {"else_if", {{"through", through != 0.0}, {"least", shareValues(through)}, {"some", through < 1.0}}},
       {"list", boxListValues(found)}});
}

}  // namespace palpate::study
