// Chapters 2 and 3: the stiffness of a yielding surface, the complexity of the trees, what follows from the measured
// times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dissertation/cost/complexity.h"
#include "dissertation/numbers/numbers_study.h"
#include "palpate/tissue/force_law.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

// A leaf holds at most this many triangles (3.3.1), and no model has more than 100k (3.3.4).
constexpr double kThreshold = 1024.0;
constexpr double kMaxTriangles = 100000.0;

void addTree(const std::string& table, int arity, const std::vector<PrintedTree>& columns, Rows& rows) {
  for (const PrintedTree& column : columns) {
    const std::string where = fmt::format("{}, height {}", table, column.height);
    const WorstSearch ours = worstSearch(arity, column.height);
    rows.push_back(judged(where, "r", column.leaf_share, ours.leaf_ratio, "one leaf of the complete tree"));
    rows.push_back(judged(where, "share of nodes", column.node_share, ours.visit_ratio, "one path over all nodes"));
    rows.push_back(judged(where, "w", column.w, ours.w, "share of nodes over r"));
  }
}

// The tables' w as the text uses them: rounded to two decimals.
double roundedW(int arity, int height) { return std::round(100.0 * worstSearch(arity, height).w) / 100.0; }

double costOverLeaves(const PrintedNumbers& printed, int arity, const std::string& height) {
  const double share = parsePrinted(printed.largest_share_of_leaves).value;
  return visitedPerLeaf(arity, share, roundedW(arity, static_cast<int>(parsePrinted(height).value)));
}

double heightNeeded(int arity) { return std::ceil(heightOfCompleteTree(arity, kMaxTriangles / kThreshold)); }

// A printed time and a printed rate can be the same measurement when the rate lies within what both roundings allow.
NumberRow rateRow(const std::string& where, const PrintedTiming& timing) {
  const PrintedNumber ms = parsePrinted(timing.ms);
  const PrintedNumber fps = parsePrinted(timing.fps);
  const double least = 1000.0 / (ms.value + ms.tolerance) - fps.tolerance;
  const double most = 1000.0 / (ms.value - ms.tolerance) + fps.tolerance;
  const double ours = 1000.0 / ms.value;
  const bool agree = fps.value >= least && fps.value <= most;
  return {.where = where,
          .what = fmt::format("FPS at {} triangles", timing.triangles),
          .printed = timing.fps,
          .ours = fmt::format("{:.1f}", ours),
          .verdict = agree ? Verdict::arithmetic : Verdict::not_reproduced,
          .erratum = Erratum::none,
          .reason = fmt::format("1000 over {} ms", timing.ms),
          .tolerance = fmt::format("{:.1f} to {:.1f}: both roundings", least, most),
          .off_percent = offPercent(fps.value, ours)};
}

void addTimings(const std::string& table, const PrintedTimings& timings, Rows& rows) {
  for (const PrintedTiming& timing : timings.drawing) rows.push_back(rateRow(table + ", drawing", timing));
  for (const PrintedTiming& timing : timings.untouched) rows.push_back(rateRow(table + ", untouched", timing));
  for (const PrintedTiming& timing : timings.touched) rows.push_back(rateRow(table + ", touched", timing));
}

// "The haptic rendering rate is almost half of the graphic rendering".
void addHalfRate(const PrintedNumbers& printed, Rows& rows) {
  constexpr double kNear = 0.06;
  Extent share;
  for (const PrintedRate& rate : printed.table_3_1) share.add(rate.haptic_fps / rate.graphic_fps);
  const bool holds = share.least > 0.5 - kNear && share.most < 0.5 + kNear;
  rows.push_back({.where = "Table 3.1",
                  .what = "haptic over graphic rate",
                  .printed = "almost half",
                  .ours = fmt::format("{:.3f} to {:.3f}", share.least, share.most),
                  .verdict = holds ? Verdict::arithmetic : Verdict::not_reproduced,
                  .erratum = Erratum::none,
                  .reason = "of the five models",
                  .tolerance = fmt::format("{:.2f} to {:.2f}", 0.5 - kNear, 0.5 + kNear)});
}

void addTouchedRange(const PrintedNumbers& printed, Rows& rows) {
  const auto slower = [](const PrintedTiming& a, const PrintedTiming& b) {
    return parsePrinted(a.fps).value < parsePrinted(b.fps).value;
  };
  const auto& touched = printed.table_3_2.touched;
  const auto [least, most] = std::minmax_element(touched.begin(), touched.end(), slower);
  if (least == touched.end()) return;
  const std::string reason = "of the column \"touched\" of Table 3.2; without a partition 6 FPS";
  const auto add = [&](const std::string& what, const std::string& number, const PrintedTiming& timing) {
    rows.push_back(judged("3.3.4", what, number, parsePrinted(timing.fps).value, reason, Source::printed));
  };
  add("slowest touched rate, FPS", printed.fewest_touched_fps, *least);
  add("fastest touched rate, FPS", printed.most_touched_fps, *most);
}

}  // namespace

void addHaptics(const PrintedNumbers& printed, Rows& rows) {
  // A force f presses a surface of stiffness k in by f / k; where the surface yields by as much, the finger has gone
  // twice as far (2.3).
  constexpr double kStiffness = 0.5;  // N/mm; any
  constexpr double kDepth = 4.0;      // mm; any
  const double felt = tissue::normalForce({}, kStiffness, kDepth) / (2.0 * kDepth);
  rows.push_back(judged("2.3, (2.3)", "stiffness felt over stiffness set", printed.stiffness_left, felt / kStiffness,
                        "Hooke's law over twice the depth"));
}

void addPartitionComplexity(const PrintedNumbers& printed, Rows& rows) {
  addTree("Table 3.3", kBspArity, printed.table_3_3, rows);
  rows.push_back(judged("3.3.4", "height of the BSP tree of 100k triangles", printed.bsp_height,
                        heightNeeded(kBspArity), "(3.1) with leaves of 1024 triangles"));
  rows.push_back(judged("(3.5)", "nodes visited over leaves, BSP", printed.bsp_cost_over_n,
                        costOverLeaves(printed, kBspArity, printed.bsp_height),
                        "0.1 w 2; a real worst case is looser (docs/explanation/partition.md)"));
  addTree("Table 3.4", kOctreeArity, printed.table_3_4, rows);
  rows.push_back(judged("3.4.2", "height of the octree of 100k triangles", printed.octree_height,
                        heightNeeded(kOctreeArity), "(3.6) with leaves of 1024 triangles"));
  rows.push_back(judged("(3.9)", "nodes visited over leaves, octree", printed.octree_cost_over_n,
                        costOverLeaves(printed, kOctreeArity, printed.octree_height), "0.1 w 8/7"));
}

void addMeasuredRates(const PrintedNumbers& printed, Rows& rows) {
  addHalfRate(printed, rows);
  addTimings("Table 3.2", printed.table_3_2, rows);
  addTimings("Appendix B", printed.appendix_b, rows);
  addTouchedRange(printed, rows);
}

}  // namespace palpate::study
