#include "measure/study/exact_dots.h"

#include "palpate/base/random.h"

namespace palpate::study {

measure::DotPair exactDots(const measure::SyntheticCase& made, const measure::SyntheticTruth& truth, double noise_mm) {
  Random random(made.seed ^ 0xa0761d6478bd642full);
  measure::DotPair pair;
  const auto seen = [&](const Vec2& place_px) {
    return measure::Dot{place_px + noise_mm * truth.px_per_mm * Vec2(random.normal(), random.normal()), 0.0};
  };
  for (const measure::TrueDot& dot : truth.dots) {
    pair.before.push_back(seen(dot.before_px));
    // One that is half hidden has its middle elsewhere; its area would tell.
    if (dot.covered == 0.0) pair.after.push_back(seen(dot.after_px));
  }
  return pair;
}

}  // namespace palpate::study
