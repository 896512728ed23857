// One sweep over sizes for the cost of a frame, then strokes with a late box over edges, speeds, delays and margins.
// The rule that comes of it is tried on strokes and on a finer model that no other part of the study saw. Based on: Ji,
// dissertation 2008, 3.3.3, with E4 and E12; the rule is our own.
#include "dissertation/hdb/hdb_measurement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "lab/measured/finger_strokes.h"
#include "lab/measured/haptic_frames.h"
#include "lab/measured/model_meshes.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/contact/finger.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/hdb/hdb_finger.h"

namespace palpate::study {

namespace {

struct LateBoxResult {
  int strokes = 0;
  int punctured = 0;         ///< strokes in which the tip was inside the body and nothing held it
  double mean_listed = 0.0;  ///< triangles in the box's list, of the ticks in contact

  double puncturedShare() const { return strokes > 0 ? static_cast<double>(punctured) / strokes : 0.0; }
};

// Above any skin of the benchmark's back, mm.
constexpr double kSkyMm = 1000.0;

// The skin is a height field: the tip is inside where a line from above meets skin before it.
bool isUnderSkin(const contact::Surface& surface, const Vec3& tip) {
  const Vec3 above(tip.x(), tip.y(), kSkyMm);
  return tree::firstFrontCrossing(surface.geometry->tree, above, tip).triangle != kNoIndex;
}

struct Listed {
  double sum = 0.0;
  double ticks = 0.0;
};

bool isPunctured(const contact::Surface& surface, const contact::FingerSettings& finger, hdb::HdbCandidates& candidates,
                 const std::vector<Vec3>& stroke, Listed& listed) {
  contact::FingerState state;
  for (const Vec3& tip : stroke) {
    const contact::FingerOutput output = hdb::stepHdb(surface, finger, candidates, state, tip);
    if (state.touching) {
      listed.sum += static_cast<double>(candidates.size());
      listed.ticks += 1.0;
    } else if (isUnderSkin(surface, output.tip)) {
      return true;
    }
  }
  return false;
}

/// A finger whose haptic detecting box follows late, and how often it gets through the skin (3.3.3, E12):
///
///   stroke ─► stepHdb, tick by tick ─► a tick without contact is checked by the height of the skin above its tip
///
/// Every stroke starts with a new finger and ends at its puncture. `box` sets the size of the box and after how many
/// ticks it follows. Each stroke has a list of its own, whose refreshes are put off by another number of ticks: a
/// puncture depends on where in its delay the box is when the finger comes.
LateBoxResult strokeWithLateBox(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                                const std::vector<std::vector<Vec3>>& strokes,
                                const contact::FingerSettings& finger = {}) {
  LateBoxResult result;
  Listed listed;
  std::uint32_t phase = 0;
  for (const auto& stroke : strokes) {
    hdb::HdbCandidates candidates(box);
    if (stroke.empty()) continue;
    for (std::uint32_t i = 0; i < phase; ++i) candidates.refresh(stroke.front());
    phase = (phase + 3) % box->settings.ticks_per_refresh;  // 3: no divisor of the usual numbers of ticks
    ++result.strokes;
    if (isPunctured(surface, finger, candidates, stroke, listed)) ++result.punctured;
  }
  result.mean_listed = listed.ticks > 0.0 ? listed.sum / listed.ticks : 0.0;
  return result;
}

using hdb::HdbQuery;
using hdb::TreeKind;
using SharedPartition = std::shared_ptr<const hdb::Partition>;

// Half the edge over the finger's way until the box follows: around 1, where it must turn out.
constexpr double kLeads[] = {0.25, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0};
// Strokes that no other part of the study saw.
constexpr std::uint64_t kUnseenSeed = 77;
constexpr std::uint64_t kMarginSeed = 5;
constexpr double kSlideMm = 160.0;

SharedPartition makePartition(const mesh::TriangleMesh& mesh, TreeKind tree) {
  return std::make_shared<const hdb::Partition>(hdb::buildPartition(mesh, {.tree = tree, .threshold = 1024}));
}

/// Data that all runs of strokes share.
struct Strokes {
  const HdbPlan& plan;
  const contact::Surface& surface;
  SharedPartition octree;

