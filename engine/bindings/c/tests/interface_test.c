/* The C interface asked for everything, also for nonsense: nulls, sizes of 0, structures that are too short, numbers
 * that are none. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "palpate.h"
#include "sheet.h"

static palpate_error newError(void) {
  palpate_error error;
  memset(&error, 0, sizeof error);
  error.size = sizeof error;
  return error;
}

static palpate_touch newTouch(void) {
  palpate_touch touch;
  memset(&touch, 0, sizeof touch);
  touch.size = sizeof touch;
  return touch;
}

/* `bytes` of it are still as memset made them. */
static int isFilled(const void* place, unsigned char with, size_t bytes) {
  size_t i;
  for (i = 0; i < bytes; ++i) {
    if (((const unsigned char*)place)[i] != with) return 0;
  }
  return 1;
}

static void press(palpate_finger* finger, double depth_mm, palpate_touch* touch) {
  double tip[3] = {103.0, 101.0, 2.0};
  int i;
  for (i = 0; i <= 200; ++i) {
    tip[2] = 2.0 - (2.0 + depth_mm) * i / 200.0;
    CHECK(palpate_finger_step(finger, tip, touch) == PALPATE_OK);
  }
}

static palpate_finger* newFinger(palpate_world* world) {
  palpate_finger* finger = NULL;
  CHECK(palpate_finger_create(world, NULL, &finger, NULL) == PALPATE_OK && finger != NULL);
  return finger;
}

static void refusesArrays(palpate_arrays arrays, int32_t code, const char* word) {
  palpate_error error = newError();
  palpate_world* world = (palpate_world*)&error; /* must become null */
  CHECK(palpate_world_from_arrays(&arrays, &world, &error) == code);
  CHECK(world == NULL && error.code == code && strstr(error.message, word) != NULL);
}

