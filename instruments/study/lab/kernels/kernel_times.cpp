// Goes round all kernels again and again, each between two runs of its reference loop, so that other load slows both;
// the shortest processor time of each counts.
#include "lab/kernels/kernel_times.h"

#include <algorithm>
#include <chrono>

#ifdef __linux__
#include <time.h>
#endif

#include "palpate/base/stopwatch.h"

namespace palpate::bench {

namespace {

constexpr int kMinRounds = 3;
/// A sample lasts at least this long, so that the caches hold its own data.
constexpr double kMinSampleNs = 2e5;

volatile double kept;  // keeps the optimiser from leaving out work with unused results

/// Time that this thread had a processor, ns: another program that takes turns with it does not count.
double processorNs() {
#ifdef __linux__
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0) {
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
  }
#endif
  return std::chrono::duration<double, std::nano>(Clock::now().time_since_epoch()).count();
}

/// Shortest time of one call so far, ns.
class Shortest {
 public:
  template <class Work>
  void sample(Work&& work) {
    if (repeats_ == 0) repeats_ = repeatsFor(work);
    const double start = processorNs();
    for (int i = 0; i < repeats_; ++i) kept = work();
    best_ns_ = std::min(best_ns_, (processorNs() - start) / repeats_);
  }
  double ns() const { return best_ns_; }

 private:
  template <class Work>
  static int repeatsFor(Work&& work) {
    const double start = processorNs();
    kept = work();
    return static_cast<int>(std::clamp(kMinSampleNs / (processorNs() - start + 1.0), 1.0, 1000.0));
  }
  int repeats_ = 0;
  double best_ns_ = 1e300;
};

/// A kernel and the loop that suits it.
struct Pair {
  Shortest kernel, loop;

  void sample(const Kernel& of, ReferenceLoops& loops) {
    const auto run_loop = [&] { return of.burden == Burden::memory ? loops.memory() : loops.arithmetic(); };
    loop.sample(run_loop);
    kernel.sample(of.run);
    loop.sample(run_loop);
  }
  KernelTime time(const Kernel& of) const {
    const double steps = of.burden == Burden::memory ? ReferenceLoops::kFloats : ReferenceLoops::kSteps;
    const double ns = kernel.ns() / of.items;
    return {of.name, of.item, ns, ns / (loop.ns() / steps)};
  }
};

const KernelTime* find(std::span<const KernelTime> times, const std::string& name) {
  const auto found =
      std::find_if(times.begin(), times.end(), [&](const KernelTime& time) { return time.name == name; });
  return found == times.end() ? nullptr : &*found;
}

}  // namespace

std::vector<KernelTime> timeKernels(std::span<const Kernel> kernels, double seconds) {
  ReferenceLoops loops;
  std::vector<Pair> pairs(kernels.size());
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (int round = 0; round < kMinRounds || Clock::now() < end; ++round) {
    for (std::size_t k = 0; k < kernels.size(); ++k) pairs[k].sample(kernels[k], loops);
  }
  std::vector<KernelTime> times;
  for (std::size_t k = 0; k < kernels.size(); ++k) times.push_back(pairs[k].time(kernels[k]));
  return times;
}

std::vector<Comparison> compared(std::span<const KernelTime> before, std::span<const KernelTime> now,
                                 double tolerance) {
  std::vector<Comparison> all;
  for (const KernelTime& time : now) {
    Comparison& one = all.emplace_back(Comparison{time.name, {}, time.ratio});
    if (const KernelTime* old = find(before, time.name)) one.before = old->ratio;
    one.slower = one.change() > 1.0 + tolerance;
  }
  for (const KernelTime& time : before) {
    if (find(now, time.name) == nullptr) all.push_back(Comparison{time.name, time.ratio, {}});
  }
  return all;
}

}  // namespace palpate::bench
