#include "palpate/deform/literal_caps.h"

#include <gtest/gtest.h>

#include "support/golden.h"

namespace palpate::deform {

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

}  // namespace palpate::deform
