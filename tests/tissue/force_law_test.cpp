#include "palpate/tissue/force_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::tissue {

TEST(ForceLaw, LinearIsHooke) { EXPECT_DOUBLE_EQ(normalForce({}, 0.5, 8.0), 4.0); }

TEST(ForceLaw, NothingPushesAboveTheSkin) {
  EXPECT_EQ(normalForce({}, 0.5, 0.0), 0.0);
  EXPECT_EQ(normalForce({}, 0.5, -1.0), 0.0);
  EXPECT_EQ(normalForce({}, -0.5, 1.0), 0.0);
}

TEST(ForceLaw, NaNGivesNoForce) {
  EXPECT_EQ(normalForce({}, 0.5, std::nan("")), 0.0);
  EXPECT_EQ(normalForce({}, std::nan(""), 1.0), 0.0);
}

}  // namespace palpate::tissue
