// Runs ticks: paced against the clock for a hand, or as fast as the machine can for a script.
//
// Paced, the caller's thread becomes the servo thread. It hands samples to a ring buffer (the trace writer empties it)
// and the newest contacts to a triple buffer (the display looks at it), and measures itself: how late it woke, and how
// long a tick took to compute. The two are kept apart because the first is the system's doing and the second is ours.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/ring_buffer.h"
#include "palpate/base/triple_buffer.h"
#include "palpate/servo/histogram.h"
#include "palpate/servo/pacing.h"
#include "palpate/servo/tick.h"

namespace palpate::servo {

struct LoopReport {
  std::uint64_t ticks = 0;       ///< computed
  std::uint64_t overruns = 0;    ///< deadlines that passed without a tick (paced only)
  std::uint64_t slow_ticks = 0;  ///< took longer to compute than a tick may last
  std::uint64_t stalls = 0;      ///< times the loop was away longer than the watchdog allows (paced only)
  std::uint64_t dropped_samples = 0;
  DurationPercentiles compute;   ///< reading the clock to reading it again around one tick of all fingers
  DurationPercentiles lateness;  ///< wake-up after the deadline (paced only)
  double wall_s = 0.0;
  PacingGrant grant;
};

/// Runs ticks 0 .. ticks-1 back to back; `sink` gets each tick's samples, in order. Deterministic. Ends early, with the
/// ticks so far, when `stop`, called every few ticks, returns true.
LoopReport runHeadless(Rig& rig, std::uint64_t ticks, const std::function<void(std::span<const trace::Sample>)>& sink,
                       const Progress& progress = {}, const std::function<bool()>& stop = {});

/// Recent state of the loop: published once a second, for a display.
struct LoopVitals {
  std::uint64_t ticks = 0;  ///< since the start, like the other counts
  std::uint64_t overruns = 0;
  std::uint64_t slow_ticks = 0;
  std::uint64_t stalls = 0;
  DurationPercentiles compute;  ///< over the last second, like `lateness` and the rate
  DurationPercentiles lateness;
  double ticks_per_s = 0.0;
};

/// Results of one tick, a sample for every finger in the scene's order.
using TickSamples = std::vector<trace::Sample>;

/// A sample for a recorder; missing numbers had no room.
struct NumberedSample {
  std::uint64_t number = 0;  ///< counts all samples that were to be recorded
  trace::Sample sample;
};

/// Puts it into such a ring; `number` counts on, even if the ring is full.
inline void pushNumbered(RingBuffer<NumberedSample>& ring, const trace::Sample& sample, std::uint64_t& number) {
  ring.pushWith([&](NumberedSample& slot) {
    slot.number = number;
    slot.sample = sample;
  });
  ++number;
}

/// Capacity of LoopLinks::record: a disk that stops for seconds loses nothing, 16 s for two fingers at 1 kHz.
inline constexpr std::size_t kRecordCapacity = std::size_t{1} << 15;

/// Data that a paced loop shares with other threads.
struct LoopLinks {
  explicit LoopLinks(std::size_t fingers, std::size_t ring_capacity = std::size_t{1} << 16,
                     std::size_t record_capacity = 0)
      : samples(ring_capacity), record(record_capacity), contacts(TickSamples(fingers)) {}
  RingBuffer<trace::Sample> samples;
  RingBuffer<NumberedSample> record;  ///< the same once more, for a recorder
  std::atomic<bool> records{false};   ///< a recorder empties it
  std::uint64_t numbered = 0;         ///< the loop's: samples that were to be recorded so far
  TripleBuffer<TickSamples> contacts;
  TripleBuffer<LoopVitals> vitals;
  EmergencyStop emergency_stop;               ///< pressed from any thread: no forces from the next tick on
  std::atomic<bool> stop{false};              ///< set from any thread: the loop ends after the current tick
  std::atomic<bool> finished{false};          ///< set by the loop when no more samples will come
  std::atomic<std::int64_t> heartbeat_ns{0};  ///< monotonicNs() of the newest tick: a watchdog's view of the loop
};

struct PacedSettings {
  PacingSettings pacing;
  /// The loop was away this long, s: the hand has moved on, so this is a fault: no force, and the start rule again.
  double watchdog_s = 0.050;
  /// Called on the servo thread before each tick; may exchange the rig's parts, and must keep a device's rules: no
  /// lock, no allocation, no exception, a fraction of a tick. May be empty.
  std::function<void(Rig&)> before_tick;
};

/// Runs paced ticks on the calling thread until the deadline of tick `ticks` - 1 has passed or `links.stop` is set. At
/// the end every device gets zero force.
LoopReport runPaced(Rig& rig, std::uint64_t ticks, const PacedSettings& settings, LoopLinks& links);

// Takes samples out of the ring on a thread of its own, so that files are written outside the servo loop.

class SampleDrain {
 public:
  using Sink = std::function<void(const trace::Sample&)>;

  /// Starts the thread; `sink` gets every sample of `links` in order. It may throw: see join.
  SampleDrain(LoopLinks& links, Sink sink);
  ~SampleDrain();
  SampleDrain(const SampleDrain&) = delete;
  SampleDrain& operator=(const SampleDrain&) = delete;

  /// Waits until the loop has finished and the ring is empty. Rethrows the sink's exception; after that samples were
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
