/* A flat sheet z = 0, 200 mm wide, facing up, in arrays: a world that is built in milliseconds. */
#ifndef PALPATE_TESTS_SHEET_H
#define PALPATE_TESTS_SHEET_H

#include <string.h>

#include "palpate.h"

#define SHEET_CELLS 20
#define SHEET_SIDE (SHEET_CELLS + 1)
#define SHEET_VERTICES (SHEET_SIDE * SHEET_SIDE)
#define SHEET_TRIANGLES (2 * SHEET_CELLS * SHEET_CELLS)

typedef struct Sheet {
  double positions[3 * SHEET_VERTICES];
  int32_t corners[3 * SHEET_TRIANGLES];
  double stiffness[SHEET_VERTICES];
} Sheet;

static void fillSheet(Sheet* s) {
  int x, y, t = 0;
  for (y = 0; y < SHEET_SIDE; ++y) {
    for (x = 0; x < SHEET_SIDE; ++x) {
      double* p = s->positions + 3 * (y * SHEET_SIDE + x);
      p[0] = 10.0 * x;
      p[1] = 10.0 * y;
      p[2] = 0.0;
      s->stiffness[y * SHEET_SIDE + x] = 0.5;
    }
  }
  for (y = 0; y < SHEET_CELLS; ++y) {
    for (x = 0; x < SHEET_CELLS; ++x) {
      const int32_t a = y * SHEET_SIDE + x;
      const int32_t six[6] = {a, a + 1, a + SHEET_SIDE + 1, a, a + SHEET_SIDE + 1, a + SHEET_SIDE};
      memcpy(s->corners + t, six, sizeof six);
      t += 6;
    }
  }
}

/* With nothing else in it. */
static palpate_arrays arraysOf(const Sheet* s) {
  palpate_arrays arrays;
  memset(&arrays, 0, sizeof arrays);
  arrays.size = sizeof arrays;
  arrays.positions_mm = s->positions;
  arrays.vertices = SHEET_VERTICES;
  arrays.corners = s->corners;
  arrays.triangles = SHEET_TRIANGLES;
  arrays.stiffness_n_per_mm = s->stiffness;
  return arrays;
}

/* Null where it cannot be made. */
static palpate_world* sheetWorld(void) {
  static Sheet s;
  palpate_arrays arrays;
  palpate_world* world = NULL; /* NOLINT(modernize-use-nullptr): C, too */
  fillSheet(&s);
  arrays = arraysOf(&s);
  palpate_world_from_arrays(&arrays, &world, NULL); /* NOLINT(modernize-use-nullptr) */
  return world;
}

/* Tick i of a press of 5 mm, a drag of 20 mm and a lift: 1,000 ticks. */
#define SHEET_TICKS 1000
static void sheetTip(int i, double tip[3]) {
  tip[0] = 103.0 + (i < 300 ? 0.0 : i < 700 ? 0.05 * (i - 300) : 20.0);
  tip[1] = 101.0;
  tip[2] = i < 300 ? 2.0 - 7.0 * i / 300.0 : i < 700 ? -5.0 : -5.0 + 8.0 * (i - 700) / 300.0;
}

#endif
