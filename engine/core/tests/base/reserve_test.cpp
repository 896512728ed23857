#include "palpate/base/aligned.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lab/counters/thread_counts.h"

namespace palpate {
namespace {

/// 64 MiB: above any threshold of malloc, so that each vector has pages of its own that nobody has touched yet.
constexpr std::size_t kInts = std::size_t{16} << 20;

/// Pages that the system has to find while the vector is filled.
std::optional<std::uint64_t> faultsOfFilling(std::vector<int>& items) {
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (std::size_t i = 0; i < kInts; ++i) items.push_back(static_cast<int>(i));
  return lab::countsSince(before).page_faults;
}

TEST(ReserveTouched, EmptiesAndMakesRoom) {
  std::vector<int> items{1, 2, 3};
  reserveTouched(items, 100);
  EXPECT_TRUE(items.empty());
  EXPECT_GE(items.capacity(), 100u);
}

TEST(ReserveTouched, LeavesNoPageToBeFoundWhenItIsFilled) {
  if (!lab::kCountsCalls) GTEST_SKIP() << "a sanitizer's own memory has pages too";
  std::vector<int> reserved;
  reserved.reserve(kInts);
  const auto faults = faultsOfFilling(reserved);
  ASSERT_TRUE(faults.has_value());
  EXPECT_GT(*faults, 0u) << "what a plain reserve() costs";
  std::uint64_t least = ~std::uint64_t{0};
  for (int run = 0; run < 3 && least > 0; ++run) {  // another program can take a page away at any moment
    std::vector<int> touched;
    reserveTouched(touched, kInts);
    least = std::min(least, faultsOfFilling(touched).value());
  }
  EXPECT_EQ(least, 0u);
}

}  // namespace
}  // namespace palpate
