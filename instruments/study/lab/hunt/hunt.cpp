// Jobs are numbered; a free thread takes the next, and results are added up in the order of the numbers. A body is
// built for each of its portions: it is a tenth of a second against a second of ticks.
// Data flow: HuntPlan -> here -> instruments/study/lab/commands, tests.
#include "lab/hunt/hunt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "lab/workloads/hunted_bodies.h"
#include "lab/workloads/hunted_paths.h"
#include "palpate/base/background.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/contact/lump_force.h"

namespace palpate::lab {
namespace {

/// Ticks per generated body: three or four paths for each radius.
constexpr std::size_t kTicksABody = 20000;
/// A body's ticks are shared among threads in portions of at most this many.
constexpr std::size_t kTicksAPortion = 250000;
constexpr std::size_t kMinPathTicks = 500, kMaxPathTicks = 3000;

/// A seed that fits any reader of JSON.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  Random random(a * 0x9e3779b97f4a7c15ull + b * 0xbf58476d1ce4e5b9ull + c * 0x94d049bb133111ebull);
  random.bits();
  return random.bits() >> 32;
}

struct Job {
  std::size_t body = 0;
  std::size_t portion = 0;
  std::size_t ticks = 0;
};

struct JobResult {
  HuntResult sum;
  std::string error;
};

std::string bodyName(const HuntPlan& plan, std::size_t body) {
  if (body < plan.meshes.size()) return plan.meshes[body].name;
  const std::vector<std::string> kinds = plan.kinds.empty() ? huntedBodyKinds() : plan.kinds;
  const std::size_t k = body - plan.meshes.size();
  // Neighbours differ, and so do the first kinds of different seeds: 17 is prime to the number of kinds.
  return fmt::format("{}#{}", kinds[(17 * k + plan.seed % kinds.size()) % kinds.size()], mixed(plan.seed, k, 1));
}

void addPath(const FailingPath& path, const HuntReport& report, bool closed, HuntResult& sum) {
  ++sum.paths;
  sum.ticks += report.ticks;
  if (!closed) {
    sum.open_ticks += report.ticks;
    sum.held_in_air_open_ticks += report.of(Fault::held_in_air).ticks;
  }
  sum.touching_ticks += report.touching_ticks;
  sum.held_through_ticks += report.held_through_ticks;
  sum.events += report.events;
  for (std::size_t f = 0; f < kFaults; ++f) {
    const Finding& finding = report.findings[f];
    sum.fault_ticks[f] += finding.ticks;
    if (finding.ticks == 0) continue;
    sum.failing.push_back(path);
    sum.failing.back().fault = static_cast<Fault>(f);
    sum.failing.back().finding = finding;
  }
}

void addAll(const HuntResult& more, HuntResult& sum) {
  sum.ticks += more.ticks;
  sum.open_ticks += more.open_ticks;
  sum.held_in_air_open_ticks += more.held_in_air_open_ticks;
  sum.touching_ticks += more.touching_ticks;
  sum.held_through_ticks += more.held_through_ticks;
  sum.events += more.events;
  sum.paths += more.paths;
  for (std::size_t f = 0; f < kFaults; ++f) sum.fault_ticks[f] += more.fault_ticks[f];
  sum.failing.insert(sum.failing.end(), more.failing.begin(), more.failing.end());
}

/// Work that several threads share.
class Hunt {
 public:
  explicit Hunt(const HuntPlan& plan) : plan_(plan) {
    if (!plan.seconds) {
      makeJobs();
      results_.resize(jobs_.size());
    }
  }

  /// Takes jobs until there are none or the time is over. `progress` only from the calling thread.
  void work(const Progress& progress) {
    for (std::size_t number = next_++; !isOver(number); number = next_++) {
      const Job job = jobAt(number);
      JobResult result;
      try {
        run(job, result.sum, progress);
      } catch (const std::exception& error) {
        result.error = fmt::format("{}: {}", bodyName(plan_, job.body), error.what());
        next_ = std::size_t{1} << 60;  // stops all threads
      }
      storeResult(number, job, std::move(result));
    }
  }

  HuntResult finish() {
    HuntResult sum;
    for (const JobResult& result : results_) {
      if (!result.error.empty()) throw Error(result.error);
      addAll(result.sum, sum);
    }
    std::sort(touched_.begin(), touched_.end());
    sum.bodies = static_cast<std::size_t>(std::unique(touched_.begin(), touched_.end()) - touched_.begin());
    sum.seconds = secondsSince(begun_);
    return sum;
  }

