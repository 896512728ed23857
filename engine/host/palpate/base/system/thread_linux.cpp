// Each wake-up is requested at an absolute time of the monotonic clock: an interrupted sleep is just requested again.
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <time.h>

#include <cerrno>
#include <cstring>

#include "palpate/base/system/thread.h"

namespace palpate::system {

namespace {

void addNote(ThreadGrant& grant, const char* what, int error) {
  if (!grant.note.empty()) grant.note += "; ";
  grant.note += what;
  grant.note += " refused: ";
  grant.note += std::strerror(error);
}

int askForFifo(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted);
}

}  // namespace

ThreadGrant askForRealtime(int priority) {
  ThreadGrant grant;
  // The default slack lets the kernel deliver a timer up to 50 us late; 1 ns needs no privilege.
  grant.exact_timers = ::prctl(PR_SET_TIMERSLACK, 1) == 0;
  if (!grant.exact_timers) addNote(grant, "timer slack of 1 ns", errno);
  const int refused = askForFifo(priority);
  grant.realtime = refused == 0;
  if (!grant.realtime) addNote(grant, "SCHED_FIFO", refused);
  // Not MCL_FUTURE: under a memory limit it makes later allocations of the whole process fail.
  grant.memory_locked = ::mlockall(MCL_CURRENT) == 0;
  if (!grant.memory_locked) addNote(grant, "mlockall", errno);
  return grant;
}

void askForRealtimePriority(int priority) { (void)askForFifo(priority); }

void releaseMemory() { ::munlockall(); }

void sleepUntil(std::int64_t ns) noexcept {
  const timespec when{ns / 1'000'000'000, ns % 1'000'000'000};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
}

void lowerPriority(int nice) { ::setpriority(PRIO_PROCESS, 0, nice); }

}  // namespace palpate::system
