// A finger moved by hand in a test: tips in, outputs out, and what must hold in every tick.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/mesh/repair.h"

namespace palpate::contact {

inline constexpr double kTestStiffness = 0.5;  // N/mm

/// The surface of a mesh of any kind, repaired as every mesh is at load.
inline Surface surfaceOf(const mesh::TriangleMesh& mesh, double stiffness = kTestStiffness) {
  const mesh::RepairResult fit = mesh::repair(mesh);
  SurfaceOptions options;
  options.self_intersecting = fit.self_intersecting;
  return buildSurface(fit.mesh, std::vector<double>(fit.mesh.positions.size(), stiffness), options);
}

/// One finger and its memory.
class FingerTrack {
 public:
  explicit FingerTrack(const Surface& surface, FingerSettings settings = {}) : surface_(surface), settings_(settings) {}

  FingerOutput to(const Vec3& tip) { return step(surface_, settings_, state_, tip); }

  /// Straight from the last tip to `end` in steps of at most `step_mm`; the last output.
  FingerOutput slide(const Vec3& end, double step_mm) {
    const Vec3 start = state_.tip;
    const int ticks = std::max(1, static_cast<int>(std::ceil((end - start).norm() / step_mm)));
    FingerOutput output;
    for (int i = 1; i <= ticks; ++i) output = to(start + (end - start) * (static_cast<double>(i) / ticks));
    return output;
  }

  const FingerState& state() const { return state_; }

 private:
  const Surface& surface_;
  FingerSettings settings_;
  FingerState state_;
};

inline bool touches(const FingerOutput& output) { return output.touch != Touch::free; }

inline FingerSettings sphereOf(double radius_mm) {
  FingerSettings settings;
  settings.radius_mm = radius_mm;
  return settings;
}

}  // namespace palpate::contact
