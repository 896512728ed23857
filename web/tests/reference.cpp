// What the browser's engine is held against: writes a body as STL and the path back_slide as a table, and prints as
// JSON what native code felt along it. The hash is that of lab/runs/contact_run.h, of the mesh *file*, as node reads
// it too.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "lab/runs/contact_run.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/error.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "web/engine/tick_blocks.h"

namespace {

std::string figuresOf(palpate::bench::ContactWorld& world, double radius_mm) {
  palpate::contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  const palpate::device::Trajectory path = palpate::lab::workloadPath("back_slide");
  const palpate::bench::ContactFigures figures = palpate::bench::measureContact(world, path, finger);
  const auto tips = palpate::device::resampled(path, finger.tick_s).tip_mm;
  std::vector<palpate::contact::FingerOutput> outputs(tips.size());
  const auto tick_us = palpate::lab::percentilesOf(palpate::web::timeBlocks(world.surface, finger, tips, outputs));
  return fmt::format(R"({{"radius_mm":{},"hash":"{:016x}","ticks":{},"p50_us":{:.4f},"p99_us":{:.4f}}})", radius_mm,
                     figures.hash, figures.ticks, tick_us.p50, tick_us.p99);
}

void run(const std::filesystem::path& folder) {
  const std::filesystem::path stl = folder / "back.stl";
  palpate::mesh::save(stl, palpate::lab::workloadMesh("back_20389"));
  palpate::device::writeTrajectory(folder / "back_slide.csv", palpate::lab::workloadPath("back_slide"));
  palpate::bench::ContactWorld world = palpate::bench::buildContactWorld(palpate::mesh::load(stl));
  fmt::print("[{},{}]\n", figuresOf(world, 0.0), figuresOf(world, 8.0));
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: web_reference FOLDER\n", stderr);
    return 2;
  }
  try {
    run(words[1]);
  } catch (const palpate::Error& error) {
    fmt::print(stderr, "web_reference: {}\n", error.what());
    return 1;
  }
  return 0;
}
