// Dysfunctions edited on the body (place_editor.h).
#pragma once

#include <string>
#include <vector>

#include "view/viewer/editing/place_editor.h"

namespace palpate::viewer {

template <>
struct EditRules<maps::Dysfunction> {
  using Items = std::vector<maps::Dysfunction>;
  static maps::Dysfunction placed(const Items& /*items*/) { return {}; }
  static double reachMm(const maps::Dysfunction& item) { return item.radius_mm; }
  /// Changes the radius by a share of itself per notch.
  static void resize(maps::Dysfunction& item, double notches);
  /// Changes the strength by some per cent per notch.
  static void strengthen(maps::Dysfunction& item, double notches);
  static std::string nameOf(const Items& items, int index);
};

}  // namespace palpate::viewer
