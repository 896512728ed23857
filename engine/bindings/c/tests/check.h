/* Counting checks for tests in C: a failed one says where, and the program goes on. */
#ifndef PALPATE_TESTS_CHECK_H
#define PALPATE_TESTS_CHECK_H

#include <stdio.h>
#include <string.h>

static int checks_made;
static int checks_failed;

#define CHECK(condition)                                                      \
  do {                                                                        \
    ++checks_made;                                                            \
    if (!(condition)) {                                                       \
      ++checks_failed;                                                        \
      fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                         \
  } while (0)

/* Bit by bit: of numbers, too. */
static inline int sameBytes(const void* one, const void* other, size_t bytes) { return memcmp(one, other, bytes) == 0; }

/* What main returns. */
static int checksDone(const char* name) {
  printf("%s: %d checks, %d failed\n", name, checks_made, checks_failed);
  return checks_failed == 0 && checks_made > 0 ? 0 : 1;
}

#endif
