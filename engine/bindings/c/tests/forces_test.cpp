// Through the C interface a finger feels what contact::step gives it, to the bit, and a step asks for no memory and no
// lock.
#include <vector>

#include "check.h"
#include "lab/counters/thread_counts.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/arrays.h"
#include "palpate/engine/fingers.h"
#include "sheet.h"

using namespace palpate;

namespace {

bool same(const Vec3& cpp, const double (&c)[3]) { return cpp == Vec3(c[0], c[1], c[2]); }

bool same(const contact::FingerOutput& cpp, const palpate_touch& c) {
  return same(cpp.force, c.force_n) && same(cpp.proxy, c.proxy_mm) && same(cpp.anchor, c.anchor_mm) &&
         same(cpp.hold, c.hold_mm) && same(cpp.normal, c.normal) && same(cpp.tip, c.tip_mm) &&
         same(cpp.dent.place, c.dent_mm) && cpp.depth_mm == c.depth_mm && cpp.tissue_mm == c.tissue_mm &&
         cpp.rest_mm == c.rest_mm && cpp.dent.rest_mm == c.dent_rest_mm && cpp.dent.triangle == c.dent_triangle &&
         static_cast<int>(cpp.touch) == c.touch && cpp.status == c.status && cpp.triangle == c.triangle &&
         cpp.anchor_triangle == c.anchor_triangle && same(cpp.lump_force, c.lump_force_n) &&
         cpp.lump_share == c.lump_share && cpp.lump == c.lump && cpp.lump_moved_mm.x() == c.lump_moved_mm[0] &&
         cpp.lump_moved_mm.y() == c.lump_moved_mm[1];
}

/// The same sheet as in C.
std::shared_ptr<const scene::World> sheetInCpp() {
  static Sheet arrays;
  fillSheet(&arrays);
  const mesh::TriangleMesh mesh =
      engine::meshFromArrays(std::span<const double>(arrays.positions), std::span<const std::int32_t>(arrays.corners));
  return engine::worldFromMesh(mesh, arrays.stiffness).world;
}

void compare(palpate_world* world_c, const scene::World& world, contact::FingerSettings settings,
             const palpate_finger_settings& settings_c) {
  palpate_finger* finger = nullptr;
  CHECK(palpate_finger_create(world_c, &settings_c, &finger, nullptr) == PALPATE_OK);
  contact::FingerState state;
  palpate_touch touch = {};
  touch.size = sizeof touch;
  int different = 0;
  int touching = 0;
  for (int i = 0; i < SHEET_TICKS; ++i) {
    Vec3 tip;
    sheetTip(i, tip.data());
    const contact::FingerOutput felt = contact::step(world.surface, settings, state, tip);
    CHECK(palpate_finger_step(finger, tip.data(), &touch) == PALPATE_OK);
    different += same(felt, touch) ? 0 : 1;
    touching += touch.touch == PALPATE_FREE ? 0 : 1;
  }
  CHECK(different == 0);
  CHECK(touching > SHEET_TICKS / 2);
  palpate_finger_release(finger);
}

void comparesForcesOfEverySetting(palpate_world* world_c, const scene::World& world) {
  for (const double radius_mm : {0.0, 8.0}) {
    for (const double share : {0.0, 0.3}) {
      contact::FingerSettings settings;
      settings.radius_mm = radius_mm;
      settings.mu_static = 0.3;
      settings.mu_dynamic = 0.25;
      settings.stiffness_ratio = 0.7;
      settings.max_depth_mm = 4.5;
      settings.catch_up_mm_per_s = 80.0;
      settings.relaxation = {share, 0.2, share / 2, 2.0};
      palpate_finger_settings settings_c = {};
      palpate_finger_settings_init(&settings_c, sizeof settings_c);
      settings_c.radius_mm = radius_mm;
      settings_c.mu_static = 0.3;
      settings_c.mu_dynamic = 0.25;
      settings_c.stiffness_ratio = 0.7;
      settings_c.max_depth_mm = 4.5;
      settings_c.catch_up_mm_per_s = 80.0;
      settings_c.relaxation_share = share;
      settings_c.relaxation_time_s = 0.2;
      settings_c.relaxation_share_2 = share / 2;
      settings_c.relaxation_time_2_s = 2.0;
      compare(world_c, world, settings, settings_c);
    }
  }
}

void asksForNothing(palpate_world* world) {
  static double tips[3 * SHEET_TICKS];
  static palpate_touch touches[SHEET_TICKS];
  for (int i = 0; i < SHEET_TICKS; ++i) sheetTip(i, tips + 3 * i);
  palpate_finger* finger = nullptr;
  palpate_skin* skin = nullptr;
  CHECK(palpate_finger_create(world, nullptr, &finger, nullptr) == PALPATE_OK);
  CHECK(palpate_skin_create(world, 1, 1, &skin, nullptr) == PALPATE_OK);
  const lab::ThreadCounts before = lab::countsOfThisThread();
  CHECK(palpate_finger_rollout(finger, tips, SHEET_TICKS, touches, sizeof touches[0]) == PALPATE_OK);
  CHECK(palpate_finger_step(finger, tips, touches) == PALPATE_OK);
  CHECK(palpate_skin_apply(skin, touches + 500, 1, sizeof touches[0]) == PALPATE_OK);
  const lab::ThreadCounts asked = lab::countsSince(before);
  CHECK(asked.allocations.value_or(0) == 0);
  CHECK(asked.locks.value_or(0) == 0);
  palpate_skin_release(skin);
  palpate_finger_release(finger);
}

}  // namespace

int main() {
  palpate_world* world_c = sheetWorld();
  CHECK(world_c != nullptr);
  comparesForcesOfEverySetting(world_c, *sheetInCpp());
  asksForNothing(world_c);
  palpate_world_release(world_c);
  return checksDone("c.forces");
}
