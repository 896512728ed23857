// Posts, ridges and planes under a flat skin: how narrow each is found to be.
#include "palpate/scene/beneath/tissue_beneath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "palpate/body/bones.h"
#include "palpate/tissue/narrow_bone.h"

namespace palpate::scene {
namespace {

/// A sheet over 80 x 80 mm whose height is a function of the place.
mesh::TriangleMesh sheet(double step_mm, const std::function<double(double, double)>& height) {
  mesh::TriangleMesh mesh;
  const int n = static_cast<int>(80.0 / step_mm);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = i * step_mm - 40.0;
      const double y = j * step_mm - 40.0;
      mesh.positions.emplace_back(x, y, height(x, y));
    }
  }
  const auto at = [n](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// The radius found under the skin's middle, `cover_mm` above the bone's top in z = 0.
double foundRadius(double cover_mm, const std::function<double(double, double)>& bone) {
  const std::vector<body::Bone> bones = {{.name = "bone", .mesh = sheet(0.5, bone)}};
  const mesh::TriangleMesh skin = sheet(4.0, [&](double, double) { return cover_mm; });
  const std::vector<double> nearest = body::depthToBones(skin.positions, bones).depth_mm;
  const std::vector<double> radii = boneRadii(skin, nearest, bones);
  for (std::size_t v = 0; v < radii.size(); ++v) {
    if (skin.positions[v].head<2>().norm() < 1e-9) return radii[v];
  }
  return 0.0;
}

/// Height of a ball's top half, of a post below it, whose top lies in z = 0.
double ballTop(double distance, double radius) {
  return distance < radius ? std::sqrt(radius * radius - distance * distance) - radius : -40.0;
}

TEST(BoneWidth, OfAPostIsItsRadius) {
  for (const double radius : {4.0, 8.0, 20.0}) {
    for (const double cover : {6.0, 12.0, 20.0}) {
      const double found = foundRadius(cover, [&](double x, double y) { return ballTop(std::hypot(x, y), radius); });
      EXPECT_NEAR(found, radius, 0.15 * radius) << "under " << cover << " mm";
    }
  }
}

TEST(BoneWidth, OfARidgeLiesBetweenATipAndAPlane) {
  const double found = foundRadius(10.0, [](double x, double) { return ballTop(std::abs(x), 5.0); });
  EXPECT_GT(found, 1.5 * 5.0);
  EXPECT_LT(found, 3.0 * 5.0);
}

TEST(BoneWidth, OfAPlaneAlsoOfATiltedOneIsFlat) {
  EXPECT_GT(foundRadius(10.0, [](double, double) { return 0.0; }), 500.0);
  EXPECT_GT(foundRadius(10.0, [](double x, double y) { return 0.2 * x - 0.1 * y; }), 500.0);
}

TEST(BoneWidth, IsNotAskedForUnderThickTissue) {
  EXPECT_EQ(foundRadius(35.0, [](double x, double y) { return ballTop(std::hypot(x, y), 4.0); }), tissue::kFlatBoneMm);
}

}  // namespace
}  // namespace palpate::scene
