// The verdicts of the studies of chapter 3 are made of the numbers beside them: another number, another sentence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dissertation/assignment/assignment_measurement.h"
#include "dissertation/complexity/complexity_results.h"
#include "dissertation/cost/complexity.h"
#include "dissertation/hdb/hdb_measurement.h"
#include "dissertation/tables/rendering_rates.h"
#include "dissertation/threshold/threshold_measurement.h"
#include "report/tests/report/says.h"

namespace palpate::study {

namespace {

using hdb::Assignment;
using hdb::TreeKind;

// ---- rates: 100 ns a triangle whatever the model, 50 times as fast as printed

WholeModelRow wholeModel(std::size_t triangles) {
  const auto n = static_cast<double>(triangles);
  return {.triangles = triangles,
          .draw_us = 0.02 * n,
          .collide_us = 0.03 * n,
          .force_us = 0.05 * n,
          .picture_us = 0.2 * n,
          .tick_us = 0.1};
}

RatesMeasurement someRates() {
  RatesMeasurement found{.plan = {}, .renderer = "a renderer", .tick_us = 0.1};
  found.whole = {wholeModel(2915), wholeModel(41582)};
  for (TreeRates* rates : {&found.bsp, &found.octree}) {
    for (auto* rows : {&rates->drawing, &rates->untouched, &rates->touched}) {
      for (const double n : {1000.0, 10000.0}) {
        rows->push_back({.triangles = n,
                         .edge_mm = 50.0,
                         .draw_us = 0.02 * n,
                         .find_us = 0.3,
                         .collide_us = 0.03 * n,
                         .force_us = 0.05 * n,
                         .exact_us = 1.0});
      }
    }
  }
  return found;
}

}  // namespace

TEST(RatesVerdicts, OneLawOnlyWhileTheExponentsAgree) {
  RatesMeasurement found = someRates();
  EXPECT_TRUE(says(ratesFindings(found), "times as fast as in 2008, and the law is the same"));
  found.whole[1].force_us *= 20.0;  // the power -1.7 or so instead of -1
  EXPECT_TRUE(says(ratesFindings(found), "the law is another"));
  EXPECT_FALSE(says(ratesFindings(found), "the law is the same"));
}

TEST(RatesVerdicts, AQuickRunIsComparedWithThePrintedRatesOfItsOwnModels) {
  RatesMeasurement found = someRates();
  found.whole = {wholeModel(2915), wholeModel(6261)};
  EXPECT_TRUE(says(ratesFindings(found), "(printed 104 to 51)"));
  EXPECT_TRUE(says(ratesFindings(found), "the law is the same"));
}

TEST(RatesVerdicts, FasterOnlyWhereTheRatesAre) {
  RatesMeasurement found = someRates();
  for (WholeModelRow& row : found.whole) row.force_us = 1e6;
  EXPECT_TRUE(says(ratesFindings(found), "slower than in 2008"));
}

TEST(RatesVerdicts, TheOctreeGainsOnlyWhereATriangleCostsLess) {
  RatesMeasurement found = someRates();
  EXPECT_TRUE(says(ratesFindings(found), "the same within 10 %, so the printed gain is not seen here"));
  for (FrameRow& row : found.octree.touched) row.force_us *= 0.2;
  EXPECT_TRUE(says(ratesFindings(found), "less, so a gain is seen here too"));
  for (FrameRow& row : found.octree.touched) row.force_us *= 20.0;
  EXPECT_TRUE(says(ratesFindings(found), "more, so the printed gain is not seen here"));
}

TEST(RatesVerdicts, HalfTheGraphicRateOnlyWhereItIs) {
  RatesMeasurement found = someRates();
  EXPECT_TRUE(says(ratesFindings(found), "it does not hold here"));
  for (WholeModelRow& row : found.whole) row.picture_us = 0.5 * row.touchedMicroseconds();
  EXPECT_TRUE(says(ratesFindings(found), "it holds here as well"));
  found.whole[0].picture_us = 5.0 * found.whole[0].touchedMicroseconds();
  EXPECT_TRUE(says(ratesFindings(found), "it holds for some of the models here"));
  found.renderer.clear();
  EXPECT_TRUE(says(ratesFindings(found), "Pictures could not be measured"));
}

// ---- the detecting box

namespace {

HdbMeasurement someBoxes() {
  HdbMeasurement found{.plan = {}, .longest_edge = 400.0, .depth_mm = 8.0, .tick_us = 0.1, .fine_triangle_edge = 3.8};
  found.sizes = {{.share = 0.25,
                  .edge_mm = 100.0,
                  .bsp_triangles = 5800.0,
                  .octree_triangles = 5300.0,
                  .exact_triangles = 2400.0,
                  .bsp_us = 100.0,
                  .octree_us = 90.0,
                  .exact_us = 3.0}};
  const PunctureRow small{.edge_mm = 4.0, .speed_mm_s = 500.0, .delay_ticks = 10, .punctured = 1.0, .triangles = 10.0};
  const PunctureRow large{
      .edge_mm = 26.0, .speed_mm_s = 500.0, .delay_ticks = 10, .punctured = 0.0, .triangles = 245.0};
  found.punctures = {small, large};
  found.leaf_punctures = {{.edge_mm = 4.0, .speed_mm_s = 500.0, .delay_ticks = 10, .leaves = true, .punctured = 0.4},
                          large};
  found.leads = {small, large};
  found.margins = {{.depth_mm = 8.0, .share = 0.5, .punctured = 0.1},
                   {.depth_mm = 8.0, .share = 1.0, .punctured = 0.0}};
  found.recommended = found.fine_recommended = {large};
  found.fine_e12 = {{.edge_mm = 14.0, .speed_mm_s = 500.0, .delay_ticks = 10, .punctured = 0.05}};
  found.else_if_punctured = 1.0;
  return found;
}

}  // namespace

TEST(HdbVerdicts, TheRuleHeldOnlyWhileNoStrokeGotThrough) {
  HdbMeasurement found = someBoxes();
  EXPECT_TRUE(says(hdbFindings(found), "which held"));
  EXPECT_TRUE(says(hdbFindings(found), "none got through"));
  found.fine_recommended[0].punctured = 0.1;
  EXPECT_TRUE(says(hdbFindings(found), "which does NOT hold"));
}

TEST(HdbVerdicts, TheLargestTriangleIsNoSafeMarginOnlyWhileAStrokeGotThrough) {
  HdbMeasurement found = someBoxes();
  EXPECT_TRUE(says(hdbFindings(found), "is no safe margin: on 200,000 triangles (longest edge 3.8 mm) up to 5.0 %"));
  found.fine_e12[0].punctured = 0.0;
  EXPECT_FALSE(says(hdbFindings(found), "no safe margin"));
  EXPECT_TRUE(says(hdbFindings(found), "held all strokes here too"));
}

TEST(HdbVerdicts, AMarginIsEnoughOnlyWhereOneWas) {
  HdbMeasurement found = someBoxes();
  EXPECT_TRUE(says(hdbFindings(found), "1.0 times the depth was enough"));
  found.margins[1].punctured = 0.1;
  EXPECT_TRUE(says(hdbFindings(found), "no margin that was tried was enough"));
}

TEST(HdbVerdicts, LeadLeavesAndTraversalFollowTheirStrokes) {
  HdbMeasurement found = someBoxes();
  EXPECT_TRUE(says(hdbFindings(found), "One number decides"));
  EXPECT_TRUE(says(hdbFindings(found), "Leaves hide a small box: they reach beyond it, so that up to 60 %"));
  EXPECT_TRUE(says(hdbFindings(found), "lets all strokes through although"));
  found.leads[1].punctured = 0.9;
  found.leaf_punctures[0].punctured = 1.0;
  found.else_if_punctured = 0.0;
  EXPECT_TRUE(says(hdbFindings(found), "One number alone does not decide"));
  EXPECT_TRUE(says(hdbFindings(found), "hold no stroke more"));
  EXPECT_TRUE(says(hdbFindings(found), "held strokes with some size of box"));
}

TEST(HdbVerdicts, TheHybridPaysOnlyWhereItIsFaster) {
  HdbMeasurement found = someBoxes();
  EXPECT_FALSE(says(hdbFindings(found), "hybrid")) << "nothing was measured";
  using Query = hdb::HdbQuery;
  found.lists.models = {1000, 9000};
  found.lists.default_us = {0.2, 0.2};
  found.lists.build_us = {100.0, 900.0};
  for (const std::size_t model : found.lists.models) {
    for (const Query query : {Query::leaves, Query::triangles, Query::coherent, Query::linked}) {
      const double us = query != Query::linked ? 10.0 : model == 1000 ? 20.0 : 5.0;
      found.lists.rows.push_back({.model = model, .query = query, .tick_us = us, .same = true});
    }
  }
  EXPECT_TRUE(says(hdbFindings(found), "are the default finger's to the bit"));
  EXPECT_TRUE(says(hdbFindings(found),
                   "against the coherent list 2.0 times on 1,000 triangles, 0.50 times on 9,000 triangles: it pays on "
                   "fine meshes only"));
  found.lists.rows.back().tick_us = 11.0;
  found.lists.rows.back().same = false;
  EXPECT_TRUE(says(hdbFindings(found), "it is slower throughout"));
  EXPECT_TRUE(says(hdbFindings(found), "are NOT the default finger's"));
}

TEST(HdbVerdicts, AStrokeIsHeldByAQuarterOnlyWhereTheRuleSaysSo) {
  HdbMeasurement found = someBoxes();
  EXPECT_TRUE(says(hdbFindings(found), "is held by 1/4 and not by 1/10"));
  found.longest_edge = 100.0;
  EXPECT_TRUE(says(hdbFindings(found), "is held by neither"));
  found.longest_edge = 4000.0;
  EXPECT_TRUE(says(hdbFindings(found), "is held by both"));
}

// ---- cases A, B and C

namespace {

AssignmentRow someCase(TreeKind tree, Assignment assignment, Index threshold) {
  const double more = assignment == Assignment::Majority ? 1.0 : assignment == Assignment::BothSides ? 1.5 : 2.5;
  const bool small = threshold < 1000;
  return {.tree = tree,
          .assignment = assignment,
          .threshold = threshold,
          .leaves = 10,
          .stored = more,
          .overlap = assignment == Assignment::Cut ? 1.0 : 1.7,
          .bytes = 63.0 * more,
          .build_ns = 59.0 * more,
          .rendered = 5000.0 * more * (small ? (more > 1.0 ? 1.2 : 0.6) : 1.0),
          .wanted = 2400.0,
          .frame_us = 90.0 * more,
          .exact_us = 3.0 * more,
          .missed_else_if = 1.0};
}

AssignmentMeasurement someCases() {
  AssignmentMeasurement found{.plan = {.thresholds = {64, 1024}}, .lost_two_of_three = {0.03, 0.01}};
  for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
    for (const Assignment assignment : kAssignments) {
      for (const Index threshold : {Index{64}, Index{1024}})
        found.rows.push_back(someCase(tree, assignment, threshold));
    }
  }
  found.cut_area_error = 1e-14;
  return found;
}

AssignmentRow& octreeRow(AssignmentMeasurement& found, Assignment assignment, Index threshold) {
  return const_cast<AssignmentRow&>(findAssignmentRow(found, TreeKind::Octree, assignment, threshold));
}

}  // namespace

