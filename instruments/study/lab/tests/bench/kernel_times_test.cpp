#include "lab/kernels/kernel_times.h"

#include <gtest/gtest.h>

#include <set>

namespace palpate::bench {
namespace {

TEST(Kernels, DoTheSameWorkInEveryCall) {
  std::set<std::string> names;
  for (const Kernel& kernel : makeKernels(2962)) {
    EXPECT_TRUE(names.insert(kernel.name).second) << kernel.name << " twice";
    EXPECT_GT(kernel.items, 0.0) << kernel.name;
    const double first = kernel.run();
    EXPECT_NE(first, 0.0) << kernel.name << " does nothing";
    EXPECT_EQ(kernel.run(), first) << kernel.name;
  }
  EXPECT_EQ(names.size(), 13u);
}

TEST(ReferenceLoops, WalkThroughAllTheirTriangles) {
  ReferenceLoops loops, same;
  const double once = loops.arithmetic();
  EXPECT_NEAR(loops.arithmetic(), once, 1e-9 * once);  // a full cycle: the next one sums the same triangles
  EXPECT_EQ(same.arithmetic(), once);
  EXPECT_EQ(loops.memory(), 2.0);
}

TEST(KernelTimes, AreRatiosToAReferenceLoop) {
  int calls = 0;
  const std::vector<Kernel> kernels = {{"nothing", "call", 1.0, Burden::arithmetic, [&] { return double(++calls); }}};
  const std::vector<KernelTime> times = timeKernels(kernels, 0.0);
  ASSERT_EQ(times.size(), 1u);
  EXPECT_GE(calls, 3);
  EXPECT_GT(times[0].ns, 0.0);
  EXPECT_GT(times[0].ratio, 0.0);
}

TEST(Comparison, SaysWhichKernelGotSlowerAndByHowMuch) {
  const std::vector<KernelTime> before = {{"walk", "tick", 100.0, 10.0}, {"weld", "triangle", 50.0, 5.0}};
  const std::vector<KernelTime> now = {{"walk", "tick", 30.0, 15.0}, {"weld", "triangle", 500.0, 5.5}};
  const std::vector<Comparison> all = compared(before, now, 0.3);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].slower) << "half as much again, although the machine is faster";
  EXPECT_DOUBLE_EQ(all[0].change(), 1.5);
  EXPECT_FALSE(all[1].slower) << "the machine is ten times slower, the kernel is not";
}

TEST(Comparison, NamesWhatOnlyOneSideKnows) {
  const std::vector<Comparison> all = compared(std::vector<KernelTime>{{"old", "tick", 1.0, 1.0}},
                                               std::vector<KernelTime>{{"new", "tick", 1.0, 1.0}}, 0.0);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_FALSE(all[0].before.has_value());
  EXPECT_FALSE(all[1].now.has_value());
  EXPECT_FALSE(all[0].slower || all[1].slower);
}

}  // namespace
}  // namespace palpate::bench
