// The signed distances of hunted_shapes.h, before they are meshed.
#pragma once

#include <array>

#include "palpate/base/random.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::lab {

/// A distance, the half edge of the cube that holds it, and the lattice cell that its thinnest part needs.
struct HuntedForm {
  body::Field field;
  double reach_mm;
  double cell_mm;
};

struct NamedForm {
  const char* name;
  HuntedForm (*make)(Random& random);  ///< all its measures are random
};

inline constexpr std::size_t kHuntedForms = 26;
const std::array<NamedForm, kHuntedForms>& huntedForms();

}  // namespace palpate::lab