TEST(AssignmentVerdicts, CIsTheBestOnlyInWhatNoOtherCaseIsBetterIn) {
  AssignmentMeasurement found = someCases();
  EXPECT_TRUE(says(assignmentFindings(found), "building, the frame, our list; not in overlap of leaves"));
  octreeRow(found, Assignment::BothSides, 1024).frame_us = 10.0;
  EXPECT_TRUE(says(assignmentFindings(found), "building, our list; not in the frame, overlap of leaves"));
}

TEST(AssignmentVerdicts, SmallLeavesPayOnlyWhereTheyRenderLess) {
  AssignmentMeasurement found = someCases();
  EXPECT_TRUE(says(assignmentFindings(found), "Small leaves pay with C only"));
  octreeRow(found, Assignment::BothSides, 64).rendered = 100.0;
  EXPECT_TRUE(says(assignmentFindings(found), "Small leaves pay with C and B"));
  octreeRow(found, Assignment::Cut, 64).rendered = 100.0;
  EXPECT_TRUE(says(assignmentFindings(found), "Small leaves pay with every case"));
  for (const Assignment assignment : kAssignments) octreeRow(found, assignment, 64).rendered = 1e6;
  EXPECT_TRUE(says(assignmentFindings(found), "Small leaves pay with no case"));
}

