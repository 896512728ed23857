// Precision of a thread's wake-ups, and its priority.
#pragma once

#include <cstdint>
#include <string>

namespace palpate::system {

/// Privileges of a thread that must wake in time.
struct ThreadGrant {
  bool realtime = false;  ///< before all ordinary work: SCHED_FIFO, on Windows the class "Pro Audio" of MMCSS
  bool memory_locked = false;
  bool exact_timers = false;
  std::string note;  ///< refused requests and why; empty if all were granted
};

/// For the calling thread and, for its memory, the process. `priority`: of SCHED_FIFO.
ThreadGrant askForRealtime(int priority);
/// The priority alone; refused without a word.
void askForRealtimePriority(int priority);
/// Undoes what askForRealtime did to the process.
void releaseMemory();

/// Sleeps until the monotonic clock shows this; may wake late. Takes no memory.
void sleepUntil(std::int64_t ns) noexcept;

/// Ranks the calling thread behind drawing and touching: its nice value, 1 to 19. Nothing happens where that would slow
/// the whole process.
void lowerPriority(int nice);

}  // namespace palpate::system
