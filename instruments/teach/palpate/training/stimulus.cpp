#include "palpate/training/stimulus.h"

#include <cmath>

namespace palpate::training {

double stiffnessRatio(double change, ChangeMeaning meaning) {
  return meaning == ChangeMeaning::compliance ? 1.0 / (1.0 - change) : 1.0 + change;
}

double changeFromRatio(double stiffness_ratio, ChangeMeaning meaning) {
  return meaning == ChangeMeaning::compliance ? 1.0 - 1.0 / stiffness_ratio : stiffness_ratio - 1.0;
}

std::vector<double> adaptiveLevels(ChangeMeaning meaning) {
  constexpr int kLevels = 33;
  constexpr double kMin = 0.04;
  const double most = meaning == ChangeMeaning::compliance ? kMaxComplianceChange : 1.0;
  std::vector<double> levels;
  levels.reserve(kLevels);
  for (int i = 0; i < kLevels; ++i) levels.push_back(kMin * std::pow(most / kMin, i / (kLevels - 1.0)));
  return levels;
}

}  // namespace palpate::training
