// Doubled until it is deep enough, then halved 60 times: some 5 us. Laws do not decrease, and nothing else is asked of
// them. Own.
#include "palpate/tissue/law_inverse.h"

namespace palpate::tissue {

double depthOf(const ForceLaw& law, double effective_mm, const PressedPlace& place) noexcept {
  if (!(effective_mm > 0.0)) return 0.0;
  if (law.kind == ForceLaw::Kind::linear) return effective_mm;
  constexpr double kDeepestMm = 1000.0;
  const auto reaches = [&](double depth_mm) { return normalForce(law, 1.0, depth_mm, place) >= effective_mm; };
  double deep = effective_mm;
  while (deep < kDeepestMm && !reaches(deep)) deep *= 2.0;
  if (deep >= kDeepestMm) return kDeepestMm;
  double shallow = 0.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (shallow + deep);
    (reaches(middle) ? deep : shallow) = middle;
  }
  return deep;
}

}  // namespace palpate::tissue
