// Takes samples out of the ring on a thread of its own, so that files are written beside the servo loop and not in it.
#pragma once

#include <exception>
#include <functional>
#include <thread>

#include "palpate/servo/loop.h"

namespace palpate::servo {

class SampleDrain {
 public:
  using Sink = std::function<void(const trace::Sample&)>;

  /// Starts the thread; `sink` gets every sample of `links` in order. It may throw: see join.
  SampleDrain(LoopLinks& links, Sink sink);
  ~SampleDrain();
  SampleDrain(const SampleDrain&) = delete;
  SampleDrain& operator=(const SampleDrain&) = delete;

  /// Waits until the loop has finished and the ring is empty. Throws what the sink threw; after that samples were
  /// dropped.
  void join();

 private:
  void run();
  void emptyRing();

  LoopLinks& links_;
  Sink sink_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace palpate::servo
