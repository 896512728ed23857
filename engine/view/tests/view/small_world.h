// A world made of any mesh, and fingers that press it: what pictures in tests are taken of.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/scene/body_parts.h"
#include "palpate/view/finger_pose.h"
#include "support/mesh_zoo.h"

namespace palpate::view {

inline constexpr double kTestStiffness = 0.5;

/// The mesh as it is, the same stiffness everywhere, no bones, no key points, circles of 50 mm.
inline std::shared_ptr<const scene::World> meshWorld(mesh::TriangleMesh mesh) {
  scene::BodyParts parts;
  parts.name = "test";
  parts.skin = std::move(mesh);
  parts.self_intersecting = true;  // nobody has looked
  const auto body = scene::builtBody(std::move(parts), {}, {});
  const std::vector<double> stiffness(body->skin.positions.size(), kTestStiffness);
  auto world =
      std::make_shared<scene::World>(scene::World{.scene = {},
                                                  .body = body,
                                                  .surface = contact::surfaceOf(body->geometry, stiffness),
                                                  .deformable = {body, &body->deformable},
                                                  .ellipses = maps::AnyEllipseMap({}, {.basic_radius_mm = 50.0}, {}),
                                                  .deformation = {},
                                                  .contours = {},
                                                  .notes = {},
                                                  .hdb = {},
                                                  .healthy = {}});
  return world;
}

/// Flat, 100 x 100 mm from the origin, facing +z: cells of 2 mm.
inline std::shared_ptr<const scene::World> flatWorld() { return meshWorld(zoo::grid(50, 100.0)); }

/// A point finger straight above `place`, pressed to `depth_mm` along -z and dragged there.
inline FingerMark pressedFinger(const scene::World& world, const Vec3& place, double depth_mm,
                                const Vec3& drag_mm = Vec3::Zero()) {
  contact::FingerState state;
  FingerMark mark;
  constexpr int kTicks = 200;
  for (int i = 0; i <= kTicks; ++i) {
    const double share = static_cast<double>(i) / kTicks;
    mark.contact = contact::step(world.surface, {}, state, place + Vec3(0.0, 0.0, 5.0 - share * (5.0 + depth_mm)));
  }
  for (int i = 1; i <= kTicks; ++i) {
    const double share = static_cast<double>(i) / kTicks;
    mark.contact = contact::step(world.surface, {}, state, place - depth_mm * Vec3::UnitZ() + share * drag_mm);
  }
  return mark;
}

inline deform::DeformedSurface deformedBy(const scene::World& world, std::span<const FingerMark> fingers) {
  deform::Settings settings;
  settings.strain = true;
  std::vector<deform::Contact> contacts;
  for (const FingerMark& finger : fingers) {
    if (const auto contact = deform::contactOf(finger.contact, world.ellipses, settings.tissue)) {
      contacts.push_back(*contact);
    }
  }
  deform::Deformer deformer(*world.deformable, settings);
  deform::DeformedSurface surface(*world.deformable);
  deformer.apply(contacts, surface);
  return surface;
}

}  // namespace palpate::view