static void testArrays(void) {
  static Sheet s;
  palpate_arrays good, bad;
  palpate_error error = newError();
  palpate_world* world = NULL;
  float floats[9] = {0, 0, 0, 100, 0, 0, 0, 100, 0};
  int64_t corners[3] = {0, 1, 2};
  fillSheet(&s);
  good = arraysOf(&s);

  CHECK(palpate_world_from_arrays(NULL, &world, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_world_from_arrays(&good, NULL, &error) == PALPATE_ARGUMENT);
  bad = good, bad.size = 0, refusesArrays(bad, PALPATE_ARGUMENT, "size");
  bad = good, bad.size = sizeof bad - 1, refusesArrays(bad, PALPATE_ARGUMENT, "size");
  bad = good, bad.positions_mm = NULL, refusesArrays(bad, PALPATE_ARGUMENT, "positions_mm");
  bad = good, bad.positions_mm_f32 = floats, refusesArrays(bad, PALPATE_ARGUMENT, "positions_mm");
  bad = good, bad.corners = NULL, refusesArrays(bad, PALPATE_ARGUMENT, "corners");
  bad = good, bad.vertices = (size_t)-1, refusesArrays(bad, PALPATE_ARGUMENT, "32-bit");
  bad = good, bad.triangles = (size_t)-1 / 2, refusesArrays(bad, PALPATE_ARGUMENT, "32-bit");
  bad = good, bad.triangles = 0, refusesArrays(bad, PALPATE_REFUSED, "");
  bad = good, bad.scene_toml = "\n[friction]\nstatik = 1\n", refusesArrays(bad, PALPATE_REFUSED, "static");
  s.corners[301] = -1, refusesArrays(good, PALPATE_REFUSED, "triangle 100"), fillSheet(&s);
  s.corners[2] = SHEET_VERTICES, refusesArrays(good, PALPATE_REFUSED, "triangle 0"), fillSheet(&s);
  s.positions[4] = NAN, refusesArrays(good, PALPATE_REFUSED, "y of vertex 1"), fillSheet(&s);
  s.stiffness[7] = -1.0, refusesArrays(good, PALPATE_REFUSED, "vertex 7"), fillSheet(&s);

  bad = good;
  bad.positions_mm = NULL, bad.positions_mm_f32 = floats, bad.vertices = 3;
  bad.corners = NULL, bad.corners_i64 = corners, bad.triangles = 1, bad.stiffness_n_per_mm = NULL;
  CHECK(palpate_world_from_arrays(&bad, &world, &error) == PALPATE_OK && world != NULL);
  CHECK(error.code == PALPATE_OK && error.message[0] == '\0');
  palpate_world_release(world);
}

static void testErrors(void) {
  struct {
    palpate_error error;
    char guard[64];
  } kept;
  palpate_error error = newError();
  palpate_world* world = NULL;
  char* words = malloc(4001);
  size_t i;

  CHECK(palpate_world_parse("[body]\nkind = \"mesh\"\nfile = 3\n", "a/scene.toml", &world, &error) == PALPATE_REFUSED);
  CHECK(error.line == 3 && strstr(error.message, "a/scene.toml:3: ") == error.message);
  CHECK(palpate_world_load("/no/such/scene.toml", &world, &error) == PALPATE_REFUSED);
  CHECK(error.line == 0 && strstr(error.message, "/no/such/scene.toml") != NULL && world == NULL);
  CHECK(palpate_world_load(NULL, &world, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_world_load("x.toml", &world, NULL) == PALPATE_REFUSED);
  CHECK(palpate_world_torso(7, &world, &error) == PALPATE_REFUSED && error.message[0] != '\0');

  /* Only code and line fit. */
  memset(&kept, 0x5a, sizeof kept);
  kept.error.size = 16;
  CHECK(palpate_world_parse("a = ", NULL, &world, &kept.error) == PALPATE_REFUSED);
  CHECK(kept.error.size == 16 && kept.error.code == PALPATE_REFUSED && kept.error.line == 1);
  CHECK(isFilled(&kept.error.message, 0x5a, sizeof kept - 16));
  kept.error.size = 0;
  kept.error.code = 77;
  CHECK(palpate_world_parse("a = ", NULL, &world, &kept.error) == PALPATE_REFUSED && kept.error.code == 77);

  /* A message that is too long ends between two letters. */
  for (i = 0; i + 1 < 4000; i += 2) memcpy(words + i, "\xc3\xbc", 2);
  memcpy(words, "/x", 2);
  words[4000] = '\0';
  CHECK(palpate_world_load(words, &world, &error) != PALPATE_OK);
  CHECK(strlen(error.message) < sizeof error.message &&
        ((unsigned char)error.message[strlen(error.message) - 1]) != 0xc3);
  free(words);
}

static void testSettings(palpate_world* world) {
  struct {
    palpate_finger_settings settings;
    char guard[64];
  } kept;
  palpate_finger_settings settings;
  palpate_error error = newError();
  palpate_finger* finger = NULL;

  palpate_finger_settings_init(NULL, sizeof settings);
  memset(&kept, 0x5a, sizeof kept);
  palpate_finger_settings_init(&kept.settings, 0);
  CHECK(isFilled(&kept, 0x5a, sizeof kept));
  palpate_finger_settings_init(&kept.settings, 16);
  CHECK(kept.settings.size == 16 && kept.settings.radius_mm == 0.0);
  CHECK(isFilled((char*)&kept + 16, 0x5a, sizeof kept - 16));
  CHECK(palpate_finger_create(world, &kept.settings, &finger, &error) == PALPATE_OK); /* the rest is as by default */
  palpate_finger_release(finger);

  palpate_finger_settings_init(&settings, sizeof settings);
  CHECK(settings.size == sizeof settings && settings.mu_static == 0.46 && settings.tick_s == 0.001);
  settings.radius_mm = NAN;
  CHECK(palpate_finger_create(world, &settings, &finger, &error) == PALPATE_REFUSED && finger == NULL);
  CHECK(strstr(error.message, "radius_mm") != NULL);
  settings.radius_mm = 1e9;
  CHECK(palpate_finger_create(world, &settings, &finger, &error) == PALPATE_REFUSED);
  settings.radius_mm = 8.0;
  settings.mu_dynamic = 2.0;
  CHECK(palpate_finger_create(world, &settings, &finger, &error) == PALPATE_REFUSED);
  settings.size = 0;
  CHECK(palpate_finger_create(world, &settings, &finger, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_create(NULL, NULL, &finger, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_create(world, NULL, NULL, &error) == PALPATE_ARGUMENT);
  settings.size = sizeof settings;
  CHECK(palpate_world_finger_settings(world, 99, &settings) == PALPATE_OK && settings.radius_mm == 0.0);
  CHECK(palpate_world_finger_settings(NULL, 0, &settings) == PALPATE_ARGUMENT);
  CHECK(palpate_world_finger_settings(world, 0, NULL) == PALPATE_ARGUMENT);
}

static void testStep(palpate_world* world) {
  struct {
    palpate_touch touch;
    char guard[64];
  } kept;
  palpate_finger* finger = newFinger(world);
  palpate_touch touch = newTouch(), lost = newTouch();
  double tip[3] = {103.0, 101.0, -5.0}, none[3] = {NAN, 0.0, INFINITY}, far[3] = {1e300, -1e300, 1e300};
  press(finger, 5.0, &touch);
  CHECK(touch.size == sizeof touch && touch.touch == PALPATE_STICK && touch.tick == 200);
  CHECK(fabs(touch.depth_mm - 5.0) < 1e-9 && touch.force_n[2] > 1.0 && touch.normal[2] == 1.0);
  CHECK(touch.triangle < SHEET_TRIANGLES && touch.proxy_mm[2] == 0.0 && touch.tip_mm[2] == -5.0);

  CHECK(palpate_finger_step(finger, none, &lost) == PALPATE_OK);
  CHECK(lost.status == PALPATE_TIP_LOST && lost.force_n[2] == 0.0 && lost.touch == PALPATE_FREE);
  CHECK(palpate_finger_step(finger, far, &lost) == PALPATE_OK && lost.status == PALPATE_TIP_LOST);

  CHECK(palpate_finger_step(NULL, tip, &touch) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_step(finger, NULL, &touch) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_step(finger, tip, NULL) == PALPATE_ARGUMENT);
  memset(&kept, 0x5a, sizeof kept);
  kept.touch.size = 0;
  CHECK(palpate_finger_step(finger, tip, &kept.touch) == PALPATE_ARGUMENT);
  kept.touch.size = 33;
  CHECK(palpate_finger_step(finger, tip, &kept.touch) == PALPATE_ARGUMENT);
  CHECK(isFilled((char*)&kept + 8, 0x5a, sizeof kept - 8));
  kept.touch.size = 32; /* the force alone */
  CHECK(palpate_finger_step(finger, tip, &kept.touch) == PALPATE_OK);
  CHECK(kept.touch.size == 32 && kept.touch.force_n[2] == touch.force_n[2]);
  CHECK(isFilled((char*)&kept + 32, 0x5a, sizeof kept - 32));
  kept.touch.size = sizeof kept; /* of a later version: what this one does not know stays */
  CHECK(palpate_finger_step(finger, tip, &kept.touch) == PALPATE_OK);
  CHECK(kept.touch.size == sizeof kept && kept.touch.depth_mm == touch.depth_mm);
  CHECK(isFilled(kept.guard, 0x5a, sizeof kept.guard));

  CHECK(palpate_finger_lift(finger) == PALPATE_OK && palpate_finger_lift(NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_step(finger, tip, &touch) == PALPATE_OK && touch.touch == PALPATE_FREE); /* from below */
  palpate_finger_release(finger);
  palpate_finger_release(NULL);
}

static void testRollout(palpate_world* world) {
  static double tips[3 * SHEET_TICKS];
  static palpate_touch steps[SHEET_TICKS], rolled[SHEET_TICKS];
  static unsigned char wide[SHEET_TICKS][sizeof(palpate_touch) + 64];
  static double narrow[SHEET_TICKS][4];
  palpate_finger *one = newFinger(world), *two = newFinger(world);
  int i, slips = 0;
  for (i = 0; i < SHEET_TICKS; ++i) {
    sheetTip(i, tips + 3 * i);
    steps[i] = newTouch();
    CHECK(palpate_finger_step(one, tips + 3 * i, &steps[i]) == PALPATE_OK);
    slips += steps[i].touch == PALPATE_SLIP;
  }
  CHECK(slips > 100);
  CHECK(palpate_finger_rollout(two, tips, SHEET_TICKS, rolled, sizeof rolled[0]) == PALPATE_OK);
  CHECK(sameBytes(steps, rolled, sizeof steps));

  palpate_finger_lift(two);
  memset(wide, 0x5a, sizeof wide);
  CHECK(palpate_finger_rollout(two, tips, SHEET_TICKS, (palpate_touch*)wide, sizeof wide[0]) == PALPATE_OK);
  palpate_finger_lift(two);
  CHECK(palpate_finger_rollout(two, tips, SHEET_TICKS, (palpate_touch*)narrow, sizeof narrow[0]) == PALPATE_OK);
  for (i = 0; i < SHEET_TICKS; ++i) {
    CHECK(sameBytes(wide[i] + 8, (char*)&steps[i] + 8, offsetof(palpate_touch, tick) - 8));
    CHECK(sameBytes(wide[i] + offsetof(palpate_touch, lump_force_n), steps[i].lump_force_n, 6 * sizeof(double)));
    CHECK(isFilled(wide[i] + sizeof(palpate_touch), 0x5a, 64));
    CHECK(sameBytes(narrow[i] + 1, steps[i].force_n, sizeof steps[i].force_n));
  }
  CHECK(palpate_finger_rollout(two, NULL, 0, NULL, sizeof rolled[0]) == PALPATE_OK);
  CHECK(palpate_finger_rollout(two, NULL, 1, rolled, sizeof rolled[0]) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_rollout(two, tips, 1, NULL, sizeof rolled[0]) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_rollout(two, tips, 1, rolled, 0) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_rollout(two, tips, 1, rolled, 12) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_rollout(NULL, tips, 1, rolled, sizeof rolled[0]) == PALPATE_ARGUMENT);
  palpate_finger_release(one);
  palpate_finger_release(two);
}

static void refusesTouch(palpate_skin* skin, palpate_touch touch) {
  CHECK(palpate_skin_apply(skin, &touch, 1, sizeof touch) == PALPATE_ARGUMENT);
}

static double deepest(const palpate_skin* skin) {
  const float* z = palpate_skin_positions(skin, 2);
  double least = 0.0;
  size_t v;
  for (v = 0; v < palpate_skin_vertices(skin); ++v) least = z[v] < least ? z[v] : least;
  return least;
}

static void testSkin(palpate_world* world) {
  palpate_finger* finger = newFinger(world);
  palpate_skin* skin = NULL;
  palpate_error error = newError();
  palpate_touch touch = newTouch(), bad;
  size_t count = 99;
  CHECK(palpate_skin_create(world, 0, 1, &skin, &error) == PALPATE_ARGUMENT && skin == NULL);
  CHECK(palpate_skin_create(world, 5000, 1, &skin, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_create(NULL, 1, 1, &skin, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_create(world, 1, 1, NULL, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_create(world, 1, 1, &skin, &error) == PALPATE_OK);
  CHECK(palpate_skin_vertices(skin) == SHEET_VERTICES && deepest(skin) == 0.0);

  press(finger, 5.0, &touch);
  CHECK(palpate_skin_apply(skin, &touch, 1, sizeof touch) == PALPATE_OK);
  CHECK(deepest(skin) < -2.0 && deepest(skin) > -6.0);
  CHECK(palpate_skin_changed(skin, &count) != NULL && count > 0);
  CHECK(palpate_skin_normals(skin, 2) != NULL && palpate_skin_displacements(skin, 0) != NULL);
  CHECK(palpate_skin_strain(skin) != NULL && palpate_skin_lift_mm(skin) == 0.0);
  const double* origin = palpate_skin_origin_mm(skin);
  CHECK(origin != NULL && origin[0] == 0.0 && origin[1] == 0.0 && origin[2] == 0.0);
  CHECK(palpate_skin_origin_mm(NULL) == NULL);
  CHECK(palpate_skin_positions(skin, 3) == NULL && palpate_skin_positions(skin, -1) == NULL);
  CHECK(palpate_skin_positions(NULL, 0) == NULL && palpate_skin_strain(NULL) == NULL);
  CHECK(palpate_skin_changed(NULL, &count) == NULL && count == 0 && palpate_skin_vertices(NULL) == 0);

  bad = touch, bad.touch = 7, refusesTouch(skin, bad);
  bad = touch, bad.force_n[1] = INFINITY, refusesTouch(skin, bad);
  bad = touch, bad.anchor_mm[0] = NAN, refusesTouch(skin, bad);
  bad = touch, bad.triangle = SHEET_TRIANGLES, refusesTouch(skin, bad);
  bad = touch, bad.dent_triangle = 0xfffffffeu, refusesTouch(skin, bad);
  bad = touch, bad.lump_force_n[2] = NAN, refusesTouch(skin, bad);
  bad = touch, bad.size = 0, refusesTouch(skin, bad);
  CHECK(palpate_skin_apply(skin, &touch, 2, sizeof touch) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_apply(skin, NULL, 1, sizeof touch) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_apply(skin, &touch, 1, 0) == PALPATE_ARGUMENT);
  CHECK(palpate_skin_apply(NULL, &touch, 1, sizeof touch) == PALPATE_ARGUMENT);
  CHECK(deepest(skin) < -2.0); /* refused ones change nothing */
  CHECK(palpate_skin_apply(skin, NULL, 0, 0) == PALPATE_OK && deepest(skin) == 0.0);
  palpate_skin_release(skin);
  palpate_skin_release(NULL);
  palpate_finger_release(finger);
}

static void testWorld(palpate_world* world) {
  static Sheet s;
  struct {
    palpate_world_facts facts;
    char guard[32];
  } kept;
  palpate_error error = newError();
  palpate_world* other = NULL;
  palpate_place place;
  palpate_touch soft = newTouch(), hard = newTouch();
  palpate_finger* finger;
  const uint32_t* source;
  size_t count = 0, v;
  fillSheet(&s);

  memset(&kept, 0x5a, sizeof kept);
  kept.facts.size = sizeof kept.facts;
  CHECK(palpate_world_get_facts(world, &kept.facts) == PALPATE_OK && isFilled(kept.guard, 0x5a, sizeof kept.guard));
  CHECK(kept.facts.vertices == SHEET_VERTICES && kept.facts.triangles == SHEET_TRIANGLES && kept.facts.closed == 0);
  CHECK(kept.facts.high_mm[0] == 200.0 && kept.facts.low_mm[1] == 0.0 && kept.facts.ticks_per_s == 1000.0);
  CHECK(palpate_world_get_facts(NULL, &kept.facts) == PALPATE_ARGUMENT);
  CHECK(palpate_world_get_facts(world, NULL) == PALPATE_ARGUMENT);

  source = palpate_world_map(world, PALPATE_MAP_SOURCE_VERTEX, &count);
  CHECK(source != NULL && count == SHEET_VERTICES);
  for (v = 0; source != NULL && v < count; ++v) {
    CHECK(sameBytes(palpate_world_positions(world) + 3 * v, s.positions + 3 * source[v], 3 * sizeof(double)));
    CHECK(palpate_world_stiffness(world)[v] == 0.5);
  }
  CHECK(palpate_world_map(world, PALPATE_MAP_BUILT_TRIANGLE, &count) != NULL && count == SHEET_TRIANGLES);
  CHECK(palpate_world_map(world, 4, &count) == NULL && count == 0);
  CHECK(palpate_world_map(NULL, 0, NULL) == NULL && palpate_world_positions(NULL) == NULL);
  CHECK(palpate_world_triangles(world) != NULL && palpate_world_triangles(NULL) == NULL);
  CHECK(palpate_world_note(world, 1000000) == NULL && palpate_world_note(NULL, 0) == NULL);

  memset(&place, 0, sizeof place);
  place.size = sizeof place;
  CHECK(palpate_world_place(world, "T6", &place, &error) == PALPATE_REFUSED); /* a sheet has no names */
  CHECK(palpate_world_landmark(world, 0, &place) == PALPATE_ARGUMENT);

  /* Other friction on the same body; given stiffness stays. */
  CHECK(palpate_world_rebuilt(world, "[friction]\nstiffness_ratio = 0.25\n", NULL, &other, &error) == PALPATE_OK);
  CHECK(palpate_world_map(other, PALPATE_MAP_SOURCE_VERTEX, &count) != NULL && count == SHEET_VERTICES);
  palpate_world_release(other);
  CHECK(palpate_world_rebuilt(world, "[force_law]\nkind = \"fungal\"\n", NULL, &other, &error) == PALPATE_REFUSED);
  CHECK(other == NULL && palpate_world_rebuilt(NULL, "", NULL, &other, &error) == PALPATE_ARGUMENT);

  /* A finger keeps its world. */
  palpate_world_retain(world);
  palpate_world_release(world);
  palpate_world_retain(NULL);
  palpate_world_release(NULL);
  other = sheetWorld();
  finger = newFinger(other);
  palpate_world_release(other);
  press(finger, 5.0, &soft);
  palpate_finger_lift(finger);
  press(finger, 5.0, &hard);
  CHECK(sameBytes(soft.force_n, hard.force_n, sizeof soft.force_n));
  palpate_finger_release(finger);
}

/* A torso with a hard lump that moves: the force over it, its pattern of pressure, and all that can be wrong. */
static void testLumps(palpate_world* bare) {
  static const char scene[] =
      "[body]\nkind = \"torso\"\n[[lump]]\nname = \"node\"\nat = \"T9 right 30 mm\"\ndepth_mm = 6\n"
      "stiffness_ratio = 15\nmobility_mm_per_n = 20\n[[finger]]\nname = \"index\"\nradius_mm = 8\n"
      "at = \"T9 right 30 mm\"\nscript = [{ do = \"press\" }]\n";
  struct {
    palpate_lump lump;
    char guard[32];
  } kept;
  palpate_error error = newError();
  palpate_world_facts facts;
  palpate_world* world = NULL;
  palpate_finger* finger = NULL;
  palpate_touch touch = newTouch();
  float kpa[16], shear[32], wide[256];
  double tip[3], sum_n = 0.0, normal_n = 0.0, lateral_n = 0.0;
  int i, axis;
  CHECK(palpate_world_parse(scene, NULL, &world, &error) == PALPATE_OK);
  memset(&facts, 0, sizeof facts);
  facts.size = sizeof facts;
  CHECK(palpate_world_get_facts(world, &facts) == PALPATE_OK && facts.lumps == 1);
  memset(&kept, 0x5a, sizeof kept);
  kept.lump.size = sizeof kept.lump;
  CHECK(palpate_world_lump(world, 0, &kept.lump) == PALPATE_OK && isFilled(kept.guard, 0x5a, sizeof kept.guard));
  CHECK(strcmp(kept.lump.name, "node") == 0 && kept.lump.depth_mm == 6.0 && kept.lump.half_axes_mm[2] == 5.0);
  CHECK(fabs(kept.lump.young_kpa - 15.0 * kept.lump.layer_kpa) < 1e-9 && kept.lump.mobility_mm_per_n == 20.0);
  CHECK(kept.lump.share[0] > 0.02 && kept.lump.tissue_mm > 16.0 && kept.lump.axis[2] > 0.5);
  CHECK(palpate_world_lump(world, 1, &kept.lump) == PALPATE_ARGUMENT);
  CHECK(palpate_world_lump(NULL, 0, &kept.lump) == PALPATE_ARGUMENT);
  CHECK(palpate_world_lump(world, 0, NULL) == PALPATE_ARGUMENT);
  kept.lump.size = 0;
  CHECK(palpate_world_lump(world, 0, &kept.lump) == PALPATE_ARGUMENT);
  CHECK(palpate_world_lump(bare, 0, &kept.lump) == PALPATE_ARGUMENT);

  finger = newFinger(world);
  CHECK(palpate_finger_pressure(finger, 4, 16.0, kpa, shear) == PALPATE_OK); /* it has felt nothing yet */
  for (i = 0; i < 16; ++i) CHECK(kpa[i] == 0.0f && shear[2 * i] == 0.0f && shear[2 * i + 1] == 0.0f);
  for (i = 0; i <= 300; ++i) { /* 7 mm deep, and 4 mm towards the head */
    for (axis = 0; axis < 3; ++axis) {
      tip[axis] = kept.lump.foot_mm[axis] + (12.0 - 0.045 * i + 0.5) * kept.lump.axis[axis] + 4.0 * kept.lump.up[axis];
    }
    CHECK(palpate_finger_step(finger, tip, &touch) == PALPATE_OK);
  }
  CHECK(touch.touch != PALPATE_FREE && touch.lump_share > 0.01 && touch.lump == 0);
  CHECK(touch.lump_moved_mm[1] < 0.0 && touch.reserved_2 == 0);
  for (axis = 0; axis < 3; ++axis) {
    normal_n += touch.force_n[axis] * touch.normal[axis];
    lateral_n += touch.lump_force_n[axis] * kept.lump.up[axis];
  }
  CHECK(lateral_n > 0.0); /* it pushes the tip off itself */
  CHECK(palpate_finger_pressure(finger, 4, 16.0, kpa, shear) == PALPATE_OK);
  for (i = 0; i < 16; ++i) sum_n += kpa[i] * 16.0 / 1000.0;
  CHECK(fabs(sum_n - normal_n) < 1e-5 * normal_n);
  CHECK(palpate_finger_pressure(finger, 16, 16.0, wide, NULL) == PALPATE_OK && wide[0] == 0.0f);

  CHECK(palpate_finger_pressure(NULL, 4, 16.0, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, 4, 16.0, NULL, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, 1, 16.0, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, 17, 16.0, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, (size_t)-1, 16.0, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, 4, 0.5, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_pressure(finger, 4, NAN, kpa, NULL) == PALPATE_ARGUMENT);
  CHECK(palpate_finger_lift(finger) == PALPATE_OK);
  CHECK(palpate_finger_pressure(finger, 4, 16.0, kpa, NULL) == PALPATE_OK && kpa[5] == 0.0f);
  palpate_finger_release(finger);
  finger = newFinger(bare);
  CHECK(palpate_finger_pressure(finger, 4, 16.0, kpa, NULL) == PALPATE_REFUSED); /* its tissue has no layers */
  palpate_finger_release(finger);
  palpate_world_release(world);
}

int main(void) {
  palpate_world* world = sheetWorld();
  CHECK(world != NULL);
  CHECK(strcmp(palpate_version(), PALPATE_VERSION) == 0);
  testArrays();
  testErrors();
  if (world != NULL) {
    testSettings(world);
    testStep(world);
    testRollout(world);
    testSkin(world);
    testWorld(world);
    testLumps(world);
  }
  palpate_world_release(world);
  return checksDone("c.interface");
}
