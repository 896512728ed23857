// A press or a drag on one side of the closed trunk leaves the other side where it is, to the last bit: the far side is
// told here by where it lies, not by how the deformation finds its region. (Between arm and chest and between the
// thighs a long drag does reach the other limb: docs/explanation/deformation.md.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <string>

#include "palpate/base/random.h"
#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/mesh/nearest.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/scene/world.h"
#include "palpate/tree/triangle_tree.h"
#include "support/mesh_zoo.h"

namespace palpate::scene {
namespace {

using WorldPointer = std::shared_ptr<const World>;

/// Made once a test program. A thin body is where back and front are nearest.
WorldPointer trunkWorld(const std::string& name) {
  static std::map<std::string, WorldPointer> made;
  if (made.contains(name)) return made[name];
  Scene scene;
  scene.body.kind = BodyKind::trunk;
  scene.body.triangles = 40000;
  if (name == "thin") scene.body.shape = {.girth = 0.8, .body_mass_index = 16, .muscle = 0};
  if (name == "heavy prone") scene.body.shape = {.body_mass_index = 35, .posture = body::Posture::prone};
  return made[name] = build(scene);
}

/// Where a finger presses (of the average body) and what must not feel it. Flanks do: a drag reaches round to them.
struct Press {
  const char* name;
  Vec3 place;
  bool (*far)(const Vec3& place);
};
bool inFront(const Vec3& p) { return p.z() < -10 && std::abs(p.x()) < 75; }
bool behind(const Vec3& p) { return p.z() > 40 && std::abs(p.x()) < 75 && p.y() < 120; }  // not the shoulders' crest
bool frontOrLeftArm(const Vec3& p) { return inFront(p) || p.x() < -200; }
bool leftShoulder(const Vec3& p) { return p.x() < -100; }

const Press kPresses[] = {{"T6", {0, 39, 98}, frontOrLeftArm},
                          {"L3", {0, -204, 83}, frontOrLeftArm},
                          {"right scapula", {90, 60, 115}, frontOrLeftArm},
                          {"right deltoid", {228, 110, 20}, leftShoulder},
                          {"belly", {0, -200, -102}, behind},
                          {"sternum", {0, 60, -75}, behind}};

/// A finger that comes down along the skin's normal and then goes sideways; what it feels at the end. `nearest` is of
/// the world's skin.
contact::FingerOutput felt(const World& world, const mesh::NearestTriangle& nearest, const Vec3& place, double depth_mm,
                           double radius_mm, double drag_mm) {
  const auto hit = nearest.find(place);
  const Triangle& t = world.body->skin.triangles[hit.triangle];
  const auto& p = world.body->skin.positions;
  const Vec3 out = mesh::areaVector2(p[t[0]], p[t[1]], p[t[2]]).normalized();
  const Vec3 aside = out.unitOrthogonal();
  contact::FingerSettings settings;
  settings.radius_mm = radius_mm;
  contact::FingerState state;
  contact::FingerOutput output;
  constexpr int kTicks = 200;
  const double start = radius_mm + 2;
  for (int i = 0; i <= kTicks; ++i) {
    const Vec3 tip = hit.point + (start - (start + depth_mm) * i / kTicks) * out;
    output = contact::step(world.surface, settings, state, tip);
  }
  for (int i = 1; i <= kTicks; ++i) {
    output = contact::step(world.surface, settings, state, hit.point - depth_mm * out + drag_mm * i / kTicks * aside);
  }
  return output;
}

struct Moved {
  Index near = 0;
  Index far = 0;
};

/// Positions and normals, bit by bit.
Moved movedBy(const World& world, const contact::FingerOutput& finger, const Press& press) {
  const auto contact = contactOf(world, finger);
  if (!contact) return {};
  deform::Deformer deformer(*world.deformable, world.deformation);
  const deform::DeformedSurface rest(*world.deformable);
  deform::DeformedSurface surface(*world.deformable);
  deformer.apply(std::span(&*contact, 1), surface);
  Moved moved;
  for (Index v = 0; v < surface.vertices(); ++v) {
    if (surface.positionAt(v) == rest.positionAt(v) && surface.normalAt(v) == rest.normalAt(v)) continue;
    ++(press.far(world.body->skin.positions[v]) ? moved.far : moved.near);
  }
  return moved;
}

class FarSide : public testing::TestWithParam<const char*> {};

TEST_P(FarSide, StaysWhereItIsHoweverDeepThePress) {
  const WorldPointer world = trunkWorld(GetParam());
  const mesh::NearestTriangle nearest(world->body->skin);
  for (const Press& press : kPresses) {
    for (const double depth_mm : {3.0, 15.0, 30.0}) {
      for (const double radius_mm : {0.0, 8.0}) {
        for (const double drag_mm : {0.0, 25.0}) {
          const contact::FingerOutput finger = felt(*world, nearest, press.place, depth_mm, radius_mm, drag_mm);
          if (drag_mm > depth_mm && finger.touch == contact::Touch::free) continue;  // the skin bends away under it
          const Moved moved = movedBy(*world, finger, press);
          EXPECT_GT(moved.near, 3u) << press.name << ", " << depth_mm << " mm";
          EXPECT_EQ(moved.far, 0u) << press.name << ", " << depth_mm << " mm deep, " << drag_mm << " mm aside, radius "
                                   << radius_mm << " mm";
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trunk, FarSide, testing::Values("average", "thin", "heavy prone"), [](const auto& build) {
  std::string name = build.param;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

/// The way from a place on a triangle to every vertex along the edges of the skin, mm.
std::vector<double> waysAlongSkin(const World& world, const Vec3& from, Index triangle) {
  const mesh::TriangleMesh& skin = world.body->skin;
  std::vector<double> ways(skin.positions.size(), std::numeric_limits<double>::infinity());
  using Step = std::pair<double, Index>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  const auto reach = [&](double way_mm, Index v) {
    if (way_mm >= ways[v]) return;
    ways[v] = way_mm;
    next.push({way_mm, v});
  };
  for (const Index corner : skin.triangles[triangle]) reach((skin.positions[corner] - from).norm(), corner);
  while (!next.empty()) {
    const auto [way_mm, v] = next.top();
    next.pop();
    if (way_mm > ways[v]) continue;
    for (const Index w : world.deformable->neighbours[v]) {
      reach(way_mm + (skin.positions[w] - skin.positions[v]).norm(), w);
    }
  }
  return ways;
}

/// How far a contact moves what it should leave, mm.
struct FarMove {
  double off_plane_mm = 0.0;   ///< vertices more than 100 mm above or below the contact's plane
  double along_skin_mm = 0.0;  ///< vertices to which the way along the skin is longer than the contact's ellipses
};

FarMove farMoveOf(const World& world, const deform::Contact& contact) {
  deform::Deformer deformer(*world.deformable, world.deformation);
  deform::DeformedSurface surface(*world.deformable);
  deformer.apply(std::span(&contact, 1), surface);
  const std::vector<double> ways = waysAlongSkin(world, contact.anchor, contact.anchor_triangle);
  // Edges go in a zigzag: up to that much farther than the skin between their ends.
  const double reach_mm =
      1.15 * std::max(contact.normal_region.half_major.norm(), contact.tangential_region.half_major.norm());
  FarMove far;
  for (Index v = 0; v < surface.vertices(); ++v) {
    const double moved_mm = surface.displacementAt(v).cast<double>().norm();
    const double height_mm = (world.body->skin.positions[v] - contact.anchor).dot(contact.normal.normalized());
    if (std::abs(height_mm) > 100.0) far.off_plane_mm = std::max(far.off_plane_mm, moved_mm);
    if (ways[v] > reach_mm) far.along_skin_mm = std::max(far.along_skin_mm, moved_mm);
  }
  return far;
}

class Reach : public testing::TestWithParam<body::Posture> {};

TEST_P(Reach, OfPressesAndDragsEndsAlongTheSkin) {
  Scene scene;
  scene.body.kind = BodyKind::trunk;
  scene.body.triangles = 40000;
  scene.body.shape.posture = GetParam();
  const WorldPointer world = build(scene);
  const mesh::NearestTriangle nearest(world->body->skin);
  Random random(59);
  for (int i = 0; i < 24; ++i) {
    const std::vector<Vec3>& skin = world->body->skin.positions;
    const Vec3 place = skin[static_cast<std::size_t>(random.uniform() * static_cast<double>(skin.size() - 1))];
    for (const double depth_mm : {10.0, 30.0}) {
      for (const double drag_mm : {0.0, 15.0, 25.0}) {
        const auto contact = contactOf(*world, felt(*world, nearest, place, depth_mm, 8.0, drag_mm));
        if (!contact) continue;  // the skin bends away under it
        const FarMove far = farMoveOf(*world, *contact);
        SCOPED_TRACE(testing::Message() << place.transpose() << ", " << depth_mm << " mm deep, " << drag_mm
                                        << " aside");
        EXPECT_LT(far.off_plane_mm, 1.0);
        EXPECT_LT(far.along_skin_mm, 1.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trunk, Reach, testing::Values(body::Posture::standing, body::Posture::sitting));

/// An ellipsoid without bones, flat in z.
WorldPointer lens(const Vec3& half_axes_mm, int levels) {
  Scene scene;
  scene.body.kind = BodyKind::mesh;
  BodyParts parts;
  parts.name = "lens";
  parts.skin = zoo::sphere(1.0, levels);
  for (Vec3& p : parts.skin.positions) p = p.cwiseProduct(half_axes_mm);
  parts.closed = true;
  return buildOn(scene, std::move(parts));
}

/// A press through the whole part; its dent must not come out on the other side. Returns how many vertices went deep.
Index dentWithin(const World& world, const Vec3& place, double depth_mm) {
  const auto contact =
      contactOf(world, felt(world, mesh::NearestTriangle(world.body->skin), place, depth_mm, 0.0, 0.0));
  if (!contact) return 0;
  deform::Deformer deformer(*world.deformable, world.deformation);
  deform::DeformedSurface surface(*world.deformable);
  deformer.apply(std::span(&*contact, 1), surface);
  Index deep = 0;
  for (Index v = 0; v < surface.vertices(); ++v) {
    const double moved_mm = surface.displacementAt(v).norm();
    if (moved_mm < 0.05) continue;
    deep += moved_mm > 1.0 ? 1 : 0;
    // What slides along the round rim leaves it by a few hundredths.
    const Vec3 at = surface.positionAt(v).cast<double>();
    const bool at_skin = tree::nearestPoint(world.surface.geometry->tree, at, 0.1).triangle != kNoIndex;
    EXPECT_TRUE(at_skin || tree::windingNumber(world.surface.geometry->tree, at) > 0.5)
        << "vertex " << v << " moved by " << moved_mm << " mm";
  }
  return deep;
}

TEST(ThinPart, HoldsADentThatWouldComeOutOfItsFarSide) {
  const WorldPointer world = lens({30.0, 30.0, 3.0}, 5);
  Index deep = 0;
  for (const Vec3& place : {Vec3(0, 0, 3), Vec3(10, 5, 3), Vec3(-15, 0, 3), Vec3(3, -12, -3)}) {
    deep += dentWithin(*world, place, 8.0);
  }
  EXPECT_GT(deep, 20u) << "and yet dented";
}

TEST(ThinPart, HoldsItAtThirtyPlacesOfTenParts) {
  Random random(32);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  int dented = 0;
  for (int part = 0; part < 10; ++part) {
    const double thick_mm = between(1.5, 6.0);
    const double long_mm = between(20.0, 45.0);
    const Vec3 axes(long_mm, between(0.5, 1.0) * long_mm, thick_mm);
    const WorldPointer world = lens(axes, 5);
    for (int i = 0; i < 3; ++i) {
      const double angle = between(0.0, 6.28);
      const double out = between(0.0, 0.7);
      const Vec3 place(out * axes.x() * std::cos(angle), out * axes.y() * std::sin(angle),
                       i == 2 ? -thick_mm : thick_mm);
      SCOPED_TRACE(testing::Message() << "half axes " << axes.transpose() << ", place " << place.transpose());
      dented += dentWithin(*world, place, between(0.5, 3.5) * thick_mm) > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(dented, 25) << "of 30";
}

}  // namespace
}  // namespace palpate::scene