  std::vector<std::vector<Vec3>> at(double speed, std::uint64_t seed = 1) const {
    return fingerStrokes({.count = plan.strokes, .speed_mm_s = speed, .slide_mm = kSlideMm, .seed = seed});
  }
  PunctureRow run(const std::vector<std::vector<Vec3>>& strokes, PunctureRow row) const {
    hdb::HdbSettings box;
    box.edges_mm = Vec3::Constant(row.edge_mm);
    box.query = row.leaves ? HdbQuery::leaves : HdbQuery::triangles;
    box.ticks_per_refresh = static_cast<std::uint32_t>(row.delay_ticks);
    const LateBoxResult result = strokeWithLateBox(surface, hdb::makeHdbSurface(surface, octree, box), strokes);
    row.punctured = result.puncturedShare();
    row.triangles = result.mean_listed;
    return row;
  }
};

std::vector<HdbSizeRow> sizeRows(const HdbPlan& plan, const HapticModel& model, const SharedPartition& octree,
                                 const Progress& progress) {
  const SharedPartition bsp = makePartition(model.mesh, TreeKind::Bsp);
  std::vector<HdbSizeRow> rows;
  for (const double share : plan.shares) {
    report(progress, "hdb: sizes of the box", 0.15 * static_cast<double>(rows.size()) / plan.shares.size());
    HdbSizeRow row{.share = share, .edge_mm = share * model.longest_edge};
    const FrameTimes in_bsp = meanLiteralFrame(model, bsp.get(), row.edge_mm, plan.runs);
    const FrameTimes in_octree = meanLiteralFrame(model, octree.get(), row.edge_mm, plan.runs);
    const ExactFrame exact = meanExactFrame(model, *octree, row.edge_mm, plan.runs);
    row.bsp_triangles = in_bsp.triangles;
    row.bsp_us = in_bsp.touchedMicroseconds();
    row.octree_triangles = in_octree.triangles;
    row.octree_us = in_octree.touchedMicroseconds();
    row.exact_triangles = exact.triangles;
    row.exact_us = exact.find_us;
    rows.push_back(row);
  }
  return rows;
}

std::vector<PunctureRow> edgeRows(const Strokes& strokes, bool leaves, const Progress& progress, double done) {
  std::vector<PunctureRow> rows;
  const HdbPlan& plan = strokes.plan;
  for (const double speed : plan.speeds_mm_s) {
    const auto ways = strokes.at(speed);
    for (const double edge : plan.edges_mm) {
      report(progress, "hdb: punctures",
             done + 0.25 * static_cast<double>(rows.size()) / (plan.speeds_mm_s.size() * plan.edges_mm.size()));
      rows.push_back(strokes.run(
          ways, {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = plan.delays_ticks.front(), .leaves = leaves}));
    }
  }
  return rows;
}

/// Calls visit(speed, delay) for all of the plan's.
template <class Visit>
void visitMotions(const HdbPlan& plan, Visit&& visit) {
  for (const int delay : plan.delays_ticks) {
    for (const double speed : plan.speeds_mm_s) visit(speed, delay);
  }
}

double distanceTravelled(double speed, int delay) { return 1e-3 * speed * delay; }

std::vector<PunctureRow> leadRows(const Strokes& strokes, const Progress& progress) {
  std::vector<PunctureRow> rows;
  visitMotions(strokes.plan, [&](double speed, int delay) {
    report(progress, "hdb: punctures against the way of the finger", 0.65 + 0.0005 * static_cast<double>(rows.size()));
    const auto ways = strokes.at(speed);
    for (const double lead : kLeads) {
      const double edge = 2.0 * lead * distanceTravelled(speed, delay);
      rows.push_back(strokes.run(ways, {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = delay}));
    }
  });
  return rows;
}

// A quarter of the strokes for each speed and delay: there are many of these.
MarginRow marginRow(const Strokes& strokes, double depth, double share) {
  double punctured = 0.0;
  double motions = 0.0;
  visitMotions(strokes.plan, [&](double speed, int delay) {
    const auto ways = fingerStrokes({.count = std::max(1, strokes.plan.strokes / 4),
                                     .speed_mm_s = speed,
                                     .depth_mm = depth,
                                     .slide_mm = kSlideMm,
                                     .seed = kMarginSeed});
    const double edge = 2.0 * (distanceTravelled(speed, delay) + share * depth);
    punctured += strokes.run(ways, {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = delay}).punctured;
    motions += 1.0;
  });
  return {depth, share, punctured / motions};
}

std::vector<MarginRow> marginRows(const Strokes& strokes, const Progress& progress) {
  std::vector<MarginRow> rows;
  for (const double depth : strokes.plan.depths_mm) {
    for (const double share : strokes.plan.margin_shares) {
      report(progress, "hdb: margins", 0.75 + 0.003 * static_cast<double>(rows.size()));
      rows.push_back(marginRow(strokes, depth, share));
    }
  }
  return rows;
}

// The edge is 2 (speed x delay + margin).
std::vector<PunctureRow> ruleRows(const Strokes& strokes, double margin, const Progress& progress, double done) {
  std::vector<PunctureRow> rows;
  visitMotions(strokes.plan, [&](double speed, int delay) {
    report(progress, "hdb: rules", done);
    const double edge = hdb::leastHdbEdge(speed, 1e-3 * delay, margin);
    rows.push_back(
        strokes.run(strokes.at(speed, kUnseenSeed), {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = delay}));
  });
  return rows;
}

void measureFineModel(const HdbPlan& plan, const Progress& progress, HdbMeasurement& found) {
  report(progress, "hdb: building the fine model", 0.9);
  const mesh::TriangleMesh mesh = lab::backMesh(plan.fine_triangles);
  const contact::Surface surface = contactSurface(mesh);
  const Strokes strokes{plan, surface, makePartition(mesh, TreeKind::Octree)};
  found.fine_triangle_edge = longestTriangleEdge(mesh);
  found.fine_e12 = ruleRows(strokes, found.fine_triangle_edge, progress, 0.93);
  found.fine_recommended = ruleRows(strokes, found.depth_mm, progress, 0.96);
}

// The pseudocode of 3.3.3 with a box that follows at every tick.
double elseIfPunctures(const Strokes& strokes, const HapticModel& model) {
  const SharedPartition bsp = makePartition(model.mesh, TreeKind::Bsp);
  const auto ways = strokes.at(200.0);
  double least = 1.0;
  for (const double share : kElseIfShares) {
    hdb::HdbSettings box;
    box.edges_mm = Vec3::Constant(share * model.longest_edge);
    box.literal = hdb::LiteralTraversal::ElseIf;
    const auto shared = hdb::makeHdbSurface(strokes.surface, bsp, box);
    least = std::min(least, strokeWithLateBox(strokes.surface, shared, ways).puncturedShare());
  }
  return least;
}

}  // namespace

HdbPlan hdbPlan(bool quick) {
  HdbPlan plan;
  if (!quick) return plan;
  plan.triangles = 8163;
  plan.places = 6;
  plan.runs = 1;
  plan.strokes = 8;
  plan.shares = {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0};
  plan.edges_mm = {4, 16, 50, 100};
  plan.speeds_mm_s = {500, 2000};
  plan.delays_ticks = {10, 20};
  plan.depths_mm = {2, 12};
  plan.margin_shares = {0.0, 1.0};
  plan.fine_triangles = 20389;
  plan.lists = {.models = {2962, 20389}, .strokes = 3, .runs = 1};
  return plan;
}

double safeSpeed(double edge_mm, double delay_s, double depth_mm) {
  return std::max(0.0, 0.5 * edge_mm - depth_mm) / delay_s;
}

const HdbSizeRow& quarterRow(const HdbMeasurement& found) {
  return *std::min_element(found.sizes.begin(), found.sizes.end(), [](const HdbSizeRow& a, const HdbSizeRow& b) {
    return std::abs(a.share - kPrintedBoxShare) < std::abs(b.share - kPrintedBoxShare);
  });
}

HdbMeasurement measureHdbSizes(const HdbPlan& plan, const Progress& progress) {
  report(progress, "hdb: building the model", 0.0);
  const HapticModel model = hapticModel(plan.triangles, plan.places);
  const contact::Surface surface = contactSurface(model.mesh);
  const SharedPartition octree = makePartition(model.mesh, TreeKind::Octree);
  const Strokes strokes{plan, surface, octree};
  HdbMeasurement found{.plan = plan};
  found.longest_edge = model.longest_edge;
  found.depth_mm = StrokeSettings{}.depth_mm;
  found.lists = measureLists(plan.lists);
  found.tick_us = meanTickMicroseconds(surface, plan.runs);
  found.sizes = sizeRows(plan, model, octree, progress);
  found.punctures = edgeRows(strokes, false, progress, 0.15);
  found.leaf_punctures = edgeRows(strokes, true, progress, 0.4);
  found.leads = leadRows(strokes, progress);
  found.margins = marginRows(strokes, progress);
  found.recommended = ruleRows(strokes, found.depth_mm, progress, 0.88);
  found.else_if_punctured = elseIfPunctures(strokes, model);
  measureFineModel(plan, progress, found);
  return found;
}

}  // namespace palpate::study
