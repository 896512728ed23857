// Data flow: printed number of triangles -> the place and box whose leaves hold about as many -> draw, collide, force,
// each timed by itself.
#include "dissertation/tables/rendering_rates.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "lab/measured/haptic_frames.h"
#include "lab/measured/literal_process.h"
#include "lab/measured/stopwatch.h"
#include "palpate/base/error.h"
#include "palpate/view/layers/immediate_drawing.h"

namespace palpate::study {

namespace {

using hdb::Partition;
using hdb::TreeKind;
using view::ImmediateDrawing;
using Drawing = std::unique_ptr<ImmediateDrawing>;

// Boxes that are tried, over the model's longest edge: from a few leaves to all of them.
constexpr double kBoxShares[] = {0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.8, 1.0};

// Draws as the dissertation's program: triangle by triangle, vertex by vertex, each with its normal.
void drawLeaves(const bench::literal::Mesh& mesh, const RenderedLeaves& leaves) {
  for (const auto& leaf : leaves) {
    for (const Index t : leaf) {
      for (const int corner : mesh.triangles[t].corners) {
        const bench::literal::Vertex& vertex = mesh.vertices[static_cast<std::size_t>(corner)];
        ImmediateDrawing::corner(vertex.normal, vertex.position);
      }
    }
  }
}

std::optional<double> captureMicroseconds(const Drawing& drawing, const HapticModel& model,
                                          const RenderedLeaves& leaves, int runs) {
  if (!drawing) return std::nullopt;
  const std::size_t triangles = countTriangles(leaves);
  const auto capture = [&] { drawing->capture(triangles, [&] { drawLeaves(model.literal, leaves); }); };
  capture();  // the first time compiles shaders
  return shortestMicroseconds(runs, capture);
}

std::optional<double> pictureMicroseconds(const Drawing& drawing, const HapticModel& model,
                                          const RenderedLeaves& leaves, int runs) {
  if (!drawing) return std::nullopt;
  const auto paint = [&] { drawing->paint([&] { drawLeaves(model.literal, leaves); }); };
  paint();
  return shortestMicroseconds(runs, paint);
}

Drawing createDrawing(const HapticModel& model, const RatesPlan& plan, RatesMeasurement& found) {
  try {
    auto drawing = std::make_unique<ImmediateDrawing>(mesh::boundingBox(model.mesh), plan.width_px, plan.height_px);
    found.renderer = drawing->renderer();
    return drawing;
  } catch (const Error& error) {
    found.no_renderer = error.what();
    return nullptr;
  }
}

WholeModelRow measuredWhole(std::size_t triangles, const RatesPlan& plan, RatesMeasurement& found) {
  const HapticModel model = hapticModel(triangles, 1);
  const Drawing drawing = createDrawing(model, plan, found);
  std::vector<Index> all(model.mesh.triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  const RenderedLeaves leaves = wholeModel(all);
  const FrameTimes frame = literalFrame(model, nullptr, 0.0, model.places.front(), plan.runs);
  return {.triangles = triangles,
          .draw_us = captureMicroseconds(drawing, model, leaves, plan.runs),
          .collide_us = frame.collide_us,
          .force_us = frame.force_us,
          .picture_us = pictureMicroseconds(drawing, model, leaves, plan.runs),
          .tick_us = meanTickMicroseconds(contactSurface(model.mesh), plan.runs)};
}

// ----------------------------------------------------------------------------------------------------- partitioned

struct Pose {
  const SkinPlace* place = nullptr;
  double edge_mm = 0.0;
  double triangles = 0.0;
};

std::vector<Pose> makePoses(const HapticModel& model, const Partition& tree) {
  std::vector<Pose> poses;
  hdb::LeafHits hits;
  hits.prepareFor(tree);
  for (const SkinPlace& place : model.places) {
    for (const double share : kBoxShares) {
      const double edge = share * model.longest_edge;
      hdb::findLeaves(tree, hdb::hapticBox(place.point, edge), hits);
      poses.push_back({&place, edge, static_cast<double>(hdb::entriesIn(tree, hits.leaves))});
    }
  }
  return poses;
}

const Pose& nearest(const std::vector<Pose>& poses, double triangles) {
  return *std::min_element(poses.begin(), poses.end(), [&](const Pose& a, const Pose& b) {
    return std::abs(a.triangles - triangles) < std::abs(b.triangles - triangles);
  });
}

FrameRow measuredFrame(const HapticModel& model, const Partition& tree, const Drawing& drawing, const Pose& pose,
                       int runs) {
  hdb::LeafHits hits;
  hdb::TriangleHits exact;
  exact.prepareFor(tree);
  const Box3 box = hdb::hapticBox(pose.place->point, pose.edge_mm);
  hdb::findLeaves(tree, box, hits);
  const FrameTimes frame = literalFrame(model, &tree, pose.edge_mm, *pose.place, runs);
  FrameRow row{.triangles = pose.triangles, .edge_mm = pose.edge_mm};
  row.draw_us = captureMicroseconds(drawing, model, collectHitLeaves(tree, hits), runs);
  row.find_us = frame.find_us;
  row.collide_us = frame.collide_us;
  row.force_us = frame.force_us;
  row.exact_us = shortestMicroseconds(runs, [&] {
    hdb::findTriangles(tree, box, exact);
    hdb::listTriangles(tree, exact);
  });
  return row;
}

TreeRates measuredTree(const HapticModel& model, TreeKind kind, const PrintedTimings& printed, const Drawing& drawing,
                       const RatesPlan& plan) {
  const Partition tree = hdb::buildPartition(model.mesh, {.tree = kind, .threshold = 1024});
  const std::vector<Pose> poses = makePoses(model, tree);
  // The printed counts are of 41,582 triangles; a smaller model renders the same share.
  const double scale = static_cast<double>(plan.partitioned) / 41582.0;
  const auto rows = [&](const std::vector<PrintedTiming>& timings) {
    std::vector<FrameRow> frames;
    for (const PrintedTiming& timing : timings) {
      frames.push_back(measuredFrame(model, tree, drawing, nearest(poses, scale * timing.triangles), plan.runs));
    }
    return frames;
  };
  return {rows(printed.drawing), rows(printed.untouched), rows(printed.touched)};
}

}  // namespace

RatesPlan ratesPlan(bool quick) {
  RatesPlan plan;
  if (!quick) return plan;
  plan.models = {2915, 6261};
  plan.partitioned = 8163;
  plan.places = 10;
  plan.runs = 1;
  plan.width_px = 80;
  plan.height_px = 60;
  return plan;
}

RatesMeasurement measureRates(const RatesPlan& plan, const Progress& progress) {
  RatesMeasurement found{.plan = plan};
  const double steps = static_cast<double>(plan.models.size()) + 2.0;
  for (const std::size_t triangles : plan.models) {
    report(progress, "tables: whole models", static_cast<double>(found.whole.size()) / steps);
    found.whole.push_back(measuredWhole(triangles, plan, found));
  }
  report(progress, "tables: partitioned model", static_cast<double>(plan.models.size()) / steps);
  const HapticModel model = hapticModel(plan.partitioned, plan.places);
  const Drawing drawing = createDrawing(model, plan, found);
  const PrintedNumbers printed = printedNumbers();
  found.bsp = measuredTree(model, TreeKind::Bsp, printed.table_3_2, drawing, plan);
  report(progress, "tables: partitioned model", 1.0 - 1.0 / steps);
  found.octree = measuredTree(model, TreeKind::Octree, printed.appendix_b, drawing, plan);
  found.tick_us = meanTickMicroseconds(contactSurface(model.mesh), plan.runs);
  return found;
}

}  // namespace palpate::study
