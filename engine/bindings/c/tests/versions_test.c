/* One program, compiled with structures as they were, as they are and as they will be (tests.cmake makes the headers),
 * and run on libraries of another version. Prints what it felt, which must not depend on any of it; what stands behind
 * the caller's structures must stay. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "palpate.h"
#include "sheet.h"

#define GUARD 256

typedef struct GuardedTouch {
  palpate_touch touch;
  unsigned char guard[GUARD];
} GuardedTouch;

static int isIntact(const unsigned char* guard) {
  int i;
  for (i = 0; i < GUARD; ++i) {
    if (guard[i] != 0x5a) return 0;
  }
  return 1;
}

/* Numbers as bits: nothing is rounded on the way. */
static void add(uint64_t* hash, const void* bytes, size_t count) {
  size_t i;
  for (i = 0; i < count; ++i) *hash = (*hash ^ ((const unsigned char*)bytes)[i]) * 1099511628211u;
}

int main(void) {
  struct {
    palpate_finger_settings settings;
    unsigned char guard[GUARD];
  } kept;
  struct {
    palpate_error error;
    unsigned char guard[GUARD];
  } failed;
  static GuardedTouch felt;
  static palpate_touch rolled[SHEET_TICKS];
  static double tips[3 * SHEET_TICKS];
  palpate_world* world = sheetWorld();
  palpate_world* none = NULL;
  palpate_finger *one = NULL, *two = NULL;
  palpate_skin* skin = NULL;
  uint64_t hash = 1469598103934665603u;
  double depth_mm = 0.0;
  int i;
  CHECK(world != NULL);

  memset(&kept, 0x5a, sizeof kept);
  palpate_finger_settings_init(&kept.settings, sizeof kept.settings);
  CHECK(kept.settings.size == sizeof kept.settings && isIntact(kept.guard));
  kept.settings.mu_static = 0.3;
  kept.settings.mu_dynamic = 0.3;
#ifdef PALPATE_TEST_HAS_MORE_SETTINGS /* what no library here knows */
  kept.settings.added[0] = 1.0;
  kept.settings.added[1] = 2.0;
#endif
  memset(&failed, 0x5a, sizeof failed);
  failed.error.size = sizeof failed.error;
  CHECK(palpate_world_load("/no/such/folder/with/a/long/name/so/that/the/message/is/longer/than/it/was/scene.toml",
                           &none, &failed.error) == PALPATE_REFUSED);
  CHECK(failed.error.code == PALPATE_REFUSED && failed.error.message[0] != '\0' && isIntact(failed.guard));
  CHECK(memchr(failed.error.message, 0, sizeof failed.error.message) != NULL || sizeof failed.error.message < 512);

  CHECK(palpate_finger_create(world, &kept.settings, &one, &failed.error) == PALPATE_OK);
  CHECK(palpate_finger_create(world, &kept.settings, &two, NULL) == PALPATE_OK);
  memset(&felt, 0x5a, sizeof felt);
  felt.touch.size = sizeof felt.touch;
  for (i = 0; i < SHEET_TICKS; ++i) {
    sheetTip(i, tips + 3 * i);
    CHECK(palpate_finger_step(one, tips + 3 * i, &felt.touch) == PALPATE_OK);
    CHECK(felt.touch.size == sizeof felt.touch && isIntact(felt.guard));
    add(&hash, felt.touch.force_n, sizeof felt.touch.force_n);
    add(&hash, &felt.touch.depth_mm, sizeof felt.touch.depth_mm);
    add(&hash, felt.touch.anchor_mm, sizeof felt.touch.anchor_mm);
    if (i == 500) depth_mm = felt.touch.depth_mm;
  }
#ifdef PALPATE_TEST_HAS_MORE_TOUCH
  CHECK(isIntact((const unsigned char*)felt.touch.added) || sizeof felt.touch.added < GUARD);
#endif
  CHECK(depth_mm > 4.0);
  CHECK(palpate_finger_rollout(two, tips, SHEET_TICKS, rolled, sizeof rolled[0]) == PALPATE_OK);
  for (i = 0; i < SHEET_TICKS; ++i) add(&hash, rolled[i].force_n, sizeof rolled[i].force_n);

  CHECK(palpate_skin_create(world, 1, 1, &skin, NULL) == PALPATE_OK);
  CHECK(palpate_skin_apply(skin, &rolled[500], 1, sizeof rolled[0]) == PALPATE_OK);
  add(&hash, palpate_skin_positions(skin, 2), palpate_skin_vertices(skin) * sizeof(float));
  palpate_skin_release(skin);
  palpate_finger_release(one);
  palpate_finger_release(two);
  palpate_world_release(world);
  printf("felt %08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
  return checksDone("c.versions");
}
