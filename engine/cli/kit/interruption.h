// Orderly shutdown: the effect of SIGINT, SIGTERM and SIGHUP on a command, so that recordings are finished and partial
// results are named as such.
#pragma once

#include <exception>
#include <string_view>

#include "palpate/base/progress.h"
#include "palpate/servo/emergency_stop.h"

namespace palpate::app {

/// From now on such a signal ends the program with exit code 128 + its number: at once where there is nothing to finish
/// (no open file, no live FinishesInOrder), else when that is done; a second signal ends it at once. One that was
/// ignored when the program started (nohup) stays ignored. A file that grows over a limit and a reader of a pipe that
/// has left become errors of the write instead of silent ends.
void listenForSignals();

/// While one lives, a signal is only a request: work checks endingSignal().
class FinishesInOrder {
 public:
  FinishesInOrder();
  ~FinishesInOrder();
  FinishesInOrder(const FinishesInOrder&) = delete;
  FinishesInOrder& operator=(const FinishesInOrder&) = delete;
};

/// While one lives, a signal ends the program at once, whatever FinishesInOrder lives around it: a world is being
/// built, and nothing would be lost. After a signal, making one throws Ended.
class EndAtOnce {
 public:
  EndAtOnce();
  ~EndAtOnce();
  EndAtOnce(const EndAtOnce&) = delete;
  EndAtOnce& operator=(const EndAtOnce&) = delete;

 private:
  int orderly_before_;
};

/// While it lives, such a signal presses the emergency stop in its handler, before anything else: no hand waits for a
/// window to close. One at a time.
class StoppedBySignal {
 public:
  explicit StoppedBySignal(servo::EmergencyStop& stop);
  ~StoppedBySignal();
  StoppedBySignal(const StoppedBySignal&) = delete;
  StoppedBySignal& operator=(const StoppedBySignal&) = delete;
};

/// The signal that requested the end, or 0.
int endingSignal();
/// "SIGINT"; empty for 0.
std::string_view nameOfSignal(int signal);
/// The exit code that a shell expects after a signal: 130 for SIGINT.
inline int signalExitCode(int signal) { return 128 + signal; }

/// Not an Error: nothing is wrong, and code that logs errors and continues must not continue.
class Ended : public std::exception {
 public:
  const char* what() const noexcept override { return "ended before it was done"; }
};

/// Throws Ended after a signal.
void throwIfInterrupted();

/// The same progress, but work that reports it throws Ended after a signal.
Progress interruptible(Progress progress);

}  // namespace palpate::app
