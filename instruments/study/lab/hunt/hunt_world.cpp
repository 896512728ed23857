// The steps of a scene's load in their order, so that a written case behaves in `palpate simulate` as it did here.
#include "lab/hunt/hunt_world.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "lab/judges/lump_check.h"
#include "lab/workloads/random_lumps.h"
#include "palpate/base/hash.h"
#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::lab {

HuntWorld buildHuntWorld(mesh::TriangleMesh mesh) {
  mesh::RepairResult repaired = mesh::repair(std::move(mesh));
  mesh::reorderSpatially(repaired.mesh);
  contact::SurfaceOptions options;
  options.self_intersecting = repaired.self_intersecting;
  std::vector<double> stiffness(repaired.mesh.positions.size(), kHuntedStiffness);
  contact::Surface surface = contact::buildSurface(repaired.mesh, std::move(stiffness), options);
  return {std::move(surface), OracleBody(std::move(repaired.mesh), repaired.self_intersecting)};
}

contact::FingerSettings huntedFinger(double radius_mm, double mm) {
  contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  return contact::scaled(finger, mm);
}

void putLumps(HuntWorld& world, std::string_view body, std::size_t count) {
  Hash name;
  for (const char letter : body) name.add(std::uint64_t{static_cast<unsigned char>(letter)});
  Random random(name.value());
  const tissue::LumpPlace place = randomLumpPlace(random);
  contact::Lumps lumps;
  const mesh::TriangleMesh& mesh = world.body.mesh();
  for (std::size_t i = 0; i < count; ++i) {
    const auto triangle = static_cast<Index>(random.below(mesh.triangles.size()));
    const Vec3 axis = world.body.triangleNormal(triangle);
    if (axis.squaredNorm() < 0.5) continue;  // a triangle without area
    Vec3 foot = Vec3::Zero();
    for (const Index corner : mesh.triangles[triangle]) foot += mesh.positions[corner] / 3.0;
    lumps.all.push_back(randomLump(place, foot, axis, kHuntedStiffness, random));
    if (i % 2 == 1) loosen(lumps.all.back(), random);
  }
  world.surface.lumps = std::make_shared<const contact::Lumps>(std::move(lumps));
}

namespace {

/// Ticks by which the second finger is behind the first.
constexpr std::size_t kBehind = 60;

contact::LumpPlaces placesOf(const servo::FingerSolver& solver) {
  return solver.lumps ? solver.lumps->places() : contact::LumpPlaces();
}

HuntReport huntAmongLumps(HuntWorld& world, const contact::FingerSettings& finger, std::span<const Vec3> tips) {
  HuntOracle judge(world.body, finger, kHuntedStiffness);
  std::array<contact::FingerState, 2> states;
  LumpCheck check(*world.surface.lumps, finger, states.size());
  servo::FingerSolvers solvers = servo::makeSolvers(world.surface, nullptr, states.size());
  for (std::size_t k = 0; k < tips.size(); ++k) {
    const contact::LumpPlaces before = placesOf(solvers[0]);
    const std::array presses = {states[0].lumps, states[1].lumps};
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Vec3& tip = i == 0 ? tips[k] : tips[k - std::min(k, kBehind)];
      contact::FingerOutput felt = servo::touch(solvers[i], finger, states[i], tip);
      const contact::LumpPlaces places = placesOf(solvers[i]);
      if (i == 0) check.moved(before, places, presses);
      check.add(i, states[i].lumps, places, felt);
      if (i > 0) continue;
      felt.force -= felt.lump_force;
      judge.add(felt);
    }
  }
  HuntReport report = judge.report();
  check.addTo(report);
  return report;
}

}  // namespace

HuntReport huntAlong(HuntWorld& world, const contact::FingerSettings& finger, std::span<const Vec3> tips) {
  if (world.surface.lumps) return huntAmongLumps(world, finger, tips);
  HuntOracle judge(world.body, finger, kHuntedStiffness);
  contact::FingerState state;
  for (const Vec3& tip : tips) judge.add(contact::step(world.surface, finger, state, tip));
  return judge.report();
}

}  // namespace palpate::lab
