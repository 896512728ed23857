// The whole twin: the engine and nothing else, compiled without optimisation, from a scene file to forces.csv. Tests
// compare its file with the one that `palpate simulate` writes. Built where PALPATE_DETERMINISM_BUILD is on.
//
// Usage: scene_unoptimised SCENE.toml FORCES.csv
#include <cstdio>
#include <exception>

#include "palpate/scene/scene_file.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "palpate/trace/forces_csv.h"

namespace {

using namespace palpate;

void writeForces(const char* scene_file, const char* forces_file) {
  const auto world = scene::build(scene::load(scene_file), {});
  const device::FingerPaths paths = device::pathsOf(*world);
  trace::ForcesCsvWriter forces(forces_file, servo::forcesSettings(*world, paths));
  servo::Rig rig = servo::scriptedRig(*world, paths);
  servo::runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) forces.add(sample);
  });
  forces.commit();
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) {
    std::fprintf(stderr, "usage: %s SCENE.toml FORCES.csv\n", arguments[0]);
    return 2;
  }
  writeForces(arguments[1], arguments[2]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
