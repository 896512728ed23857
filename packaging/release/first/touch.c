/* The first touch from C: a fingertip presses the torso 30 mm beside T6 and drags. Prints the largest force and a hash of all.
 *
 *   cc -ffp-contract=off touch.c $(pkg-config --cflags --libs palpate) -o touch && ./touch
 */
#include <palpate.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  palpate_error error = {sizeof error, 0, 0, ""};
  palpate_world* world = NULL;
  palpate_finger* finger = NULL;
  palpate_finger_settings settings;
  palpate_place place = {sizeof place};
  palpate_touch touch = {sizeof touch};
  uint64_t hash = 14695981039346656037u; /* FNV-1a */
  double tip[3], most = 0.0;
  int tick, axis;

  palpate_finger_settings_init(&settings, sizeof settings);
  settings.radius_mm = 8.0;
  if (palpate_world_torso(0, &world, &error) || palpate_world_place(world, "T6 right 30 mm", &place, &error) ||
      palpate_finger_create(world, &settings, &finger, &error)) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  for (tick = 0; tick < 1000; ++tick) { /* milliseconds */
    const double deep_mm = tick < 500 ? tick * 0.03125 - 8.0 : 7.625;
    for (axis = 0; axis < 3; ++axis) tip[axis] = place.point_mm[axis] + (8.0 - deep_mm) * place.normal[axis];
    if (tick >= 500) tip[1] += 0.03125 * (tick - 500);
    palpate_finger_step(finger, tip, &touch);
    for (axis = 0; axis < 3; ++axis) {
      unsigned char bytes[sizeof(double)]; /* little-endian */
      size_t i;
      memcpy(bytes, &touch.force_n[axis], sizeof bytes);
      for (i = 0; i < sizeof bytes; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    if (touch.force_n[2] > most) most = touch.force_n[2];
  }
  printf("at most %.2f N; hash of 1000 forces %016llx\n", most, (unsigned long long)hash);
  palpate_finger_release(finger);
  palpate_world_release(world);
  return 0;
}
