// Whether a program of this project can put its own functions in front of the C library's.
#pragma once

#include <cstdlib>

// A sanitizer replaces malloc and the mutexes itself; other C libraries lack the internal names that calls go on to.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define PALPATE_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PALPATE_SANITIZED 1
#endif

#if defined(__GLIBC__) && !defined(PALPATE_SANITIZED)
#define PALPATE_CAN_INTERPOSE 1
#endif
