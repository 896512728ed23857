#include "palpate/body/back.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/topology.h"

namespace palpate::body {
namespace {

SkinSettings bareSkin() {
  SkinSettings bare;
  bare.relief = noRelief();
  return bare;
}

/// One relief for all tests: its bones take a second.
const SkinSurface& defaultSkin() {
  static const SkinSurface skin = makeSkinSurface(SkinSettings{});
  return skin;
}

/// How often each undirected edge is used, and whether any direction is used twice.
struct EdgeUse {
  std::map<std::pair<Index, Index>, int> directed;
  int most = 0;
  std::vector<std::pair<Index, Index>> border;
};

EdgeUse edgeUse(const mesh::TriangleMesh& mesh) {
  EdgeUse use;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) use.most = std::max(use.most, ++use.directed[{t[i], t[(i + 1) % 3]}]);
  }
  for (const auto& [edge, count] : use.directed) {
    if (!use.directed.contains({edge.second, edge.first})) use.border.push_back(edge);
  }
  return use;
}

std::size_t componentsOf(const mesh::TriangleMesh& mesh) {
  std::vector<Index> parent(mesh.positions.size());
  for (Index i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Triangle& t : mesh.triangles) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[2])] = root(t[1]);
  }
  std::size_t roots = 0;
  for (Index i = 0; i < parent.size(); ++i) roots += parent[i] == i;
  return roots;
}

double smallestAngleDeg(const mesh::TriangleMesh& mesh) {
  double smallest = 180;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 u = mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[i]];
      const Vec3 v = mesh.positions[t[(i + 2) % 3]] - mesh.positions[t[i]];
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi);
    }
  }
  return smallest;
}

class BackOfAnySize : public testing::TestWithParam<std::size_t> {};

TEST_P(BackOfAnySize, HasTheExactCount) {
  EXPECT_EQ(meshSkin(SkinSurface(), SkinExtent::patch, GetParam()).mesh.triangles.size(), GetParam());
  EXPECT_EQ(meshSkin(SkinSurface(), SkinExtent::torso, GetParam()).mesh.triangles.size(), GetParam());
}

TEST_P(BackOfAnySize, IsOneManifoldSheetWithOneBorder) {
  for (const SkinExtent extent : {SkinExtent::patch, SkinExtent::torso}) {
    const Skin skin = meshSkin(SkinSurface(), extent, GetParam());
    const EdgeUse use = edgeUse(skin.mesh);
    EXPECT_EQ(use.most, 1) << "an edge is used twice in one direction";
    EXPECT_EQ(componentsOf(skin.mesh), 1u) << "also counts vertices that no triangle uses";
    // Euler: a sheet with one hole boundary and no handle has V - E + F = 1.
    const auto edges = (use.directed.size() + use.border.size()) / 2;
    EXPECT_EQ(skin.mesh.positions.size() + skin.mesh.triangles.size(), edges + 1);
    EXPECT_EQ(use.border.size(), skin.border);
    for (const auto& [from, to] : use.border) EXPECT_EQ(to, (from + 1) % skin.border);
  }
}

TEST_P(BackOfAnySize, FacesOutEverywhere) {
  const Skin skin = meshSkin(defaultSkin(), SkinExtent::torso, GetParam());
  for (const Triangle& t : skin.mesh.triangles) {
    const auto& at = skin.mesh.positions;
    const Vec3 area = mesh::areaVector2(at[t[0]], at[t[1]], at[t[2]]);
    for (const Index corner : t) ASSERT_GT(area.dot(skin.normals[corner]), 0);
  }
  for (std::size_t i = 0; i < skin.normals.size(); ++i) {
    const Vec3 radial = (skin.mesh.positions[i] - Vec3(0, skin.mesh.positions[i].y(), -60)).normalized();
    ASSERT_GT(skin.normals[i].dot(radial), 0);
  }
}

TEST_P(BackOfAnySize, HasNoSliver) {
  EXPECT_GT(smallestAngleDeg(meshSkin(defaultSkin(), SkinExtent::patch, GetParam()).mesh), 15);
  EXPECT_GT(smallestAngleDeg(meshSkin(defaultSkin(), SkinExtent::torso, GetParam()).mesh), 15);
}

TEST_P(BackOfAnySize, EndsAtTheOutline) {
  const Skin skin = meshSkin(SkinSurface(), SkinExtent::patch, GetParam());
  for (Index i = 0; i < skin.border; ++i) {
    const Vec3& point = skin.mesh.positions[i];
    const bool on_top_or_bottom = std::abs(std::abs(point.y()) - 200) < 1e-6;
    const bool on_flank = std::abs(point.z()) < 0.1;
    const bool on_arm = std::abs(std::abs(point.x()) - 175) < 0.15;
    const bool on_ridge = point.y() > 150 && std::abs(point.x()) > 70;
    EXPECT_TRUE(on_top_or_bottom || on_flank || on_arm || on_ridge) << point.transpose();
  }
}

TEST_P(BackOfAnySize, FillsItsBox) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(meshSkin(SkinSurface(), SkinExtent::patch, GetParam()).mesh);
  EXPECT_NEAR(box.sizes().x(), 350, 0.3);
  EXPECT_NEAR(box.sizes().y(), 400, 1e-6);
  EXPECT_NEAR(box.sizes().z(), 120, 1.5);  // a coarse mesh need not have a vertex at the highest point
}

