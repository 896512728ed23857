/* Sessions through the C interface: facts, samples in portions, a replay; and every tick of a run of `palpate simulate`
 * felt again by palpate_finger_step, to the bit.  Usage: session_test KEPT.session [RUN.session] */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "palpate.h"

static palpate_error error;

static uint64_t sampleCount(palpate_session* session) {
  palpate_session_facts facts;
  memset(&facts, 0, sizeof facts);
  facts.size = sizeof facts;
  CHECK(palpate_session_get_facts(session, &facts) == PALPATE_OK);
  return facts.samples;
}

/* Of all ticks, in portions of so many. */
static size_t readAll(palpate_session* session, size_t room, palpate_sample* samples, palpate_touch* touches) {
  size_t all = 0, count = 0;
  uint64_t from = 0;
  do {
    CHECK(palpate_session_read(session, from, UINT64_MAX, samples + all, sizeof *samples, touches + all,
                               sizeof *touches, room, &count, &error) == PALPATE_OK);
    all += count;
    if (count > 0) from = samples[all - 1].tick + 1;
  } while (count > 0);
  return all;
}

static void testKept(const char* file) {
  palpate_session* session = NULL;
  palpate_session_facts facts;
  palpate_session_finger finger;
  palpate_replay replay;
  palpate_sample* samples;
  palpate_touch* touches;
  size_t count = 0;
  CHECK(palpate_session_open(NULL, &session, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_session_open("/no/such.session", &session, &error) == PALPATE_REFUSED && session == NULL);
  CHECK(palpate_session_open(file, &session, &error) == PALPATE_OK);
  if (session == NULL) return;
  memset(&facts, 0x5a, sizeof facts);
  facts.size = 32;
  CHECK(palpate_session_get_facts(session, &facts) == PALPATE_OK && facts.first_tick == 0x5a5a5a5a5a5a5a5au);
  facts.size = sizeof facts;
  CHECK(palpate_session_get_facts(session, &facts) == PALPATE_OK && facts.ticks_per_s == 1000.0);
  CHECK(facts.samples > 10 && facts.fingers == 1 && facts.worlds == 1 && facts.software[0] != '\0');
  CHECK(palpate_session_get_facts(NULL, &facts) == PALPATE_ARGUMENT);
  finger.size = sizeof finger;
  CHECK(palpate_session_get_finger(session, 0, &finger) == PALPATE_OK && finger.name[0] != '\0');
  CHECK(palpate_session_get_finger(session, 1, &finger) == PALPATE_ARGUMENT);

  samples = calloc((size_t)facts.samples, sizeof *samples);
  touches = calloc((size_t)facts.samples, sizeof *touches);
  CHECK(readAll(session, 7, samples, touches) == facts.samples);
  CHECK(samples[0].tick == facts.first_tick && samples[facts.samples - 1].tick == facts.last_tick);
  CHECK(palpate_session_read(session, 0, 9, NULL, 0, NULL, 0, 1000, &count, &error) == PALPATE_OK && count == 10);
  CHECK(palpate_session_read(session, 0, 9, NULL, 0, NULL, 0, 0, &count, &error) == PALPATE_ARGUMENT && count == 0);
  CHECK(palpate_session_read(session, 0, 9, samples, 3, NULL, 0, 9, &count, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_session_read(session, 0, 9, NULL, 0, NULL, 0, 9, NULL, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_session_read(NULL, 0, 9, NULL, 0, NULL, 0, 9, &count, &error) == PALPATE_ARGUMENT);

  memset(&replay, 0, sizeof replay);
  replay.size = sizeof replay;
  CHECK(palpate_session_replay(session, NULL, NULL, &error) == PALPATE_ARGUMENT);
  CHECK(palpate_session_replay(session, NULL, &replay, &error) == PALPATE_OK);
  CHECK(replay.identical == 1 && replay.ticks == facts.samples && replay.different == 0 && replay.difference[0] == 0);
  free(samples);
  free(touches);
  palpate_session_close(session);
  palpate_session_close(NULL);
}

/* A run of one finger. */
static void testRun(const char* file) {
  palpate_session* session = NULL;
  palpate_world* world = NULL;
  palpate_finger* finger = NULL;
  palpate_sample* samples;
  palpate_touch *recorded, touch;
  size_t count, i, different = 0, touching = 0;
  CHECK(palpate_session_open(file, &session, &error) == PALPATE_OK);
  if (session == NULL) return;
  count = (size_t)sampleCount(session);
  samples = calloc(count, sizeof *samples);
  recorded = calloc(count, sizeof *recorded);
  CHECK(readAll(session, 1000, samples, recorded) == count);
  CHECK(palpate_session_world(session, 1, NULL, &world, &error) == PALPATE_REFUSED); /* it has but one */
  CHECK(palpate_session_world(session, 0, NULL, &world, &error) == PALPATE_OK);
  CHECK(palpate_finger_create(world, NULL, &finger, &error) == PALPATE_OK);
  palpate_world_release(world);
  palpate_session_close(session);
  memset(&touch, 0, sizeof touch);
  touch.size = sizeof touch;
  for (i = 0; i < count; ++i) {
    CHECK(palpate_finger_step(finger, recorded[i].tip_mm, &touch) == PALPATE_OK);
    touch.tick = recorded[i].tick;
    touch.tissue_mm = 0.0; /* is not recorded */
    different += !sameBytes(&touch, &recorded[i], sizeof touch);
    touching += touch.touch != PALPATE_FREE;
  }
  CHECK(different == 0);
  CHECK(touching * 2 > count);
  palpate_finger_release(finger);
  free(samples);
  free(recorded);
}

int main(int argc, char** argv) {
  error.size = sizeof error;
  if (argc < 2) return 2;
  testKept(argv[1]);
  if (argc > 2) testRun(argv[2]);
  return checksDone("c.session");
}
