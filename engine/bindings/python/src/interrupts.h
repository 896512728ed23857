// Long calls: the interpreter's lock is released, and Ctrl-C is checked by time, not by count, since a tick of a sphere
// on a fine mesh takes a hundred times as long as one of a point.
//
//   return unlocked([&](Interrupts& interrupts) { for (...) { work(); interrupts.check(); } return result; });
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "palpate/base/progress.h"

namespace palpate::python {

/// Thrown by Interrupts with the Python error set; only `unlocked` catches it. Not a std::exception, so that no
/// handler on its way takes it for a failure of the engine.
struct Interrupted {};

#if PY_VERSION_HEX < 0x030D0000
inline bool isFinalizing() { return _Py_IsFinalizing() != 0; }
#else
inline bool isFinalizing() { return Py_IsFinalizing() != 0; }
#endif

/// Python ends the threads that want the lock after the interpreter has gone, by unwinding them. They would take the
/// process with them at the first noexcept function; ours wait for the end of the process instead.
inline void waitForEverIfFinalizing() {
  while (isFinalizing()) pause();
}

/// Releases the lock for its life.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() noexcept(false) {
    waitForEverIfFinalizing();
    PyEval_RestoreThread(state_);
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Serves one long call, on the thread that Python called. Python handles signals on its main thread only; elsewhere
/// nothing is found.
class Interrupts {
 public:
  /// Call it often, without the lock: it looks at the clock and, every 20 ms, at the signals. Throws Interrupted when a
  /// handler raised something (KeyboardInterrupt). Nothing on other threads than that of the call.
  void check() {
    if (std::this_thread::get_id() != caller_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetween;
    waitForEverIfFinalizing();
    const PyGILState_STATE state = PyGILState_Ensure();
    const bool raised = PyErr_CheckSignals() != 0;
    PyGILState_Release(state);
    if (raised) throw Interrupted();
  }
  /// For what builds: a report of progress that looks at the signals. The engine lets what it throws through.
  Progress progress() {
    return [this](std::string_view, double) { check(); };
  }

 private:
  static constexpr std::chrono::milliseconds kBetween{20};
  std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kBetween;
};

/// Calls `work(interrupts)` without the lock. Call it with the lock held. Exceptions are rethrown with the lock held
/// again; an interruption as pybind11::error_already_set.
template <class Work>
auto unlocked(Work work) {
  try {
    const Unlocked free;
    Interrupts interrupts;
    return work(interrupts);
  } catch (const Interrupted&) {
    throw pybind11::error_already_set();
  }
}

}  // namespace palpate::python
