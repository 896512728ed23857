#include "view/viewer/editing/lump_editor.h"

namespace palpate::viewer {

namespace {

constexpr double kLumpSizePerNotch = 1.08;
constexpr double kStiffnessPerNotch = 1.15;
constexpr double kMinYoungKpa = 0.1;
constexpr double kMaxYoungKpa = 1e6;
constexpr double kLeastReachMm = 8.0;

bool isTaken(const std::vector<scene::LumpSettings>& items, const std::string& name) {
  return std::any_of(items.begin(), items.end(), [&](const scene::LumpSettings& item) { return item.name == name; });
}

}  // namespace

scene::LumpSettings EditRules<scene::LumpSettings>::placed(const Items& items) {
  scene::LumpSettings lump;
  for (std::size_t number = items.size() + 1; lump.name.empty() || isTaken(items, lump.name); ++number) {
    lump.name = fmt::format("lump{}", number);
  }
  return lump;
}

double EditRules<scene::LumpSettings>::reachMm(const scene::LumpSettings& item) {
  return std::max(kLeastReachMm, item.halfAxes().x());
}

void EditRules<scene::LumpSettings>::resize(scene::LumpSettings& item, double notches) {
  const double factor = std::pow(kLumpSizePerNotch, notches);
  if (!item.half_axes_mm) {
    item.diameter_mm = std::clamp(factor * item.diameter_mm, kMinLumpMm, kMaxLumpMm);
    return;
  }
  const auto within = [&](double half) { return std::clamp(factor * half, 0.5 * kMinLumpMm, 0.5 * kMaxLumpMm); };
  item.half_axes_mm = item.half_axes_mm->unaryExpr(within);
}

void EditRules<scene::LumpSettings>::strengthen(scene::LumpSettings& item, double notches) {
  const double factor = std::pow(kStiffnessPerNotch, notches);
  if (item.young_kpa > 0.0) {
    item.young_kpa = std::clamp(factor * item.young_kpa, kMinYoungKpa, kMaxYoungKpa);
  } else {
    item.stiffness_ratio = std::clamp(factor * item.stiffness_ratio, kMinLumpRatio, kMaxLumpRatio);
  }
}

std::string EditRules<scene::LumpSettings>::nameOf(const Items& items, int index) {
  const bool named =
      index >= 0 && index < static_cast<int>(items.size()) && !items[static_cast<std::size_t>(index)].name.empty();
  return trf("lump {}", named ? items[static_cast<std::size_t>(index)].name : fmt::format("{}", index + 1));
}

}  // namespace palpate::viewer
