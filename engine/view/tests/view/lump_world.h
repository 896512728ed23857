// A torso with lumps, pressed: what the overlays of lumps and pressure are looked at on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/world.h"
#include "palpate/tree/triangle_tree.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {

/// Beside the spine, where there is room for it.
inline constexpr double kLumpX = 40.0;
inline constexpr double kLumpY = 20.0;

inline scene::LumpSettings lumpAt(double x_mm, double y_mm) {
  scene::LumpSettings lump;
  lump.name = "hard";
  lump.x_mm = x_mm;
  lump.y_mm = y_mm;
  lump.depth_mm = 4.0;
  lump.diameter_mm = 8.0;
  lump.stiffness_ratio = 15.0;
  return lump;
}

inline std::shared_ptr<const scene::World> lumpyTorso(std::vector<scene::LumpSettings> lumps) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  scene.body.triangles = 8163;
  scene.lumps = std::move(lumps);
  return scene::build(scene);
}

/// With one lump; made once a test program.
inline const std::shared_ptr<const scene::World>& lumpyTorso() {
  static const std::shared_ptr<const scene::World> world = lumpyTorso({lumpAt(kLumpX, kLumpY)});
  return world;
}

/// On the back, seen from behind.
inline Vec3 backAt(const scene::World& world, double x_mm, double y_mm) {
  const Vec3 over(x_mm, y_mm, 1000.0);
  return tree::firstFrontCrossing(world.surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
}

/// A fingertip pressed straight in.
inline FingerMark fingertipAt(const scene::World& world, double x_mm, double y_mm, double depth_mm) {
  constexpr double kRadiusMm = 8.0;
  constexpr int kTicks = 200;
  const Vec3 skin = backAt(world, x_mm, y_mm);
  contact::FingerState state;
  FingerMark mark;
  mark.haptic_radius_mm = mark.radius_mm = kRadiusMm;
  for (int i = 0; i <= kTicks; ++i) {
    const double height = kRadiusMm + 3.0 - (3.0 + depth_mm) * i / kTicks;
    mark.contact = contact::step(world.surface, {.radius_mm = kRadiusMm}, state, skin + height * Vec3::UnitZ());
  }
  mark.contact.finger_mm = kRadiusMm;
  return mark;
}

/// A lump that slides, and the finger beside it that has moved it to the right.
struct MovedLump {
  std::shared_ptr<const scene::World> world;
  FingerMark finger;
};
inline MovedLump movedLump(double depth_mm, double moved_mm) {
  scene::LumpSettings mobile = lumpAt(kLumpX, kLumpY);
  mobile.mobility_mm_per_n = 20.0;
  MovedLump made{lumpyTorso({mobile}), {}};
  made.finger = fingertipAt(*made.world, kLumpX - 6.0, kLumpY, depth_mm);
  made.finger.contact.lump = 0;
  made.finger.contact.lump_moved_mm = Vec2(moved_mm, 0.0);
  return made;
}

}  // namespace palpate::view