INSTANTIATE_TEST_SUITE_P(Sizes, BackOfAnySize, testing::Values(500, 501, 647, 999, 2961, 15815, 20389, 100003));

TEST(Back, HasTheExactCountForEverySmallSize) {
  for (std::size_t triangles = 500; triangles < 900; triangles += 7) {
    const Skin skin = meshSkin(SkinSurface(), SkinExtent::patch, triangles);
    ASSERT_EQ(skin.mesh.triangles.size(), triangles);
    ASSERT_GT(smallestAngleDeg(skin.mesh), 10) << triangles;
  }
}

TEST(Back, RefusesWhatItCannotMake) {
  EXPECT_THROW(makeBack({.triangles = 499, .shape = bareSkin()}), Error);
  EXPECT_THROW(makeBack({.triangles = 0, .shape = bareSkin()}), Error);
  SkinSettings shape = bareSkin();
  shape.stature_mm = std::nan("");
  EXPECT_THROW(makeBack({.shape = shape}), Error);
  shape = bareSkin();
  shape.asymmetry = -1;
  EXPECT_THROW(makeBack({.shape = shape}), Error);
}

TEST(Back, WithoutLayersIsTheFittedSkin) {
  const SkinSurface fitted;
  const SkinSurface made = makeSkinSurface(bareSkin());
  for (double y = -290; y <= 200; y += 29) {
    for (double angle = -0.7; angle <= 0.7; angle += 0.2) {
      EXPECT_EQ(made.at({angle, y}).position, fitted.at({angle, y}).position);
    }
  }
}

TEST(Back, IsSymmetricWithoutAsymmetry) {
  for (double y = -290; y <= 200; y += 7) {
    for (double angle = 0.02; angle < borderAngle(y); angle += 0.06) {
      Vec3 mirrored = defaultSkin().at({-angle, y}).position;
      mirrored.x() = -mirrored.x();
      EXPECT_NEAR((defaultSkin().at({angle, y}).position - mirrored).norm(), 0, 0.02);
    }
  }
}

TEST(Back, AsymmetryMovesTheMidlineAndLowersTheRightShoulder) {
  SkinSettings uneven = bareSkin();
  uneven.asymmetry = 1;
  const SkinSurface skin = makeSkinSurface(uneven);
  EXPECT_NEAR(skin.at({0, 105}).position.x(), 2.5, 0.05);
  EXPECT_LT(skin.at({0.75, 110}).position.y(), 106);
  EXPECT_NEAR(skin.at({-0.75, 110}).position.y(), 110, 0.01);
}

/// Radial height of the relief on the midline.
double midlineRelief(const SkinSurface& skin, double y) {
  return skin.at({0, y}).position.z() - SkinSurface().at({0, y}).position.z();
}

TEST(Back, EachSpinousProcessIsACrestBetweenValleys) {
  for (const Landmark& landmark : boneLandmarks()) {
    if (!landmark.name.starts_with("spinous_T")) continue;
    double crest = 0;
    for (double y = landmark.position.y() - 6; y <= landmark.position.y() + 6; y += 0.5) {
      crest = std::max(crest, midlineRelief(defaultSkin(), y));
    }
    double valley = crest;
    for (double y = landmark.position.y() - 18; y < landmark.position.y(); y += 0.5) {
      valley = std::min(valley, midlineRelief(defaultSkin(), y));
    }
    EXPECT_GT(crest - valley, 0.25) << landmark.name;
    EXPECT_LT(crest, 1.5) << landmark.name;
  }
}

TEST(Back, ReliefGrowsWithItsFactor) {
  SkinSettings shape;
  shape.relief.ribs = shape.relief.scapulae = 0;
  const SkinSurface lean = makeSkinSurface(shape);
  shape.relief.spine = 2;
  const SkinSurface emaciated = makeSkinSurface(shape);
  EXPECT_NEAR(midlineRelief(emaciated, -62), 2 * midlineRelief(lean, -62), 1e-9);
  EXPECT_GT(midlineRelief(lean, -62), 0.4);
}

TEST(Back, ReliefKeepsTheOutline) {
  const auto box = mesh::boundingBox(meshSkin(defaultSkin(), SkinExtent::patch, 2961).mesh);
  EXPECT_NEAR(box.sizes().x(), 350, 0.5);
  EXPECT_NEAR(box.min().z(), 0, 0.1);
}

TEST(Back, ADenseMeshIsSmooth) {
  // The turn between neighbouring triangles shrinks with their size where the surface has no crease.
  const Skin skin = meshSkin(defaultSkin(), SkinExtent::patch, 100003);
  const auto neighbours = mesh::neighboursOfTriangles(skin.mesh);
  double sharpest = 0;
  const auto normal = [&](Index t) {
    const Triangle& c = skin.mesh.triangles[t];
    return mesh::areaVector2(skin.mesh.positions[c[0]], skin.mesh.positions[c[1]], skin.mesh.positions[c[2]])
        .normalized();
  };
  for (Index t = 0; t < neighbours.size(); ++t) {
    for (const Index other : neighbours[t]) {
      if (other != kNoIndex) sharpest = std::max(sharpest, std::acos(std::min(1.0, normal(t).dot(normal(other)))));
    }
  }
  EXPECT_LT(sharpest * 180 / std::numbers::pi, 9);
}

}  // namespace
}  // namespace palpate::body
