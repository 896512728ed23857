#include "palpate/deform/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/golden.h"

namespace palpate::deform {

using test::vec3;

TEST(Caps, DepthIsLinearUpToTheCap) {
  const auto data = test::golden("caps");
  for (const auto& c : data["normal"]) EXPECT_DOUBLE_EQ(cappedDepth(c["m"], data["dn_max"]), c["d"]) << c;
  EXPECT_EQ(cappedDepth(NAN, 10.0), 0.0);
}

TEST(Caps, DragKeepsItsDirection) {
  const auto data = test::golden("caps");
  for (const auto& c : data["tangential"]) {
    EXPECT_LT((cappedLength(vec3(c["v"]), data["dt_max"]) - vec3(c["d"])).norm(), 1e-12) << c;
  }
}

TEST(NormalRegion, GrowsWithDepthUpToTheCap) {
  const TissueSettings tissue;
  EXPECT_NEAR(normalRegion(Vec3::UnitZ(), 0.0, tissue).half_major.norm(), 13.2, 1e-12);
  EXPECT_NEAR(normalRegion(Vec3(1, 2, 3), 5.0, tissue).half_major.norm(), 13.2 + 5 * 1.22, 1e-12);
  EXPECT_NEAR(normalRegion(Vec3::UnitX(), 25.0, tissue).half_major.norm(), 13.2 + 10 * 1.22, 1e-12);
}

}  // namespace palpate::deform
