#include "palpate/servo/pacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/servo/histogram.h"

namespace palpate::servo {
namespace {

TEST(DurationHistogram, AgreesWithSortingToOneBin) {
  Random random(5);
  DurationHistogram histogram;
  std::vector<std::int64_t> sorted;
  for (int i = 0; i < 20000; ++i) {
    const auto ns = static_cast<std::int64_t>(std::exp(random.uniform(0.0, 18.0)));
    histogram.add(ns);
    sorted.push_back(ns);
  }
  std::sort(sorted.begin(), sorted.end());
  const auto nearest_rank_us = [&](double share) {
    return 1e-3 * static_cast<double>(sorted[static_cast<std::size_t>(std::ceil(share * 20000.0)) - 1]);
  };
  const DurationPercentiles p = histogram.percentiles();
  EXPECT_GE(p.p50_us, nearest_rank_us(0.5));
  EXPECT_LE(p.p50_us, nearest_rank_us(0.5) * 1.016);
  EXPECT_GE(p.p99_9_us, nearest_rank_us(0.999));
  EXPECT_LE(p.p99_9_us, nearest_rank_us(0.999) * 1.016);
  EXPECT_EQ(p.max_us, 1e-3 * static_cast<double>(sorted.back()));
}

TEST(DurationHistogram, KeepsSmallDurationsExactlyAndSurvivesHugeOnes) {
  DurationHistogram histogram;
  for (std::int64_t ns = 1; ns <= 99; ++ns) histogram.add(ns);
  EXPECT_DOUBLE_EQ(histogram.percentiles().p50_us, 0.050);
  histogram.add(std::int64_t{3600} * 1'000'000'000);
  EXPECT_DOUBLE_EQ(histogram.percentiles().max_us, 3.6e9);
  EXPECT_EQ(DurationHistogram{}.percentiles().max_us, 0.0);
}

TEST(Pacer, NeverWakesBeforeItsDeadlineAndSkipsMissedOnes) {
  PacingSettings settings;
  settings.period_s = 0.002;
  const std::int64_t before = monotonicNs();
  Pacer pacer(settings);
  std::uint64_t served = 0;
  Pacer::Wake wake;
  std::uint64_t missed = 0;
  std::uint64_t last = 0;
  while (served < 50) {
    wake = pacer.waitForNext();
    EXPECT_GE(wake.late_ns, 0);
    EXPECT_GE(monotonicNs() - before, static_cast<std::int64_t>(wake.tick + 1) * 2'000'000);
    EXPECT_TRUE(served == 0 || wake.tick > last);
    last = wake.tick;
    missed += wake.missed;
    ++served;
    // Sleeping through ten deadlines: they are counted, not made up.
    if (served == 25) {
      for (const std::int64_t end = monotonicNs() + 20'000'000; monotonicNs() < end;) {
      }
    }
  }
  EXPECT_EQ(wake.tick + 1, served + missed);
  EXPECT_GE(missed, 9u);
}

TEST(PrepareServoThread, SaysWhyWhateverWasRefused) {
  PacingSettings settings;
  settings.realtime = false;
  EXPECT_FALSE(prepareServoThread(settings).realtime);
  settings.realtime = true;
  settings.realtime_priority = 100000;  // no such priority
  const PacingGrant grant = prepareServoThread(settings);
  EXPECT_FALSE(grant.realtime);
  EXPECT_NE(grant.note.find("SCHED_FIFO refused"), std::string::npos);
  releaseServoMemory(grant);
}

}  // namespace
}  // namespace palpate::servo
