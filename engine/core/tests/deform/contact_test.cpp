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

// Where nothing is negative and at most one component counts, both readings agree with the reference.
TEST(LiteralCaps, AgreeWithTheReferenceOnAnAxis) {
  const auto data = test::golden("caps");
  for (const auto& c : data["normal"]) {
    if (c["m"].get<double>() < 0.0) continue;
    EXPECT_EQ(literallyCappedDepth(c["m"], data["dn_max"]), c["d"]) << c;
  }
  for (const auto& c : data["tangential"]) {
    const Vec3 v = test::vec3(c["v"]);
    if (v.cwiseAbs().maxCoeff() != v.cwiseAbs().sum()) continue;
    EXPECT_EQ(literallyCappedDrag(v, data["dt_max"]), test::vec3(c["d"])) << c;
  }
}

TEST(LiteralCaps, TurnALongDragTowardsTheDiagonal) {
  EXPECT_EQ(literallyCappedDrag({30, 40, 0}, 20.0), Vec3(20, 20, 0));
  EXPECT_LE(literallyCappedDrag({99, -99, 99}, 20.0).norm(), literalDragReach(20.0) + 1e-12);
}

TEST(LiteralCaps, LetANegativeDepthThrough) { EXPECT_EQ(literallyCappedDepth(-3.0, 10.0), -3.0); }

TEST(NormalRegion, GrowsWithDepthUpToTheCap) {
  const TissueSettings tissue;
  EXPECT_NEAR(normalRegion(Vec3::UnitZ(), 0.0, tissue).half_major.norm(), 13.2, 1e-12);
  EXPECT_NEAR(normalRegion(Vec3(1, 2, 3), 5.0, tissue).half_major.norm(), 13.2 + 5 * 1.22, 1e-12);
  EXPECT_NEAR(normalRegion(Vec3::UnitX(), 25.0, tissue).half_major.norm(), 13.2 + 10 * 1.22, 1e-12);
}

}  // namespace palpate::deform
