// 100,000 warm ticks ask nothing of the system: no memory, no lock, no page.
#include <algorithm>

#include "lab/runs/contact_run.h"
#include "lab/tests/contact_bars/bars.h"

namespace palpate::bars {
namespace {

constexpr std::size_t kTicks = 100000;

/// The slide over the back again and again.
device::Trajectory longSlide() {
  const device::Trajectory once = lab::workloadPath("back_slide");
  device::Trajectory all;
  double start_s = 0.0;
  while (all.tip_mm.size() <= kTicks) {
    for (std::size_t i = 0; i < once.tip_mm.size(); ++i) {
      all.time_s.push_back(start_s + once.time_s[i] - once.time_s.front());
      all.tip_mm.push_back(once.tip_mm[i]);
    }
    start_s = all.time_s.back() + 1e-3;
  }
  return all;
}

/// Another program on the machine can take a page away at any moment: the best of some runs counts.
template <class Measure>
void expectNothingAsked(Measure measure) {
  constexpr int kRuns = 3;
  std::uint64_t least_page_faults = ~std::uint64_t{0};
  for (int run = 0; run < kRuns && least_page_faults > 0; ++run) {
    const bench::ContactFigures figures = measure();
    EXPECT_GE(figures.ticks, kTicks);
    EXPECT_GT(figures.contact_ticks, kTicks / 2);
    support::expectNone(figures.counts.allocations);
    support::expectNone(figures.counts.locks);
    ASSERT_TRUE(figures.counts.page_faults.has_value());
    least_page_faults = std::min(least_page_faults, *figures.counts.page_faults);
  }
  EXPECT_EQ(least_page_faults, 0u);
}

class WarmTicks : public testing::Test {
 protected:
  void SetUp() override {
    if (!lab::kCountsCalls) GTEST_SKIP() << "allocations and locks cannot be counted in this build";
  }

  bench::ContactWorld world = makeBarWorld("back_8163");
  device::Trajectory slide = longSlide();
};

TEST_F(WarmTicks, OfAPointAskNothingOfTheSystem) {
  expectNothingAsked([&] { return bench::measureContact(world, slide, makeBarFinger(0.0)); });
}

TEST_F(WarmTicks, OfAFingertipAskNothingOfTheSystem) {
  expectNothingAsked([&] { return bench::measureContact(world, slide, makeBarFinger(8.0)); });
}

TEST_F(WarmTicks, OfTheDetectingBoxAskNothingOfTheSystem) {
  for (const auto query : {hdb::HdbQuery::leaves, hdb::HdbQuery::coherent, hdb::HdbQuery::linked}) {
    bench::HdbRunSettings settings;
    settings.hdb.query = query;
    expectNothingAsked([&] { return bench::measureHdb(world, slide, makeBarFinger(0.0), settings).contact; });
  }
}

}  // namespace
}  // namespace palpate::bars
