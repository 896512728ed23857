// From how deep and how stiff to how strong: the normal force of a point on the skin.
//
// The seam between the finger (`contact`) and the tissue: the finger knows a local stiffness and a depth and asks here.
// A law is plain data without pointers, so that it travels inside an immutable surface and two runs can be compared bit
// by bit. Today there is Hooke's law; a law that stiffens with depth is one more kind and one more case below.
// Based on: Ji, dissertation 2008, (2.1) with the stiffness interpolated in the triangle (section 2.2, E3).
#pragma once

#include <cstdint>

namespace palpate::tissue {

struct ForceLaw {
  enum class Kind : std::uint8_t {
    linear,  ///< F = k d
  };
  Kind kind = Kind::linear;
};

/// Normal force in N, >= 0, for a depth in mm under the undeformed skin and the local stiffness in N/mm. A depth or a
/// stiffness that is not positive (NaN included) gives 0. Continuous and not decreasing in both. Any thread.
inline double normalForce(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm) noexcept {
  if (!(depth_mm > 0.0) || !(stiffness_n_per_mm > 0.0)) return 0.0;
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return stiffness_n_per_mm * depth_mm;
  }
  return 0.0;
}

}  // namespace palpate::tissue
