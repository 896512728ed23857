/* The smallest whole program in C: a torso, a finger that presses it beside T6 and drags, the skin that follows.
 *
 *   cc feel_a_back.c -lpalpate -lm -o feel_a_back && ./feel_a_back [scene.toml]
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "palpate.h"

static double length(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

int main(int argc, char** argv) {
  palpate_error error = {sizeof error, 0, 0, ""};
  palpate_world* world = NULL;
  palpate_finger* finger = NULL;
  palpate_skin* skin = NULL;
  palpate_finger_settings settings;
  palpate_touch touch;
  palpate_place place;
  double tip[3], farthest_mm = 0.0;
  size_t v;
  int tick, axis;

  if (argc > 1 ? palpate_world_load(argv[1], &world, &error) : palpate_world_torso(0, &world, &error)) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  palpate_finger_settings_init(&settings, sizeof settings);
  settings.radius_mm = 8.0; /* a fingertip */
  memset(&place, 0, sizeof place);
  place.size = sizeof place;
  if (palpate_finger_create(world, &settings, &finger, &error) || palpate_skin_create(world, 1, 0, &skin, &error) ||
      palpate_world_place(world, "T6 right 30 mm", &place, &error)) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }

  memset(&touch, 0, sizeof touch);
  touch.size = sizeof touch;
  for (tick = 0; tick < 1000; ++tick) {                            /* a device's loop does this once a millisecond */
    const double deep_mm = tick < 500 ? tick * 0.036 - 10.0 : 8.0; /* of the ball's lowest point */
    for (axis = 0; axis < 3; ++axis) tip[axis] = place.point_mm[axis] + (8.0 - deep_mm) * place.normal[axis];
    if (tick >= 500) tip[1] += 0.03 * (tick - 500); /* and 15 mm towards the head */
    palpate_finger_step(finger, tip, &touch);
    if (tick % 200 == 199) printf("depth %5.2f mm  force %5.2f N\n", touch.depth_mm, length(touch.force_n));
  }

  palpate_skin_apply(skin, &touch, 1, sizeof touch); /* once a picture */
  for (v = 0; v < palpate_skin_vertices(skin); ++v) {
    double by[3];
    for (axis = 0; axis < 3; ++axis) by[axis] = palpate_skin_displacements(skin, axis)[v];
    if (length(by) > farthest_mm) farthest_mm = length(by);
  }
  printf("%s: the skin beside %s gives way by up to %.2f mm\n", palpate_version(), place.name, farthest_mm);

  palpate_skin_release(skin);
  palpate_finger_release(finger);
  palpate_world_release(world);
  return touch.depth_mm > 1.0 && farthest_mm > 1.0 ? 0 : 1;
}
