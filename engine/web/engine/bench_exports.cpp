// The measured loop, for node: a mesh file and a path in, the hash of all that was felt and the time of a tick out.
//
// The same steps in the same order as `palpate study bench contact` (instruments/study/lab/runs/contact_run.h), so that
// both can be compared.
#include <algorithm>
#include <memory>
#include <vector>

#include "engine/exports.h"
#include "engine/tick_blocks.h"
#include "palpate/base/hash.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"
#include "palpate/device/trajectory.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/repair.h"

#include <fmt/format.h>

namespace palpate::web {

namespace {

constexpr double kStiffness = 0.5;  // N/mm, as the command's default

contact::Surface surfaceOf(std::string_view stl) {
  const mesh::RepairResult repaired = mesh::repair(mesh::loadFromMemory(stl, mesh::Format::stl, "body.stl"));
  contact::SurfaceOptions options;
  options.self_intersecting = repaired.self_intersecting;
  return contact::buildSurface(repaired.mesh, std::vector<double>(repaired.mesh.positions.size(), kStiffness), options);
}

void warmUp(const contact::Surface& surface, const contact::FingerSettings& settings, std::span<const Vec3> tips) {
  contact::FingerState state;
  for (const Vec3& tip : tips.first(std::min<std::size_t>(tips.size(), 5000)))
    contact::step(surface, settings, state, tip);
}

struct Run {
  Hash hash;
  std::vector<double> tick_us;  ///< means of blocks
};

Run runAlong(const contact::Surface& surface, const contact::FingerSettings& settings, std::span<const Vec3> tips) {
  std::vector<contact::FingerOutput> outputs(tips.size());
  Run run;
  run.tick_us = timeBlocks(surface, settings, tips, outputs);
  for (const contact::FingerOutput& o : outputs) {
    for (const Vec3* v : {&o.proxy, &o.anchor, &o.normal, &o.force}) run.hash.add(*v);
    run.hash.add(o.depth_mm);
    run.hash.add(static_cast<std::uint64_t>(o.touch));
    run.hash.add(static_cast<std::uint64_t>(o.triangle));
  }
  return run;
}

double percentile(std::vector<double> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::unique_ptr<contact::Surface> measured;
std::string report;

}  // namespace

/// The body of an STL file, for palpate_bench_run.
PALPATE_EXPORT const char* palpate_bench_open(const char* stl, std::size_t length) {
  return catchError([&] { measured = std::make_unique<contact::Surface>(surfaceOf({stl, length})); });
}

/// Along a table of t_s,x_mm,y_mm,z_mm by a ball of this radius (0: a point). palpate_bench_report has what came of it.
PALPATE_EXPORT const char* palpate_bench_run(const char* table, std::size_t length, double radius_mm) {
  return catchError([&] {
    contact::FingerSettings settings;
    settings.radius_mm = radius_mm;
    const std::vector<Vec3> tips =
        device::resampled(device::parseTrajectory({table, length}, "path.csv"), settings.tick_s).tip_mm;
    warmUp(*measured, settings, tips);
    const Run run = runAlong(*measured, settings, tips);
    report = fmt::format(R"({{"hash":"{:016x}","ticks":{},"p50_us":{:.4f},"p99_us":{:.4f}}})", run.hash.value(),
                         tips.size(), percentile(run.tick_us, 0.5), percentile(run.tick_us, 0.99));
  });
}

PALPATE_EXPORT const char* palpate_bench_report() { return report.c_str(); }

}  // namespace palpate::web
