// Ending in order: what SIGINT, SIGTERM and SIGHUP do to a command, so that recordings are finished and partial results
// are named as such.
#pragma once

#include <exception>
#include <string_view>

#include "palpate/base/progress.h"
#include "palpate/servo/emergency_stop.h"

namespace palpate::app {

/// From now on such a signal ends the program with exit code 128 + its number: at once where there is nothing to finish
/// (no file is under way, no FinishesInOrder lives), else when that is done; a second signal ends it at once. One that
/// was ignored when the program started (nohup) stays ignored. A file that grows over a limit and a reader of a pipe
/// that has left become errors of the write instead of ends without a word.
void listenForSignals();

/// While one lives, a signal is only a request: what works looks at endAskedBy().
class FinishesInOrder {
 public:
  FinishesInOrder();
  ~FinishesInOrder();
  FinishesInOrder(const FinishesInOrder&) = delete;
  FinishesInOrder& operator=(const FinishesInOrder&) = delete;
};

/// While one lives, a signal ends the program at once, whatever FinishesInOrder lives around it: a world is built, and
/// there is nothing yet that anybody would miss. Where a signal has asked already, making one throws Ended.
class NothingToFinish {
 public:
  NothingToFinish();
  ~NothingToFinish();
  NothingToFinish(const NothingToFinish&) = delete;
  NothingToFinish& operator=(const NothingToFinish&) = delete;

 private:
  int orderly_before_;
};

/// While it lives, such a signal presses the emergency stop in its handler, before anything else is done about it: no
/// hand waits for a window to close. One at a time.
class StoppedBySignal {
 public:
  explicit StoppedBySignal(servo::EmergencyStop& stop);
  ~StoppedBySignal();
  StoppedBySignal(const StoppedBySignal&) = delete;
  StoppedBySignal& operator=(const StoppedBySignal&) = delete;
};

/// The signal that asked for the end, or 0.
int endAskedBy();
/// "SIGINT"; empty for 0.
std::string_view nameOfSignal(int signal);
/// What a shell expects of a program that a signal ended: 130 for SIGINT.
inline int exitCodeOf(int signal) { return 128 + signal; }

/// Not an Error: nothing is wrong, and whoever makes a note of errors and goes on must not go on.
class Ended : public std::exception {
 public:
  const char* what() const noexcept override { return "ended before it was done"; }
};

/// Throws Ended when the end was asked for.
void endIfAsked();

/// The same progress, but work that reports it ends there (by Ended) when the end was asked for.
Progress endingWhenAsked(Progress progress);

}  // namespace palpate::app
