// Lumps edited on the body (place_editor.h).
#pragma once

#include <string>
#include <vector>

#include "view/viewer/editing/place_editor.h"

namespace palpate::viewer {

template <>
struct EditRules<scene::LumpSettings> {
  using Items = std::vector<scene::LumpSettings>;
  /// A new lump with a unique name.
  static scene::LumpSettings placed(const Items& items);
  /// At least a fingertip, so that small ones can be grabbed.
  static double reachMm(const scene::LumpSettings& item);
  /// Changes the diameter, or all half axes, by a share per notch.
  static void resize(scene::LumpSettings& item, double notches);
  /// Changes the stiffness by a share per notch.
  static void strengthen(scene::LumpSettings& item, double notches);
  static std::string nameOf(const Items& items, int index);
};

// Ranges of scene files (docs/reference/scene-files.md).
inline constexpr double kMinLumpMm = 2.0;  ///< diameter
inline constexpr double kMaxLumpMm = 40.0;
inline constexpr double kMinLumpRatio = 0.2;
inline constexpr double kMaxLumpRatio = 1000.0;

}  // namespace palpate::viewer
