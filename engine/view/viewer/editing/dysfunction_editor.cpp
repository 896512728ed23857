#include "view/viewer/editing/dysfunction_editor.h"

namespace palpate::viewer {

namespace {

constexpr double kSizePerNotch = 1.08;
constexpr double kPercentPerNotch = 5.0;
constexpr double kMinRadiusMm = 2.0;
constexpr double kMaxRadiusMm = 200.0;

}  // namespace

void EditRules<maps::Dysfunction>::resize(maps::Dysfunction& item, double notches) {
  item.radius_mm = std::clamp(item.radius_mm * std::pow(kSizePerNotch, notches), kMinRadiusMm, kMaxRadiusMm);
}

void EditRules<maps::Dysfunction>::strengthen(maps::Dysfunction& item, double notches) {
  item.change_percent = std::clamp(item.change_percent + kPercentPerNotch * notches, -100.0, 1000.0);
}

std::string EditRules<maps::Dysfunction>::nameOf(const Items& /*items*/, int index) {
  return trf("dysfunction {}", index + 1);
}

}  // namespace palpate::viewer
