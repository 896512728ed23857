#include "palpate/engine/living_skin.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/tests/engine/small_worlds.h"
#include "palpate/contact/finger.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "support/counted.h"

namespace palpate::engine {
namespace {

/// Two fingers that press and pull the sheet, and one in the air.
std::vector<contact::FingerOutput> threeFingers(const scene::World& world) {
  std::vector<contact::FingerOutput> fingers;
  for (const Vec3& start : {Vec3(80, 90, 5), Vec3(130, 110, 5), Vec3(100, 100, 50)}) {
    contact::FingerState state;
    contact::FingerOutput felt;
    Vec3 tip = start;
    for (int tick = 0; tick < 100; ++tick) {
      felt = contact::step(world.surface, {}, state, tip);
      tip += Vec3(0.01, 0.02, -0.1);
    }
    fingers.push_back(felt);
  }
  return fingers;
}

bool same(std::span<const float> a, std::span<const float> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

void expectSame(const deform::DeformedSurface& a, const deform::DeformedSurface& b) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(same(a.position(axis), b.position(axis))) << axis;
    EXPECT_TRUE(same(a.normal(axis), b.normal(axis))) << axis;
    EXPECT_TRUE(same(a.displacement(axis), b.displacement(axis))) << axis;
  }
  EXPECT_TRUE(same(a.strain(), b.strain()));
}

TEST(LivingSkin, IsWhatTheDeformerMakesOfTheContacts) {
  const auto world = sheet(0.5);
  const auto fingers = threeFingers(*world);
  ASSERT_EQ(fingers[2].touch, contact::Touch::free);
  std::vector<deform::Contact> contacts;
  for (const auto& finger : fingers) {
    if (const auto contact = scene::contactOf(*world, finger)) contacts.push_back(*contact);
  }
  ASSERT_EQ(contacts.size(), 2u);
  deform::FormSettings forms = world->deformation;
  forms.common.strain = true;
  deform::Deformer deformer(*world->deformable, forms);
  deform::DeformedSurface expected(*world->deformable);
  const deform::Report report = deformer.apply(contacts, expected);

  LivingSkin skin(*world);
  const deform::Report followed = skin.follow(fingers);
  EXPECT_EQ(followed.moved_vertices, report.moved_vertices);
  EXPECT_GT(followed.moved_vertices, 10u);
  EXPECT_EQ(followed.status, 0u);
  expectSame(skin.surface(), expected);
  EXPECT_NE(*std::max_element(expected.strain().begin(), expected.strain().end()), 0.0f);
}

TEST(LivingSkin, FollowsSamplesAsItFollowsFingers) {
  const auto world = sheet(0.5);
  const auto fingers = threeFingers(*world);
  std::vector<trace::Sample> samples(fingers.size());
  for (std::size_t i = 0; i < fingers.size(); ++i) samples[i].contact = fingers[i];
  LivingSkin one(*world);
  LivingSkin other(*world);
  one.follow(fingers);
  other.follow(samples);
  expectSame(one.surface(), other.surface());
}

TEST(LivingSkin, ComesBackToRestWithoutFingers) {
  const auto world = sheet(0.5);
  LivingSkin skin(*world);
  skin.follow(threeFingers(*world));
  skin.follow(std::span<const trace::Sample>());
  expectSame(skin.surface(), deform::DeformedSurface(*world->deformable));
}

TEST(LivingSkin, LeavesStrainOutWhereNobodyLooksAtIt) {
  const auto world = sheet(0.5);
  LivingSkin skin(*world, {.strain = false});
  EXPECT_GT(skin.follow(threeFingers(*world)).moved_vertices, 10u);
  EXPECT_EQ(std::count(skin.surface().strain().begin(), skin.surface().strain().end(), 0.0f),
            static_cast<std::ptrdiff_t>(skin.surface().vertices()));
}

TEST(LivingSkin, HasRoomForAsManyFingersAsAskedForAndSaysWhenThereAreMore) {
  const auto world = sheet(0.5);
  const contact::FingerOutput finger = threeFingers(*world)[0];
  const std::vector<contact::FingerOutput> crowd(20, finger);
  LivingSkin wide(*world, {.fingers = crowd.size()});
  EXPECT_EQ(wide.follow(crowd).status & deform::kIgnoredOverCapacity, 0u);
  LivingSkin narrow(*world);
  EXPECT_NE(narrow.follow(crowd).status & deform::kIgnoredOverCapacity, 0u);
}

TEST(LivingSkin, FollowsWithoutAllocating) {
  const auto world = sheet(0.5);
  const auto fingers = threeFingers(*world);
  const std::vector<contact::FingerOutput> crowd(40, fingers[0]);
  LivingSkin skin(*world);
  skin.follow(fingers);
  support::expectNoAllocation([&] {
    for (int i = 0; i < 10; ++i) {
      skin.follow(crowd);
      skin.follow(fingers);
    }
  });
}

TEST(LivingSkin, OfABodyThatBreathesFollowsTheFingerWhereTheBodyIs) {
  const auto world = scene::build(scene::parse(R"(
[body]
triangles = 40000
[breathing]
on = true
depth_mm = 6
per_minute = 15
[[finger]]
name = "index"
at = "T10 right 40 mm"
radius_mm = 8
script = [{ do = "press", depth_mm = 4, seconds = 1 }, { do = "hold", seconds = 2 }]
)",
                                               "breathing.toml"));
  const device::FingerPaths paths = device::pathsOf(*world);
  servo::Rig rig = servo::scriptedRig(*world, paths);
  LivingSkin skin(*world);
  double deepest_in_finger = 0.0;
  servo::runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    if (samples.front().tick != 2000) return;  // breathed in
    skin.follow(samples);
    EXPECT_NEAR(skin.lift(), 6.0, 1e-9);
    EXPECT_GT(samples.front().contact.depth_mm, 8.0) << "pressed by 4 mm, and the body came 6 mm nearer";
    const Vec3& finger = samples.front().contact.tip;
    for (Index v = 0; v < skin.surface().vertices(); ++v) {
      const Vec3 now = world->breath->moved(skin.surface().positionAt(v).cast<double>(), skin.lift());
      deepest_in_finger = std::max(deepest_in_finger, 8.0 - (now - finger).norm());
    }
  });
  EXPECT_GT(deepest_in_finger, -3.0) << "the skin is at the finger";
  EXPECT_LT(deepest_in_finger, 1.0) << "and not in it";
}

}  // namespace
}  // namespace palpate::engine
