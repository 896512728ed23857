// Ctrl-C in long calls that have released the interpreter's lock: asked for by time, not by count, since a tick of a
// sphere on a fine mesh takes a hundred times as long as one of a point.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

#include "palpate/base/progress.h"

namespace palpate::python {

/// For one long call on the thread that Python called. Signals are handled on Python's main thread only; elsewhere
/// `check` finds nothing.
class Interrupts {
 public:
  /// Call it often, without the lock: it looks at the clock and, every 20 ms, at the signals. Throws what a handler
  /// raised (KeyboardInterrupt) as pybind11::error_already_set.
  void check() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetween;
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
  /// For what builds: a report of progress that looks at the signals. The engine lets exceptions of it through.
  Progress progress() {
    return [this](std::string_view, double) { check(); };
  }

 private:
  static constexpr std::chrono::milliseconds kBetween{20};
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kBetween;
};

}  // namespace palpate::python