TEST(AssignmentVerdicts, OverlapMissesAndAreaFollowTheirNumbers) {
  AssignmentMeasurement found = someCases();
  EXPECT_TRUE(says(assignmentFindings(found), "Leaves of A do not overlap at all"));
  EXPECT_TRUE(says(assignmentFindings(found), "Our search misses none"));
  EXPECT_TRUE(says(assignmentFindings(found), "Cutting is exact to rounding"));
  EXPECT_TRUE(says(assignmentFindings(found), "costs less than what A stores more"));
  octreeRow(found, Assignment::Cut, 1024).overlap = 1.4;
  octreeRow(found, Assignment::Cut, 1024).missed = 0.02;
  octreeRow(found, Assignment::Cut, 64).frame_us = 1.0;
  found.cut_area_error = 0.01;
  EXPECT_TRUE(says(assignmentFindings(found), "Leaves of A overlap by up to 1.40"));
  EXPECT_TRUE(says(assignmentFindings(found), "Our search misses up to 2.0 %"));
  EXPECT_TRUE(says(assignmentFindings(found), "Cutting is NOT exact"));
  EXPECT_TRUE(says(assignmentFindings(found), "That costs more than what A stores more"));
}

// ---- the threshold

namespace {

ThresholdMeasurement someThresholds() {
  ThresholdMeasurement found{.plan = {.sizes = {2962, 41582}, .thresholds = {64, 1024, 4096}}};
  for (const std::size_t model : found.plan.sizes) {
    for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
      for (const Index threshold : found.plan.thresholds) {
        const double rendered = std::min(static_cast<double>(model), 1000.0 + threshold);
        found.rows.push_back({.model = model,
                              .tree = tree,
                              .threshold = threshold,
                              .leaves = model / threshold + 1,
                              .height = 4,
                              .rendered = rendered,
                              .find_us = 0.1,
                              .touched_us = 0.01 * rendered,
                              .exact_us = 1.0});
      }
    }
  }
  found.exact_triangles = {500.0, 800.0};
  found.tick_us = {0.1, 0.13};
  return found;
}

