#include "palpate/maps/stiffness_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/base/error.h"

namespace palpate::maps {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(StiffnessMap, FallsFromBoneToSoftTissue) {
  double last = stiffnessAtDepth(0.0);
  EXPECT_DOUBLE_EQ(last, 1.2);
  for (double depth = 0.5; depth < 100.0; depth += 0.5) {
    const double k = stiffnessAtDepth(depth);
    EXPECT_LT(k, last);
    EXPECT_GT(k, 0.3);
    last = k;
  }
  EXPECT_EQ(stiffnessAtDepth(kInfinity), 0.3);
  EXPECT_EQ(stiffnessAtDepth(NAN), 0.3);
  EXPECT_DOUBLE_EQ(stiffnessAtDepth(-2.0), 1.2);
}

// Secant stiffness at 10 mm of the layered finite element model: 8.35 N over 15 mm of tissue, 4.16 N over 40 mm.
TEST(StiffnessMap, LiesNearTheLayeredModel) {
  EXPECT_NEAR(stiffnessAtDepth(15.0), 0.835, 0.10 * 0.835);
  EXPECT_NEAR(stiffnessAtDepth(40.0), 0.416, 0.12 * 0.416);
}

TEST(Dysfunction, ChangesTheCoreFullyAndTheOutsideNotAtAll) {
  const Dysfunction d{10.0, 20.0, 16.0, 50.0, 0.25};
  EXPECT_DOUBLE_EQ(stiffnessFactor(d, {10, 20}), 1.5);
  EXPECT_DOUBLE_EQ(stiffnessFactor(d, {22, 20}), 1.5);   // the edge begins at 12 mm
  EXPECT_DOUBLE_EQ(stiffnessFactor(d, {24, 20}), 1.25);  // half way through the edge
  EXPECT_EQ(stiffnessFactor(d, {26, 20}), 1.0);
}

TEST(Dysfunction, HardEdgeIsAStep) {
  const Dysfunction d{0.0, 0.0, 10.0, -30.0, 0.0};
  EXPECT_DOUBLE_EQ(stiffnessFactor(d, {9.999, 0}), 0.7);
  EXPECT_EQ(stiffnessFactor(d, {10.0, 0}), 1.0);
}

TEST(Dysfunction, NeverTurnsStiffnessNegativeNorNaN) {
  EXPECT_EQ(stiffnessFactor({0, 0, 10, -250, 0.5}, {0, 0}), 0.0);
  EXPECT_EQ(stiffnessFactor({0, 0, 0, 50, 0.5}, {0, 0}), 1.0);
  EXPECT_EQ(stiffnessFactor({NAN, 0, 10, 50, 0.5}, {0, 0}), 1.0);
  EXPECT_EQ(stiffnessFactor({0, 0, kInfinity, 50, 1.0}, {0, 0}), 1.0);
}

TEST(Dysfunction, SeveralMultiply) {
  const std::vector<Vec3> positions{{0, 0, 0}, {100, 0, 0}};
  std::vector<double> k{0.5, 0.5};
  applyDysfunctions(positions, std::vector<Dysfunction>{{0, 0, 10, 100, 0.5}, {0, 0, 20, -50, 0.5}}, k);
  EXPECT_DOUBLE_EQ(k[0], 0.5);
  EXPECT_EQ(k[1], 0.5);
  EXPECT_THROW(applyDysfunctions(positions, {}, std::span<double>(k).first(1)), Error);
}

}  // namespace palpate::maps
