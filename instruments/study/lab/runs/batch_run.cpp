// Threads make their own fingers, so that these lie where they work, and meet once, before the first tick. They share
// the body, which is read-only.
#include "lab/runs/batch_run.h"

#include <algorithm>
#include <barrier>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/fingers.h"

namespace palpate::bench {

namespace {

/// Ticks of all fingers in a pass: 70 ms of points, half a second of fingertips.
constexpr std::size_t kPassTicks = 500000;
/// Another program slows the pass that it interrupts; of two passes one may have been left alone.
constexpr int kMinBatchRounds = 2;

/// A finger that came to its place along the path: one that was put down in the skin would feel nothing.
struct Begun {
  std::size_t place = 0;
  contact::FingerState state;
};

/// Subject of a pass; the same for all of its threads.
struct Pass {
  const scene::World& world;
  contact::FingerSettings finger;
  std::span<const Vec3> path;
  std::vector<Begun> fingers;
  std::size_t finger_ticks = 0;  ///< per finger
  std::size_t action_ticks = 0;  ///< divides finger_ticks
};

/// Evenly along the path.
std::vector<Begun> sampleStartStates(const scene::World& world, const contact::FingerSettings& settings,
                                     std::span<const Vec3> path, std::size_t count) {
  engine::Finger walker = std::move(engine::fingersOn(world, {&settings, 1}).front());
  std::vector<Begun> begun;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = i * path.size() / count;
    while (walker.ticks < place) walker.feel(path[walker.ticks]);
    begun.push_back({place, walker.state});
  }
  return begun;
}

/// Felt by a finger in a pass: its last tick, and the sum of all forces, which every tick changes.
struct Felt {
  contact::FingerOutput last;
  Vec3 sum = Vec3::Zero();
};

/// Result of one thread.
struct Share {
  Clock::time_point began, ended;
  std::size_t touching = 0;
  lab::ThreadCounts counts;
};

/// Fingers [first, first + felt.size()) of a pass, on the thread that calls it. `start` waits for the others.
template <class Start>
Share stepShare(const Pass& pass, std::size_t first, std::span<Felt> felt, Start&& start) {
  const std::vector<contact::FingerSettings> settings(felt.size(), pass.finger);
  std::vector<engine::Finger> fingers = engine::fingersOn(pass.world, settings);
  std::vector<std::size_t> places(felt.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = pass.fingers[first + i].place;
    fingers[i].state = pass.fingers[first + i].state;
    fingers[i].ticks = places[i];
  }
  Share share;
  start();
  const lab::ThreadCounts before = lab::countsOfThisThread();
  share.began = Clock::now();
  for (std::size_t done = 0; done < pass.finger_ticks; done += pass.action_ticks) {
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      std::size_t& place = places[i];
      for (std::size_t k = 0; k < pass.action_ticks; ++k) {
        felt[i].last = fingers[i].feel(pass.path[place]);
        felt[i].sum += felt[i].last.force;
        share.touching += felt[i].last.depth_mm > 0.0 ? 1 : 0;
        if (++place == pass.path.size()) place = 0;
      }
    }
  }
  share.ended = Clock::now();
  share.counts = lab::countsSince(before);
  return share;
}

struct PassResult {
  double ticks_per_s = 0.0;
  double touching = 0.0;
  std::vector<Felt> felt;
  std::optional<std::uint64_t> allocations = 0, locks = 0;
};

std::optional<std::uint64_t> addCounts(std::optional<std::uint64_t> a, std::optional<std::uint64_t> b) {
  if (!a || !b) return {};
  return *a + *b;
}

