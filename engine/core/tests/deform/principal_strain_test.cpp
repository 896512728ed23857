#include "palpate/deform/strain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/deform/stage.h"
#include "palpate/deform/strain.h"

namespace palpate::deform {

/// A flat or bent sheet, and every vertex moved by a function of its place.
class MovedSheet {
 public:
  template <class Place>
  MovedSheet(mesh::TriangleMesh mesh, const Place& place) : mesh_(std::move(mesh)), skin_(buildSkin(mesh_)) {
    for (std::vector<float>& axis : moved_) axis.resize(skin_.vertices);
    for (Index v = 0; v < skin_.vertices; ++v) {
      const Vec3 rest = skin_.restPosition(v).cast<double>();
      const Vec3f moved = (place(rest) - rest).template cast<float>();
      for (std::size_t axis = 0; axis < 3; ++axis) moved_[axis][v] = moved[static_cast<int>(axis)];
    }
  }
  PrincipalStrains at(Index v) const { return principalStrains(skin_, streams(), v); }
  float edges(Index v) const { return strainOfVertex(skin_, streams(), v); }
  Index vertices() const { return skin_.vertices; }

 private:
  PositionStreams streams() const { return {moved_[0].data(), moved_[1].data(), moved_[2].data()}; }
  mesh::TriangleMesh mesh_;
  Skin skin_;
  std::array<std::vector<float>, 3> moved_;
};

mesh::TriangleMesh sheet() { return zoo::grid(8, 80.0); }

template <class Place>
void expectStrains(const Place& place, double largest, double smallest) {
  const MovedSheet moved(sheet(), place);
  for (Index v = 0; v < moved.vertices(); ++v) {
    EXPECT_NEAR(moved.at(v).largest, largest, 1e-5) << v;
    EXPECT_NEAR(moved.at(v).smallest, smallest, 1e-5) << v;
  }
}

TEST(PrincipalStrain, UniaxialStretch) {
  expectStrains([](const Vec3& p) { return Vec3(1.1 * p.x(), p.y(), p.z()); }, 0.1, 0.0);
}

TEST(PrincipalStrain, EqualStretchBothWays) {
  expectStrains([](const Vec3& p) { return Vec3(0.95 * p); }, -0.05, -0.05);
}

// +10 % and -10 %: the mean of the edges shows next to nothing, the principal strain all of it (E24).
TEST(PrincipalStrain, PureShear) {
  const auto place = [](const Vec3& p) { return Vec3(1.1 * p.x(), 0.9 * p.y(), p.z()); };
  expectStrains(place, 0.1, -0.1);
  const MovedSheet moved(sheet(), place);
  EXPECT_LT(std::abs(moved.edges(40)), 0.01f);
  EXPECT_NEAR(moved.at(40).dominant(), 0.1, 1e-5) << "a tie is tension";
}

TEST(PrincipalStrain, ShearAlongDiagonals) {
  const auto place = [](const Vec3& p) { return Vec3(p.x() + 0.1 * p.y(), p.y() + 0.1 * p.x(), p.z()); };
  expectStrains(place, 0.1, -0.1);
}

// Simple shear by g: singular values of [[1, g], [0, 1]].
TEST(PrincipalStrain, SimpleShear) {
  constexpr double kG = 0.3;
  const double stretch = kG / 2 + std::sqrt(1.0 + kG * kG / 4);
  expectStrains([](const Vec3& p) { return Vec3(p.x() + kG * p.y(), p.y(), p.z()); }, stretch - 1.0,
                1.0 / stretch - 1.0);
}

TEST(PrincipalStrain, RigidMotionHasNone) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto place = [&](const Vec3& p) { return Vec3(turn * p + Vec3(5, -3, 2)); };
  for (const auto& mesh : {sheet(), test::torso(3)}) {
    const MovedSheet moved(mesh, place);
    for (Index v = 0; v < moved.vertices(); ++v) EXPECT_NEAR(moved.at(v).dominant(), 0.0, 2e-6);
  }
}

TEST(PrincipalStrain, CompressionKeepsItsSign) {
  const MovedSheet moved(sheet(), [](const Vec3& p) { return Vec3(1.02 * p.x(), 0.9 * p.y(), p.z()); });
  EXPECT_NEAR(moved.at(40).dominant(), -0.1, 1e-5);
}

TEST(PrincipalStrain, GrowingBallStretchesEverywhereAlike) {
  const MovedSheet moved(test::torso(4), [](const Vec3& p) { return Vec3(1.05 * p); });
  for (Index v = 0; v < moved.vertices(); ++v) {
    EXPECT_NEAR(moved.at(v).largest, 0.05, 1e-4);
    EXPECT_NEAR(moved.at(v).smallest, 0.05, 1e-4);
  }
}

// Bent onto a cylinder along x without stretching: facets are chords, a fan only feels those.
TEST(PrincipalStrain, BendingAloneHasNone) {
  const auto place = [](const Vec3& p) {
    return Vec3(p.x(), 200.0 * std::sin(p.y() / 200.0), 200.0 * std::cos(p.y() / 200.0));
  };
  const MovedSheet moved(zoo::grid(40, 80.0), place);
  for (Index v = 0; v < moved.vertices(); ++v) EXPECT_NEAR(moved.at(v).dominant(), 0.0, 1e-4);
}

TEST(PrincipalStrain, VerticesWithoutAFanHaveNone) {
  mesh::TriangleMesh mesh = zoo::oneTriangle();
  mesh.positions.emplace_back(9, 9, 9);
  const MovedSheet moved(mesh, [](const Vec3& p) { return Vec3(1.1 * p); });
  EXPECT_NEAR(moved.at(0).dominant(), 0.1, 1e-5) << "one triangle is a fan";
  EXPECT_EQ(moved.at(3).dominant(), 0.0);
  const MovedSheet needle({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}, [](const Vec3& p) { return Vec3(2 * p); });
  EXPECT_EQ(needle.at(0).dominant(), 0.0);
}

TEST(PrincipalStrain, IsWrittenByTheDeformer) {
  FormSettings forms;
  forms.common.strain = true;
  forms.strain_kind = StrainKind::principal;
  const auto mesh = lab::backMesh(8163);
  test::FormStage stage(mesh, forms);
  Random random(19);
  for (int i = 0; i < 10; ++i) {
    stage.apply({test::anyContact(mesh, random)});
    const PositionStreams moved{stage.surface.displacement(0).data(), stage.surface.displacement(1).data(),
                                stage.surface.displacement(2).data()};
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      ASSERT_EQ(stage.surface.strain()[v], static_cast<float>(principalStrains(stage.skin, moved, v).dominant()));
    }
  }
}

}  // namespace palpate::deform
