#include "lab/counters/allocation_count.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <thread>

#include "palpate/base/aligned.h"

namespace palpate::lab {
namespace {

/// Allocations that `work` makes on this thread.
template <class Work>
std::uint64_t allocationsOf(Work work) {
  const std::uint64_t before = lab::allocationsOfThisThread().value();
  work();
  return lab::allocationsOfThisThread().value() - before;
}

class AllocationCount : public testing::Test {
  void SetUp() override {
    if (!lab::allocationsOfThisThread()) GTEST_SKIP() << "allocations cannot be counted in this build";
  }
};

void* volatile kept;  // keeps the optimiser from removing a pair of new and delete

TEST_F(AllocationCount, SeesEveryWayToAllocate) {
  EXPECT_EQ(allocationsOf([] {
              auto* p = new int(1);
              kept = p;
              delete p;
            }),
            1u);
  EXPECT_EQ(allocationsOf([] {
              AlignedVector<float> v(100);
              kept = v.data();
            }),
            1u);
  EXPECT_EQ(allocationsOf([] {
              Eigen::VectorXd v(100);
              kept = v.data();
            }),
            1u);
}

TEST_F(AllocationCount, IsZeroWithoutAllocationsAndPerThread) {
  EXPECT_EQ(allocationsOf([] {
              const Eigen::Vector3d v(1, 2, 3);
              kept = const_cast<double*>(v.data());
            }),
            0u);
  std::uint64_t inside = 0;
  std::thread([&] { inside = allocationsOf([] { kept = std::make_unique<int>(1).get(); }); }).join();
  EXPECT_EQ(inside, 1u);
}

}  // namespace
}  // namespace palpate::lab