PassResult summarisePass(const Pass& pass, const std::vector<Share>& shares) {
  PassResult result;
  Clock::time_point began = shares.front().began, ended = shares.front().ended;
  std::size_t touching = 0;
  for (const Share& share : shares) {
    began = std::min(began, share.began);
    ended = std::max(ended, share.ended);
    touching += share.touching;
    result.allocations = addCounts(result.allocations, share.counts.allocations);
    result.locks = addCounts(result.locks, share.counts.locks);
  }
  const auto ticks = static_cast<double>(pass.fingers.size() * pass.finger_ticks);
  result.ticks_per_s = ticks / std::chrono::duration<double>(ended - began).count();
  result.touching = static_cast<double>(touching) / ticks;
  return result;
}

PassResult runPass(const Pass& pass, std::size_t threads) {
  std::vector<Felt> felt(pass.fingers.size());
  std::vector<Share> shares(threads);
  std::barrier start(static_cast<std::ptrdiff_t>(threads));
  const auto work = [&](std::size_t thread) {
    const std::size_t first = felt.size() * thread / threads;
    const std::size_t end = felt.size() * (thread + 1) / threads;
    shares[thread] =
        stepShare(pass, first, std::span(felt).subspan(first, end - first), [&] { start.arrive_and_wait(); });
  };
  std::vector<std::thread> others;
  for (std::size_t thread = 1; thread < threads; ++thread) others.emplace_back(work, thread);
  work(0);
  for (std::thread& other : others) other.join();
  PassResult result = summarisePass(pass, shares);
  result.felt = std::move(felt);
  return result;
}

std::size_t countDifferences(const PassResult& one, const PassResult& other) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < one.felt.size(); ++i) {
    const Felt& a = one.felt[i];
    const Felt& b = other.felt[i];
    different += a.sum == b.sum && a.last.proxy == b.last.proxy && a.last.status == b.last.status ? 0 : 1;
  }
  return different;
}

/// A pass by one thread, and one by several.
void comparePasses(const Pass& pass, std::size_t threads, BatchRates& rates, BatchFigures& figures) {
  const PassResult one = runPass(pass, 1);
  const PassResult several = runPass(pass, threads);
  rates.one_thread_ticks_per_s = std::max(rates.one_thread_ticks_per_s, one.ticks_per_s);
  rates.ticks_per_s = std::max(rates.ticks_per_s, several.ticks_per_s);
  figures.touching = one.touching;
  figures.different += countDifferences(one, several);
  for (const PassResult* result : {&one, &several}) {
    figures.allocations = addCounts(figures.allocations, result->allocations);
    figures.locks = addCounts(figures.locks, result->locks);
  }
}

}  // namespace

BatchFigures measureBatch(const scene::World& world, const contact::FingerSettings& finger, std::span<const Vec3> path,
                          const BatchSettings& settings, const Progress& progress) {
  engine::checkFingers(world, {&finger, 1});
  if (path.empty()) throw Error("a batch needs a path");
  const std::size_t actions = std::max<std::size_t>(1, kPassTicks / (settings.fingers * settings.action_ticks));
  const std::size_t finger_ticks = actions * settings.action_ticks;
  const Pass batch{world,        finger,
                   path,         sampleStartStates(world, finger, path, settings.fingers),
                   finger_ticks, settings.action_ticks};
  Pass rollout = batch;
  rollout.action_ticks = finger_ticks;
  Pass native = batch;
  native.fingers.resize(1);
  native.finger_ticks = native.action_ticks = settings.fingers * finger_ticks;
  BatchFigures figures;
  figures.triangles = world.body->skin.triangles.size();
  figures.pass_ticks = settings.fingers * finger_ticks;
  const Clock::time_point start = Clock::now();
  for (int round = 0; round < kMinBatchRounds || secondsSince(start) < settings.seconds; ++round) {
    report(progress, "stepping", std::min(1.0, secondsSince(start) / settings.seconds));
    figures.native_ticks_per_s = std::max(figures.native_ticks_per_s, runPass(native, 1).ticks_per_s);
    comparePasses(batch, settings.threads, figures.batch, figures);
    comparePasses(rollout, settings.threads, figures.rollout, figures);
  }
  return figures;
}

}  // namespace palpate::bench
