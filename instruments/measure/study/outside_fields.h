// Presses whose skin moves as in none of the fitted forms, to test the stated uncertainty outside them.
//
//   family, seed ─ OutsideFields ─► SyntheticCase (TailFamily::given) ─ exactDots, measureDots ─► JudgedPair
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/elements/drag_solver.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_case.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

enum class OutsideFamily : unsigned char {
  layered_mid,    ///< skin of 100 to 220 kPa on fat, muscle and bone, dragged by finite elements
  layered_stiff,  ///< skin of 600 to 1300 kPa on the same
  boussinesq,     ///< elastic half space dragged and pressed (Cerruti, Boussinesq)
  exponential,    ///< exp(-q), q = 1 on an ellipse
  irregular       ///< half Gaussian or long tail, 15 to 30 % farther to some sides than to others
};

struct NamedFamily {
  std::string_view name;
  OutsideFamily family;
  std::string_view what;  ///< one line
};

std::vector<NamedFamily> outsideFamilies();
std::string_view nameOf(OutsideFamily family);
/// Throws Error naming the families.
OutsideFamily parseOutsideFamily(std::string_view name);

class OutsideFields {
 public:
  /// Solves the stacks of a layered family, about a second for each.
  OutsideFields(OutsideFamily family, std::uint64_t seed, const Progress& progress);

  /// Case `i`: marks, camera and body of `drawCase(seed)`, with the press of the family.
  measure::SyntheticCase makeCase(std::uint64_t seed, std::size_t i) const;

 private:
  OutsideFamily family_;
  std::vector<elements::DragField> solved_;  // for a drag by 1 mm
};

/// A pair without pixels: the dots of a synthetic case as a perfect camera program would find them, with a little
/// noise. A thousand times as fast as pictures: for questions that pixels do not decide. `noise_mm`: sd of each place
/// along each axis. Neither strays nor marks under stick or hand are among them.
measure::DotPair exactDots(const measure::SyntheticCase& made, const measure::SyntheticTruth& truth,
                           double noise_mm = 0.05);

}  // namespace palpate::study