void makeFastest(ThresholdMeasurement& found, Index threshold) {
  for (ThresholdRow& row : found.rows) row.touched_us = row.threshold == threshold ? 1.0 : 10.0;
}

}  // namespace

TEST(ThresholdVerdicts, ThePrintedOneIsTheBestOnlyWhereItIsTheFastest) {
  ThresholdMeasurement found = someThresholds();
  EXPECT_TRUE(says(thresholdFindings(found), "1024 is not the best for any of these models."));
  found.rows[1].touched_us = 0.5;
  EXPECT_TRUE(says(thresholdFindings(found), "1024 is the best for some of these models only."));
  makeFastest(found, 1024);
  EXPECT_TRUE(says(thresholdFindings(found), "1024 is the best for all of these models."));
  EXPECT_TRUE(says(thresholdFindings(found), "within 25 % of the fastest for models of 2,962, 41,582 triangles"));
}

TEST(ThresholdVerdicts, SearchSmallModelDrawingAndOursFollowTheirNumbers) {
  ThresholdMeasurement found = someThresholds();
  EXPECT_TRUE(says(thresholdFindings(found), "so it is never what costs most"));
  EXPECT_TRUE(says(thresholdFindings(found), "hardly a partition"));
  EXPECT_TRUE(says(thresholdFindings(found), "Ours depends less on this choice"));
  EXPECT_TRUE(says(thresholdFindings(found), "drawing does not move them down")) << "64 is the fastest already";
  for (ThresholdRow& row : found.rows) row.touched_us = 1000.0 / row.threshold;
  for (ThresholdRow& row : found.rows) row.rendered = 0.1 * row.threshold;
  found.rows[0].find_us = 0.9 * found.rows[0].touched_us;
  found.rows[0].exact_us = 1e4;
  EXPECT_TRUE(says(thresholdFindings(found), "so it can be what costs most"));
  EXPECT_FALSE(says(thresholdFindings(found), "hardly a partition"));
  EXPECT_TRUE(says(thresholdFindings(found), "Ours depends on this choice as much"));
  EXPECT_TRUE(says(thresholdFindings(found), "drawing moves them down"));
}

