// The steps of a scene's load in their order, so that a written case behaves in `palpate simulate` as it did here.
#include "lab/hunt/hunt_world.h"

#include <utility>

#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"

namespace palpate::lab {

HuntWorld buildHuntWorld(mesh::TriangleMesh mesh) {
  mesh::RepairResult repaired = mesh::repair(std::move(mesh));
  mesh::reorderSpatially(repaired.mesh);
  contact::SurfaceOptions options;
  options.self_intersecting = repaired.self_intersecting;
  std::vector<double> stiffness(repaired.mesh.positions.size(), kHuntedStiffness);
  contact::Surface surface = contact::buildSurface(repaired.mesh, std::move(stiffness), options);
  return {std::move(surface), JudgedBody(std::move(repaired.mesh), repaired.self_intersecting)};
}

contact::FingerSettings huntedFinger(double radius_mm, double mm) {
  contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  return contact::scaled(finger, mm);
}

HuntReport huntAlong(HuntWorld& world, const contact::FingerSettings& finger, std::span<const Vec3> tips) {
  HuntJudge judge(world.body, finger, kHuntedStiffness);
  contact::FingerState state;
  for (const Vec3& tip : tips) judge.add(contact::step(world.surface, finger, state, tip));
  return judge.report();
}

}  // namespace palpate::lab
