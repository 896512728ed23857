// Invariants of every tick of a finger, whatever the surface and the trajectory: checked from its outputs with an own
// geometry.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "lab/judges/surface_side.h"
#include "palpate/contact/finger.h"

namespace palpate::lab {

enum class Invariant {
  finite,              ///< every number of the output
  free_without_force,  ///< a free finger has no force and no triangle
  proxy_on_triangle,   ///< radius 0: the proxy lies on the triangle it names
  anchor_on_triangle,  ///< the friction anchor lies on the triangle it names
  unit_normal,
  tip_not_in_front,   ///< radius 0: (tip - proxy) . normal <= 0
  force_not_pulling,  ///< F . normal >= 0
  friction_in_cone,   ///< Ft <= mu_s Fn
  force_bounded       ///< |F| <= k (max_depth + radius) sqrt(1 + mu_s^2)
};
inline constexpr std::size_t kInvariants = 9;
const char* nameOf(Invariant invariant);

struct InvariantReport {
  struct Breach {
    std::size_t ticks = 0;
    std::size_t first_tick = 0;
  };
  std::array<Breach, kInvariants> breaches;
  bool clean() const;
  /// "proxy_on_triangle in 3 ticks from tick 17; ..." or "none".
  std::string text() const;
};

/// `stiffness` and the settings in the same units as the mesh.
InvariantReport checkInvariants(const mesh::TriangleMesh& mesh, const contact::FingerSettings& settings,
                                double stiffness, std::span<const contact::FingerOutput> outputs);

}  // namespace palpate::lab
