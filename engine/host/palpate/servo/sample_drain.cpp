// Polls: to be woken would cost the servo a system call. After the sink threw it continues to empty the ring without
// it, so that the loop's count of dropped samples stays the loop's own.
// Data flow: ring buffer of LoopLinks -> here, on a thread of its own -> sink, which writes files.
#include "palpate/servo/loop.h"

#include <chrono>

namespace palpate::servo {

namespace {

/// Between two looks at the ring: it holds seconds of samples, so this may be slow and the servo never waits for it.
constexpr std::chrono::milliseconds kPause{5};

}  // namespace

SampleDrain::SampleDrain(LoopLinks& links, Sink sink)
    : links_(links), sink_(std::move(sink)), thread_([this] { run(); }) {}

SampleDrain::~SampleDrain() {
  if (thread_.joinable()) thread_.join();
}

void SampleDrain::join() {
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void SampleDrain::run() {
  // `finished` is read before the ring is emptied: samples pushed before it was set are seen.
  for (bool finished = false; !finished;) {
    finished = links_.finished.load(std::memory_order_acquire);
    emptyRing();
    if (!finished) std::this_thread::sleep_for(kPause);
  }
}

void SampleDrain::emptyRing() {
  trace::Sample sample;
  while (links_.samples.pop(sample)) {
    if (failure_) continue;
    try {
      sink_(sample);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
}

}  // namespace palpate::servo