 private:
  std::size_t bodies() const {
    const std::size_t wanted = plan_.bodies > 0 ? plan_.bodies : std::max<std::size_t>(1, plan_.ticks / kTicksABody);
    return plan_.meshes.size() + (plan_.generated ? wanted : 0);
  }
  void makeJobs() {
    const std::size_t n = bodies();
    for (std::size_t body = 0; body < n; ++body) {
      std::size_t left = plan_.ticks / n + (body < plan_.ticks % n ? 1 : 0);
      for (std::size_t portion = 0; left > 0; ++portion) {
        const std::size_t ticks = std::min(left, kTicksAPortion);
        jobs_.push_back({body, portion, ticks});
        left -= ticks;
      }
    }
  }
  bool isStopped() const { return plan_.stop && plan_.stop(); }
  bool isOver(std::size_t number) const {
    if (isStopped()) return true;
    return plan_.seconds ? number >= (std::size_t{1} << 60) || secondsSince(begun_) >= *plan_.seconds
                         : number >= jobs_.size();
  }
  /// Without an end to the ticks, bodies come one after the other, and again with other paths.
  Job jobAt(std::size_t number) const {
    if (!plan_.seconds) return jobs_[number];
    const bool endless = plan_.generated && plan_.bodies == 0;
    const std::size_t n = endless ? number + 1 : bodies();
    const bool outside = number % n < plan_.meshes.size();
    return {number % n, number / n, outside ? kTicksAPortion : kTicksABody};
  }
  void run(const Job& job, HuntResult& sum, const Progress& progress) {
    const std::string name = bodyName(plan_, job.body);
    HuntWorld world = buildHuntWorld(huntedMesh(plan_, name));
    if (plan_.lumps > 0) putLumps(world, name, plan_.lumps);
    const auto in_time = [&] { return !plan_.seconds || secondsSince(begun_) < *plan_.seconds; };
    for (std::size_t path = 0; sum.ticks < job.ticks && in_time() && !isStopped(); ++path) {
      FailingPath now;
      now.body = name;
      now.seed = mixed(plan_.seed, mixed(job.body, job.portion, 2), path);
      now.radius_mm = plan_.radii_mm[path % plan_.radii_mm.size()];
      std::vector<Vec3> tips = huntedTips(world.body, now.seed, now.radius_mm, plan_.scale);
      tips.resize(std::min(tips.size(), job.ticks - sum.ticks));
      now.ticks = tips.size();
      const HuntReport report_of_path = huntAlong(world, huntedFinger(now.radius_mm, plan_.scale), tips);
      addPath(now, report_of_path, world.body.closed(), sum);
      done_ += tips.size();
      report(progress);
    }
  }
  void report(const Progress& progress) const {
    const double share = plan_.seconds ? secondsSince(begun_) / *plan_.seconds
                                       : static_cast<double>(done_) / static_cast<double>(plan_.ticks);
    palpate::report(progress, "hunting", std::min(share, 1.0));
  }
  void storeResult(std::size_t number, const Job& job, JobResult result) {
    const std::lock_guard lock(mutex_);
    if (results_.size() <= number) results_.resize(number + 1);
    results_[number] = std::move(result);
    touched_.push_back(job.body);
  }

  const HuntPlan& plan_;
  std::vector<Job> jobs_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::mutex mutex_;  ///< guards what follows
  std::vector<JobResult> results_;
  std::vector<std::size_t> touched_;
  Clock::time_point begun_ = Clock::now();
};

void check(const HuntPlan& plan) {
  if (plan.meshes.empty() && !plan.generated) throw Error("hunt: no body; name one with --mesh, or use --generated");
  if (plan.radii_mm.empty()) throw Error("hunt: no finger radius; give at least one");
  const std::vector<std::string> kinds = huntedBodyKinds();
  for (const std::string& kind : plan.kinds) {
    if (std::ranges::find(kinds, kind) == kinds.end())
      throw Error(fmt::format("unknown kind of body '{}'; expected one of {}", kind, fmt::join(kinds, ", ")));
  }
  if (plan.ticks == 0 && !plan.seconds) throw Error("hunt: no ticks; give at least one, or a time");
  if (!(plan.scale > 0.0) || !std::isfinite(plan.scale)) throw Error("hunt: the scale must be above 0");
  if (plan.lumps > contact::kMaxLumps) throw Error("hunt: too many lumps for one body");
  if (plan.lumps > 0 && plan.scale != 1.0) throw Error("hunt: lumps have a size in mm, so they need a scale of 1");
}

}  // namespace

HuntResult hunt(const HuntPlan& plan, const Progress& progress) {
  check(plan);
  Hunt hunt(plan);
  std::vector<Background> helpers;
  const std::size_t threads = plan.threads > 0 ? plan.threads : processors();
  for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back([&hunt] { hunt.work({}); });
  hunt.work(progress);
  for (Background& helper : helpers) helper.join();
  return hunt.finish();
}

mesh::TriangleMesh huntedMesh(const HuntPlan& plan, const std::string& name) {
  const auto outside =
      std::find_if(plan.meshes.begin(), plan.meshes.end(), [&](const NamedBody& body) { return body.name == name; });
  mesh::TriangleMesh mesh;
  if (outside != plan.meshes.end()) {
    mesh = outside->mesh;
  } else {
    const std::size_t at = name.find('#');
    const std::optional<double> seed = at == std::string::npos ? std::nullopt : parseNumber(name.substr(at + 1));
    if (!seed || !(*seed >= 0.0 && *seed < 1e19)) throw Error(fmt::format("unknown hunted body '{}'", name));
    mesh = huntedBody(name.substr(0, at), static_cast<std::uint64_t>(*seed));
  }
  for (Vec3& p : mesh.positions) p *= plan.scale;
  return mesh;
}

std::vector<Vec3> huntedTips(OracleBody& body, std::uint64_t seed, double radius_mm, double mm) {
  Random random(seed);
  const std::vector<std::string> kinds = huntedPathKinds();
  const std::string& kind = kinds[random.below(kinds.size())];
  const std::size_t ticks = kMinPathTicks + random.below(kMaxPathTicks - kMinPathTicks + 1);
  return huntedPath(body, kind, {.ticks = ticks, .mm = mm, .radius_mm = radius_mm, .seed = random.bits()});
}

}  // namespace palpate::lab
