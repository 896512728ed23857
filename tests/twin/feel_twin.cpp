// The small twin: from a tip to the force on a hand, without scene, files or threads. Built twice from the same source,
// once with the engine as it is and once with the rooms that a tick passes through compiled without optimisation; both
// must print the same lines (tests/house/determinism_test.cpp).
//
// A line names the workload and the finger, then a hash of every bit of what was felt and of what would be sent.
#include <cinttypes>
#include <cstdio>
#include <exception>

#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/hash.h"
#include "palpate/contact/finger.h"
#include "palpate/servo/limiter.h"

namespace {

using namespace palpate;

struct Finger {
  const char* name;
  contact::FingerSettings settings;
};

const Finger kFingers[] = {{"point", {}},
                           {"shaded", {.force_shading = true}},
                           {"slippery", {.stiffness_ratio = 0.23, .mu_static = 0.2, .mu_dynamic = 0.1}},
                           {"fingertip", {.radius_mm = 8.0}}};

struct Workload {
  const char* mesh;
  const char* path;
  std::size_t every;  ///< how many milliseconds of the path pass in a tick
  tissue::ForceLaw::Kind law;
};

using Law = tissue::ForceLaw::Kind;
const Workload kWorkloads[] = {{"back_8163", "back_slide", 4, Law::linear},
                               {"groove60", "groove60", 16, Law::stiffening},
                               {"pit", "pit", 16, Law::power},
                               {"lattice100", "lattice_flat", 64, Law::linear}};

/// Soft at one end and stiff at the other, so that the map takes part.
contact::Surface surfaceOf(const mesh::TriangleMesh& mesh, tissue::ForceLaw::Kind law) {
  std::vector<double> stiffness;
  for (const Vec3& position : mesh.positions) stiffness.push_back(0.2 + 0.002 * position.y());
  return contact::buildSurface(mesh, std::move(stiffness),
                               {.force_law = {.kind = law, .table = {}}, .self_intersecting = {}});
}

std::uint64_t feel(const contact::Surface& surface, const contact::FingerSettings& settings,
                   const device::Trajectory& path, std::size_t every) {
  const servo::LimiterSettings limits;
  servo::LimiterState sent;
  contact::FingerState state;
  Hash hash;
  for (std::size_t at = 0; at < path.size(); at += every) {
    const Vec3 tip = servo::guardTip(limits, sent, {.tip = path.tip_mm[at], .tick = at});
    const contact::FingerOutput felt = contact::step(surface, settings, state, tip);
    hash.add(felt.force);
    hash.add(felt.proxy);
    hash.add(felt.anchor);
    hash.add(felt.depth_mm);
    hash.add(std::uint64_t{felt.status});
    hash.add(servo::limitForce(limits, sent, felt, surface.force_law));
  }
  return hash.value();
}

void run(const Workload& workload) {
  const contact::Surface surface = surfaceOf(lab::workloadMesh(workload.mesh), workload.law);
  const device::Trajectory path = lab::workloadPath(workload.path);
  for (const Finger& finger : kFingers) {
    std::printf("%s %s %016" PRIx64 "\n", workload.mesh, finger.name,
                feel(surface, finger.settings, path, workload.every));
  }
}

}  // namespace

int main() try {
  for (const Workload& workload : kWorkloads) run(workload);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
