/* Eight threads on one world, each with a finger and a skin of its own, while others retain, release and rebuild it:
 * all feel the same. Whatever is shared without care is found by ThreadSanitizer (tools/sanitize-c). */
#include <pthread.h>
#include <string.h>

#include "check.h"
#include "palpate.h"
#include "sheet.h"

#define THREADS 8

static palpate_world* world;
static double forces[THREADS][SHEET_TICKS][3];
static int failures[THREADS];

static void* feel(void* number) {
  const int n = *(const int*)number;
  palpate_finger* finger = NULL;
  palpate_skin* skin = NULL;
  palpate_touch touch;
  int i;
  palpate_world_retain(world);
  memset(&touch, 0, sizeof touch);
  touch.size = sizeof touch;
  failures[n] += palpate_finger_create(world, NULL, &finger, NULL) != PALPATE_OK;
  failures[n] += palpate_skin_create(world, 1, 0, &skin, NULL) != PALPATE_OK;
  palpate_world_release(world);
  for (i = 0; i < SHEET_TICKS; ++i) {
    double tip[3];
    sheetTip(i, tip);
    failures[n] += palpate_finger_step(finger, tip, &touch) != PALPATE_OK;
    memcpy(forces[n][i], touch.force_n, sizeof touch.force_n);
    if (i % 16 == 0) failures[n] += palpate_skin_apply(skin, &touch, 1, sizeof touch) != PALPATE_OK;
  }
  palpate_skin_release(skin);
  palpate_finger_release(finger);
  return NULL;
}

static void* rebuild(void* times) {
  int i;
  for (i = 0; i < *(const int*)times; ++i) {
    palpate_world *other = NULL, *refused = NULL;
    palpate_error error;
    memset(&error, 0, sizeof error);
    error.size = sizeof error;
    if (palpate_world_rebuilt(world, "[friction]\nskin = \"oiled\"\n", NULL, &other, &error) != PALPATE_OK) {
      ++failures[0];
    }
    if (palpate_world_rebuilt(world, "nonsense", NULL, &refused, &error) != PALPATE_REFUSED) ++failures[0];
    palpate_world_release(other);
  }
  return NULL;
}

int main(void) {
  pthread_t threads[THREADS], builder;
  int numbers[THREADS], times = 5, i, moved = 0;
  world = sheetWorld();
  CHECK(world != NULL);
  for (i = 0; i < THREADS; ++i) {
    numbers[i] = i;
    CHECK(pthread_create(&threads[i], NULL, feel, &numbers[i]) == 0);
  }
  CHECK(pthread_create(&builder, NULL, rebuild, &times) == 0);
  for (i = 0; i < THREADS; ++i) pthread_join(threads[i], NULL);
  pthread_join(builder, NULL);
  for (i = 0; i < THREADS; ++i) {
    CHECK(failures[i] == 0);
    CHECK(sameBytes(forces[i], forces[0], sizeof forces[0]));
  }
  for (i = 0; i < SHEET_TICKS; ++i) moved += forces[0][i][2] > 0.5;
  CHECK(moved > SHEET_TICKS / 2);
  palpate_world_release(world);
  return checksDone("c.threads");
}
