// From how strong back to how deep: a force law (force_law.h) read the other way.
//
// The finger never asks for it; the display does, once a finger and frame, to show skin that pushes back with no more
// than it has left (contact/relaxation.h).
#pragma once

#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

/// The least depth at which the law's effective depth reaches this, mm: h(result) = effective_mm to rounding. 0 for
/// what is not positive; no deeper than 1 m. Any thread.
double depthOf(const ForceLaw& law, double effective_mm, const PressedPlace& place) noexcept;
inline double depthOf(const ForceLaw& law, double effective_mm, double tissue_mm = 0.0) noexcept {
  return depthOf(law, effective_mm, PressedPlace{.tissue_mm = tissue_mm});
}

}  // namespace palpate::tissue
