// A second or so a radius; ten for those of 1 and 2 mm, whose elements are as much smaller.
#include "palpate/elements/finger_solver.h"

#include <algorithm>
#include <utility>

#include "palpate/tissue/force_law.h"

namespace palpate::elements {

double maxPressDepth(double finger_mm) {
  constexpr double kDeepestMm = 500.0;
  if (finger_mm >= tissue::kFingertipMm) return kDeepestMm;
  return std::min(2.5 * finger_mm, finger_mm + 4.0);
}

PressSettings settingsOf(double finger_mm, std::vector<double> depths_mm) {
  PressSettings settings;
  settings.indenter_radius_mm = finger_mm;
  settings.radius_mm = std::max(settings.radius_mm, 6.0 * finger_mm);
  settings.depths_mm = std::move(depths_mm);
  return settings;
}

std::vector<tissue::FingerForces> solveFingers(const tissue::LayerStack& stack, const PressSettings& indenter,
                                               const Progress& progress, const std::function<bool()>& stop) {
  constexpr const auto& kRadii = tissue::LayeredForce::kRadiiMm;
  std::vector<tissue::FingerForces> fingers;
  for (std::size_t i = 0; i < kRadii.size() && !(stop && stop()); ++i) {
    if (kRadii[i] == indenter.indenter_radius_mm) continue;
    report(progress, "pressing fingers", static_cast<double>(i) / static_cast<double>(kRadii.size()));
    std::vector<double> depths = indenter.depths_mm;
    std::erase_if(depths, [&](double depth) { return depth > maxPressDepth(kRadii[i]); });
    if (depths.empty()) depths.push_back(maxPressDepth(kRadii[i]));
    PressSettings settings = settingsOf(kRadii[i], std::move(depths));
    settings.fineness = indenter.fineness;
    const PressSolution press = solvePress(stack, settings, {}, stop);
    if (press.table.shapes.empty()) continue;
    tissue::FingerForces& finger = fingers.emplace_back(tissue::FingerForces{kRadii[i], {}, {}});
    for (const tissue::PressedShape& shape : press.table.shapes) {
      finger.depths_mm.push_back(shape.depth_mm);
      finger.force_n.push_back(shape.force_n);
    }
  }
  return fingers;
}

}  // namespace palpate::elements
