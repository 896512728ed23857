#include "palpate/base/aligned.h"

#include <gtest/gtest.h>

namespace palpate {
namespace {

TEST(ReserveTouched, EmptiesAndMakesRoom) {
  std::vector<int> items{1, 2, 3};
  reserveTouched(items, 100);
  EXPECT_TRUE(items.empty());
  EXPECT_GE(items.capacity(), 100u);
}

}  // namespace
}  // namespace palpate