// ---- what a search costs

namespace {

SearchCase someSearch(TreeKind tree, Index threshold, int part) {
  SearchCase one{.model = "back of 2,962", .tree = tree, .threshold = threshold, .part = part, .sweep = {}};
  const double leaves = threshold == 64 ? 640.0 : 40.0;
  one.sweep.height = 5;
  one.sweep.leaves = leaves;
  one.sweep.nodes = 2.0 * leaves - 1.0;
  one.sweep.worst = {.leaves_found = 0.2 * leaves,
                     .on_paths = 0.5 * leaves,
                     .entered = 0.6 * leaves,
                     .tested = 1.2 * std::sqrt(leaves * 40.0)};
  one.sweep.mean = {.leaves_found = 0.1 * leaves,
                    .on_paths = 0.2 * leaves,
                    .entered = 0.3 * leaves,
                    .tested = (tree == TreeKind::Bsp ? 0.4 : 0.5) * leaves};
  one.sweep.worst_over_bound = 0.9;
  one.sweep.queries = {one.sweep.mean, one.sweep.worst};
  return one;
}

ComplexityResults someSearches() {
  ComplexityResults results;
  results.largest_model = "back of 2,962";
  for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
    for (const Index threshold : {Index{64}, Index{1024}}) {
      for (const int part : {16, 4}) results.cases.push_back(someSearch(tree, threshold, part));
    }
  }
  const auto column = [](int height, double printed) {
    const double w = worstSearch(kBspArity, height).w;
    return WorstColumn{TreeKind::Bsp, height, printed, w, w};
  };
  results.columns = {column(3, 2.13), column(5, 3.04)};
  return results;
}

}  // namespace

TEST(ComplexityVerdicts, AMismatchIsAMisprintOnlyWhereTheListHasItAndOursIsRight) {
  ComplexityResults results = someSearches();
  EXPECT_EQ(verdictText(columnVerdict(results.columns[0])), "reproduced");
  EXPECT_EQ(verdictText(columnVerdict(results.columns[1])), "misprint (E13)");
  EXPECT_TRUE(
      says(complexityFindings(results), "w is what the closed form says. 1 of the 2 printed values come out, 1 are"));
  results.columns[1].counted = 3.3;
  EXPECT_EQ(verdictText(columnVerdict(results.columns[1])), "NOT REPRODUCED");
  EXPECT_TRUE(says(complexityFindings(results), "w is NOT what the closed form says"));
  EXPECT_TRUE(says(complexityFindings(results), "1 do NOT, and no erratum says why"));
  results.columns[0].printed = 2.99;
  EXPECT_EQ(verdictText(columnVerdict(results.columns[0])), "NOT REPRODUCED");
}

TEST(ComplexityVerdicts, EstimatesHoldOnlyWhereTheCountsKeepToThem) {
  ComplexityResults results = someSearches();
  EXPECT_TRUE(says(complexityFindings(results), "0.8 n and 0.4 n are no worst cases"));
  EXPECT_TRUE(says(complexityFindings(results), "here more do"));
  EXPECT_TRUE(says(complexityFindings(results), "was kept by every search"));
  EXPECT_TRUE(says(complexityFindings(results), "more slowly than the tree"));
  EXPECT_TRUE(says(complexityFindings(results), "the BSP tree is better here"));
  for (SearchCase& one : results.cases) {
    one.sweep.worst = {.leaves_found = 0.05 * one.sweep.leaves, .tested = 0.3 * one.sweep.leaves};
    one.sweep.mean.tested = one.tree == TreeKind::Bsp ? 50.0 : 20.0;
    one.sweep.worst_over_bound = 1.2;
  }
  EXPECT_TRUE(says(complexityFindings(results), "kept to 0.8 n and 0.4 n"));
  EXPECT_TRUE(says(complexityFindings(results), "so it is here"));
  EXPECT_TRUE(says(complexityFindings(results), "was NOT kept by every search"));
  EXPECT_TRUE(says(complexityFindings(results), "as fast as the tree, or faster"));
  EXPECT_TRUE(says(complexityFindings(results), "the octree is better here"));
  results.cases[0].sweep.worst.tested = 1e6;
  EXPECT_TRUE(says(complexityFindings(results), "Some search tested a box twice"));
}

}  // namespace palpate::study
