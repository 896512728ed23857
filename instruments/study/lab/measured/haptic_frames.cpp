// Each part of a frame is run alone, several times, and the shortest counts: other load only ever adds. Results are
// kept, or the optimiser would leave the work out. Times literal_process.h and the engine.
#include "lab/measured/haptic_frames.h"

#include <numeric>

#include "lab/measured/finger_strokes.h"
#include "lab/measured/literal_process.h"
#include "lab/measured/stopwatch.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/contact/finger.h"

namespace palpate::study {

namespace {

constexpr double kAboveMm = 1.0;
constexpr double kDepthMm = 5.0;
constexpr double kAnyStiffness = 0.5;  // N/mm
constexpr int kStrokes = 6;

/// Keeps a result alive that is computed for its time only.
template <class T>
void doNotOptimise(const T& value) {
  volatile auto kept = value;
  (void)kept;
}

std::vector<Index> allTriangles(const mesh::TriangleMesh& mesh) {
  std::vector<Index> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace

HapticModel hapticModel(std::size_t triangles, int places) {
  HapticModel model;
  model.mesh = lab::backMesh(triangles);
  model.literal = bench::literal::buildMesh(model.mesh);
  model.places = skinPlaces(model.mesh, places);
  model.longest_edge = mesh::boundingBox(model.mesh).sizes().maxCoeff();
  return model;
}

FrameTimes literalFrame(const HapticModel& model, const hdb::Partition* partition, double edge_mm,
                        const SkinPlace& place, int runs) {
  FrameTimes times;
  RenderedLeaves leaves;
  std::vector<Index> all;
  if (partition == nullptr) {
    all = allTriangles(model.mesh);
    leaves = wholeModel(all);
  } else {
    hdb::LeafHits hits;
    hits.prepareFor(*partition);
    times.find_us = shortestMicroseconds(runs, [&] {
      hdb::findLeaves(*partition, hdb::hapticBox(place.point, edge_mm), hits);
      leaves = collectHitLeaves(*partition, hits);
    });
  }
  const Vec3 above = place.point + kAboveMm * place.normal;
  const Vec3 tip = place.point - kDepthMm * place.normal;
  times.triangles = static_cast<double>(countTriangles(leaves));
  times.collide_us =
      shortestMicroseconds(runs, [&] { doNotOptimise(collide(model.literal, leaves, above, tip).fraction); });
  times.force_us =
      shortestMicroseconds(runs, [&] { doNotOptimise(touchForce(model.literal, leaves, tip, place.point).x()); });
  return times;
}

FrameTimes meanLiteralFrame(const HapticModel& model, const hdb::Partition* partition, double edge_mm, int runs) {
  FrameTimes mean;
  const double share = 1.0 / static_cast<double>(model.places.size());
  for (const SkinPlace& place : model.places) {
    const FrameTimes frame = literalFrame(model, partition, edge_mm, place, runs);
    mean.triangles += share * frame.triangles;
    mean.find_us += share * frame.find_us;
    mean.collide_us += share * frame.collide_us;
    mean.force_us += share * frame.force_us;
  }
  return mean;
}

ExactFrame meanExactFrame(const HapticModel& model, const hdb::Partition& partition, double edge_mm, int runs) {
  ExactFrame mean;
  const double share = 1.0 / static_cast<double>(model.places.size());
  hdb::TriangleHits hits;
  hits.prepareFor(partition);
  for (const SkinPlace& place : model.places) {
    mean.find_us += share * shortestMicroseconds(runs, [&] {
                      hdb::findTriangles(partition, hdb::hapticBox(place.point, edge_mm), hits);
                      hdb::listTriangles(partition, hits);
                    });
    mean.triangles += share * static_cast<double>(hits.triangles.size());
  }
  return mean;
}

double meanTickMicroseconds(const contact::Surface& surface, int runs) {
  const auto strokes = fingerStrokes({.count = kStrokes});
  double ticks = 0.0;
  for (const auto& stroke : strokes) ticks += static_cast<double>(stroke.size());
  const double all = shortestMicroseconds(runs, [&] {
    for (const auto& stroke : strokes) {
      contact::FingerState state;
      for (const Vec3& tip : stroke) doNotOptimise(contact::step(surface, {}, state, tip).depth_mm);
    }
  });
  return all / ticks;
}

contact::Surface contactSurface(const mesh::TriangleMesh& mesh) {
  contact::SurfaceOptions options;
  options.self_intersecting = false;  // height fields are not
  return contact::buildSurface(mesh, std::vector<double>(mesh.positions.size(), kAnyStiffness), options);
}

}  // namespace palpate::study
