// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/hdb/hdb_measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dissertation/numbers/number_row.h"
#include "dissertation/numbers/printed_numbers.h"

namespace palpate::study {

namespace {

/// The stroke that a box of 2008 is held against, mm/s: that of the benchmark's slide.
constexpr double kUsualStroke = 200.0;
// Leads up to which every stroke should get through, and from which none should.
constexpr double kTooSmall = 0.5;
constexpr double kLargeEnough = 1.25;

/// The printed times of a touched frame with a BSP tree, s.
struct PrintedDelays {
  double shortest = 0.0;
  double longest = 0.0;
};

PrintedDelays printedDelays() {
  const auto rows = printedNumbers().table_3_2.touched;
  return {1e-3 * parsePrinted(rows.front().ms).value, 1e-3 * parsePrinted(rows.back().ms).value};
}

std::string strokesOf(double share) {
  if (share == 0.0) return "none of the strokes";
  return share == 1.0 ? "all strokes" : percent(share) + " of the strokes";
}

std::string atLeast(double share) { return share == 1.0 ? strokesOf(share) : "at least " + strokesOf(share); }

std::string atMost(double share) { return share == 0.0 ? strokesOf(share) : strokesOf(share) + " at most"; }

std::string ruleFinding(const HdbMeasurement& found) {
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  const double worst = std::max(mostPunctured(found.recommended), mostPunctured(found.fine_recommended));
  const double strokes = static_cast<double>(found.plan.strokes) *
                         static_cast<double>(found.recommended.size() + found.fine_recommended.size());
  return fmt::format(
      "{}: **edge = 2 (speed x delay + depth)**, with the speed of the finger now, the longest time until the box "
      "follows, and the depth that the tip may have. Of {} strokes that were not used before, {} of each speed and "
      "delay "
      "on models of {} and {} triangles, {} got through. For {} m/s and {} ms the box is {} mm wide and holds {} "
      "triangles: {} of what the leaves of a BSP tree render for 1/4, {} of the model.",
      worst == 0.0 ? "A rule in place of the guess, which held" : "A rule in place of the guess, which does NOT hold",
      counted(strokes), found.plan.strokes, counted(static_cast<double>(found.plan.triangles)),
      counted(static_cast<double>(found.plan.fine_triangles)),
      worst == 0.0 ? "none" : "up to " + strokesOf(worst) + " of a speed and delay",
      rounded(metresPerSecond(usual.speed_mm_s)), usual.delay_ticks, rounded(usual.edge_mm), counted(usual.triangles),
      percent(usual.triangles / quarterRow(found).bsp_triangles),
      percent(usual.triangles / static_cast<double>(found.plan.triangles)));
}

std::string measuredMargin(const HdbMeasurement& found) {
  const double margin = safeMargin(found);
  const std::string depths =
      fmt::format("every depth from {:g} to {:g} mm", found.plan.depths_mm.front(), found.plan.depths_mm.back());
  if (std::isinf(margin)) return "no margin that was tried was enough for " + depths;
  return margin == 0.0 ? "no margin at all was needed for " + depths
                       : fmt::format("{} times the depth was enough for {}", rounded(margin), depths);
}

std::string marginFinding(const HdbMeasurement& found) {
  const double e12 = mostPunctured(found.fine_e12);
  return fmt::format(
      "Why the depth: the proxy is never farther from the tip than that. Between two boxes the tip makes speed x "
      "delay, "
      "so the proxy makes at most that plus the depth before and the depth after; measured, {}. The largest triangle, "
      "which E12 adds instead, {}: on {} triangles (longest edge {} mm) {} get through with it.",
      measuredMargin(found), e12 > 0.0 ? "is no safe margin" : "held all strokes here too",
      counted(static_cast<double>(found.plan.fine_triangles)), rounded(found.fine_triangle_edge),
      e12 > 0.0 ? "up to " + strokesOf(e12) : strokesOf(e12));
}

std::string leadFinding(const HdbMeasurement& found) {
  const double below = leastPunctured(found.leads, kTooSmall);
  const double above = mostPunctured(found.leads, kLargeEnough);
  const bool decides = below > 0.5 && above < 0.5;
  return fmt::format(
      "{}: half the edge over the way that the finger makes until the box follows. Up to {:g}, {} get through; from "
      "{:g} on {}, over all speeds and delays tried.{}",
      decides ? "One number decides" : "One number alone does not decide", kTooSmall, atLeast(below), kLargeEnough,
      atMost(above),
      above > 0.0
          ? " That some do beyond 1 may come from the proxy, which is faster than the tip where the body curves "
            "outwards and snaps forward behind a ridge; the rule's depth is room for it."
          : "");
}

std::string ofStroke(double safe_small, double safe_large) {
  const std::string stroke = fmt::format("a stroke of {} m/s", rounded(metresPerSecond(kUsualStroke)));
  if (safe_small >= kUsualStroke && safe_large >= kUsualStroke) return stroke + " is held by both";
  if (safe_large >= kUsualStroke) return stroke + " is held by 1/4 and not by 1/10 at the longest of these times";
  return stroke + " is held by neither at the longest of these times";
}

std::string quarterFinding(const HdbMeasurement& found) {
  const PrintedDelays printed = printedDelays();
  const auto safe = [&](double share, double delay) {
    return safeSpeed(share * found.longest_edge, delay, found.depth_mm);
  };
  const auto metres = [&](double share, double delay) { return rounded(metresPerSecond(safe(share, delay))); };
  const double fastest = *std::max_element(found.plan.speeds_mm_s.begin(), found.plan.speeds_mm_s.end());
  return fmt::format(
      "Is 1/4 right? In 2008 touched frames took {} to {} ms (Table 3.2). By the rule a quarter of this model, {} mm, "
      "is "
      "then safe up to {} and {} m/s, and 1/10 up to {} and {} m/s (\"the proxy might get through the model surface "
      "frequently\"): {}. With a collision thread of 100 Hz, 1/4 is safe up to {} m/s, {} times the fastest stroke "
      "tried "
      "here. The rule has no size of a model in it: on one twice as long 1/4 is twice as wide for the same finger.",
      rounded(1e3 * printed.shortest, 3), rounded(1e3 * printed.longest, 3),
      rounded(kPrintedBoxShare * found.longest_edge, 3), metres(kPrintedBoxShare, printed.shortest),
      metres(kPrintedBoxShare, printed.longest), metres(kTenth, printed.shortest), metres(kTenth, printed.longest),
      ofStroke(safe(kTenth, printed.longest), safe(kPrintedBoxShare, printed.longest)), metres(kPrintedBoxShare, 0.01),
      rounded(safe(kPrintedBoxShare, 0.01) / fastest));
}

std::string costFinding(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const auto all = static_cast<double>(found.plan.triangles);
  return fmt::format(
      "What 1/4 costs on {} triangles: the box meets {} of them on average ({}), the leaves that it meets hold {} "
      "(BSP, {}) and {} (octree, {}); the text says a third in one place and a tenth in another. A frame that tests "
      "them all takes {} us (BSP) and {} us (octree) here, our exact list {} us, and the default finger, which needs "
      "no box, {} us.",
      counted(all), counted(quarter.exact_triangles), percent(quarter.exact_triangles / all),
      counted(quarter.bsp_triangles), percent(quarter.bsp_triangles / all), counted(quarter.octree_triangles),
      percent(quarter.octree_triangles / all), rounded(quarter.bsp_us), rounded(quarter.octree_us),
      rounded(quarter.exact_us), rounded(found.tick_us));
}

std::string leavesFinding(const HdbMeasurement& found) {
  double hidden = 0.0;  // strokes that only the leaves' overhang saved, in the worst case
  for (std::size_t i = 0; i < found.punctures.size(); ++i) {
    hidden = std::max(hidden, found.punctures[i].punctured - found.leaf_punctures[i].punctured);
  }
  if (hidden == 0.0) return "All triangles of the leaves hold no stroke more than the box's own triangles do.";
  return fmt::format(
      "Leaves hide a small box: they reach beyond it, so that up to {} of the strokes more are held than by the box's "
      "own triangles. This is luck and not a margin, because a leaf may end right behind the box.",
      percent(hidden));
}

std::string elseIfFinding(const HdbMeasurement& found) {
  const double through = found.else_if_punctured;
  const std::string boxes = "although the box follows at every tick, with 1/16, 1/4 and the whole model alike";
  if (through == 0.0)
    return "The printed traversal, ELSEIF for the second child (E4), held strokes with some size of box.";
  return fmt::format(
      "The printed traversal, ELSEIF for the second child (E4), lets {} through {}: no size of box{} mends that.",
      atLeast(through), boxes, through < 1.0 ? " tried here" : "");
}

const char* verdictOnHybrid(double on_smallest, double on_largest) {
  if (on_smallest < 1.0 && on_largest < 1.0) return "it is faster throughout";
  if (on_smallest >= 1.0 && on_largest >= 1.0) return "it is slower throughout";
  return on_largest < 1.0 ? "it pays on fine meshes only" : "it pays on coarse meshes only";
}

std::string times(double ratio) { return rounded(ratio) + " times"; }

/// What the hybrid does on the largest model, against the other lists in the same run.
std::string listFinding(const HdbMeasurement& found) {
  const ListCosts& costs = found.lists;
  const std::size_t model = costs.models.back();
  const ListRow& leaves = *rowOf(costs, model, hdb::HdbQuery::leaves);
  const ListRow& exact = *rowOf(costs, model, hdb::HdbQuery::triangles);
  const ListRow& coherent = *rowOf(costs, model, hdb::HdbQuery::coherent);
  const ListRow& linked = *rowOf(costs, model, hdb::HdbQuery::linked);
  const bool same = std::all_of(costs.rows.begin(), costs.rows.end(), [](const ListRow& row) { return row.same; });
  std::vector<std::string> against_coherent;
  std::vector<double> ratios;
  for (const std::size_t other : costs.models) {
    const double ratio =
        rowOf(costs, other, hdb::HdbQuery::linked)->tick_us / rowOf(costs, other, hdb::HdbQuery::coherent)->tick_us;
    ratios.push_back(ratio);
    against_coherent.push_back(fmt::format("{} on {} triangles", times(ratio), counted(static_cast<double>(other))));
  }
  return fmt::format(
      "The list of 6.2 (4) was built in two ways: a coherent list with a margin, and a hybrid of octree and linked "
      "list "
      "that marks and unmarks what the faces of the box pass. With every list all forces and proxies {} the default "
      "finger's to the bit. On {} triangles the hybrid lists {} a tick, exactly those that the box meets, where the "
      "coherent list has {} and the leaves {}; it tests {} boxes a tick to follow the box and {} to find what is near "
      "the finger, where the exact list is asked again and {} are tested, and the coherent list tests {}. Its tick "
      "takes "
      "{} as long as with the exact list and {} as long as with the leaves; against the coherent list {}: {}. The "
      "default finger, which needs no list, takes {} of it. A finger's list takes {} bytes a triangle (coherent {}) "
      "and {} of "
      "the time that the partition takes to build.",
      same ? "are" : "are NOT", counted(static_cast<double>(model)), counted(linked.listed), counted(coherent.listed),
      counted(leaves.listed), counted(linked.moved), counted(linked.tested), counted(exact.tested),
      counted(coherent.tested), times(linked.tick_us / exact.tick_us), times(linked.tick_us / leaves.tick_us),
      fmt::format("{}", fmt::join(against_coherent, ", ")), verdictOnHybrid(ratios.front(), ratios.back()),
      percent(costs.default_us.back() / linked.tick_us), rounded(linked.bytes / static_cast<double>(model)),
      rounded(coherent.bytes / static_cast<double>(model)), percent(linked.make_us / costs.build_us.back()));
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
  std::vector<std::string> findings = {ruleFinding(found),    marginFinding(found), leadFinding(found),
                                       quarterFinding(found), costFinding(found),   leavesFinding(found),
                                       elseIfFinding(found)};
  if (!found.lists.models.empty()) findings.push_back(listFinding(found));
  return findings;
}

}  // namespace palpate::study
