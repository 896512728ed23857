// Outlines, bars and boxes have the corners they should have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/charts/mesh_view.h"
#include "report/charts/plot.h"

namespace palpate::figures {

TEST(Shapes, AnEllipseHasItsHalfAxesInItsDirection) {
  const Vec2 centre(3.0, -2.0);
  const double direction = 0.7;
  const Vec2 along(std::cos(direction), std::sin(direction));
  double longest = 0.0, shortest = 5.0;
  for (const Vec2& point : ellipseOutline(centre, 5.0, 2.0, direction)) {
    longest = std::max(longest, (point - centre).norm());
    shortest = std::min(shortest, (point - centre).norm());
    const double u = (point - centre).dot(along) / 5.0;
    const double v = (point - centre).dot(Vec2(-along.y(), along.x())) / 2.0;
    EXPECT_NEAR(u * u + v * v, 1.0, 1e-12);
  }
  EXPECT_NEAR(longest, 5.0, 0.01) << "all round";
  EXPECT_NEAR(shortest, 2.0, 0.01);
}

TEST(Shapes, BarsStandOnZeroAroundTheirPlaces) {
  const Shape shape = bars("count", {1.0, 2.0}, {4.0, -3.0}, 0.5, kBlue);
  ASSERT_EQ(shape.paths.size(), 2u);
  EXPECT_EQ(shape.paths[0][0], Vec2(0.75, 0.0));
  EXPECT_EQ(shape.paths[0][2], Vec2(1.25, 4.0));
  EXPECT_EQ(shape.paths[1][2], Vec2(2.25, -3.0));
}

TEST(Shapes, ABoxHasTwelveEdgesAlongItsAxes) {
  const Vec3 sizes(1.0, 2.0, 4.0);
  const auto edges = boxEdges({Vec3::Zero(), sizes});
  ASSERT_EQ(edges.size(), 12u);
  Vec3 lengths = Vec3::Zero();
  for (const auto& [from, to] : edges) {
    EXPECT_EQ(((to - from).array() != 0.0).count(), 1);
    lengths += (to - from).cwiseAbs();
  }
  EXPECT_EQ(lengths, Vec3(4.0 * sizes));
}

TEST(Shapes, AFieldIsSampledRowByRowFromItsOrigin) {
  Field field{.origin = Vec2(10.0, 100.0), .step = Vec2(1.0, 2.0), .columns = 3, .rows = 2};
  sampleField(field, [](double x, double y) { return x + y; });
  EXPECT_EQ(field.values, (std::vector<double>{110, 111, 112, 112, 113, 114}));
}

}  // namespace palpate::figures
