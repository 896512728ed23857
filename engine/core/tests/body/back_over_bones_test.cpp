// The dissertation's back with its skeleton, as `kind = "back"` makes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "palpate/base/error.h"
#include "palpate/body/torso.h"
#include "palpate/mesh/nearest.h"

namespace palpate::body {
namespace {

struct SizeOfTheText {
  std::size_t triangles;
  std::size_t vertices;
};

/// Section 2.1 and Table 3.1. The text's 2,962 triangles have 1,588 vertices: its outline has more edges.
constexpr std::array<SizeOfTheText, 3> kSizes{{{2962, 1544}, {20389, 10398}, {41582, 21103}}};

const Torso& cachedBack(std::size_t triangles) {
  static const std::array<Torso, kSizes.size()> backs = {
      makeBackOverBones({.triangles = kSizes[0].triangles, .shape = {}}),
      makeBackOverBones({.triangles = kSizes[1].triangles, .shape = {}}),
      makeBackOverBones({.triangles = kSizes[2].triangles, .shape = {}})};
  return backs[static_cast<std::size_t>(std::ranges::find(kSizes, triangles, &SizeOfTheText::triangles) -
                                        kSizes.begin())];
}

std::size_t bonesOfKind(const Torso& back, BoneKind kind) {
  return static_cast<std::size_t>(std::ranges::count(back.bones, kind, &Bone::kind));
}

TEST(BackOverBones, HasTheTrianglesAndVerticesOfEachSize) {
  EXPECT_EQ(kDissertationBackTriangles, kSizes[0].triangles);
  for (const SizeOfTheText& size : kSizes) {
    const mesh::TriangleMesh& skin = cachedBack(size.triangles).skin.mesh;
    EXPECT_EQ(skin.triangles.size(), size.triangles);
    EXPECT_EQ(skin.positions.size(), size.vertices);
    // Euler's formula for a sheet of one piece with one border and no hole.
    EXPECT_EQ(skin.triangles.size(), 2 * skin.positions.size() - 2 - cachedBack(size.triangles).skin.border);
  }
}

TEST(BackOverBones, Measures350By400By120Millimetres) {
  for (const SizeOfTheText& size : kSizes) {
    const Vec3 extent = mesh::boundingBox(cachedBack(size.triangles).skin.mesh).sizes();
    EXPECT_NEAR(extent.x(), 350.0, 1.5) << size.triangles;
    EXPECT_NEAR(extent.y(), 400.0, 1.5) << size.triangles;
    EXPECT_NEAR(extent.z(), 120.0, 1.5) << size.triangles;
  }
}

TEST(BackOverBones, HasVertebraeRibsAndShoulderBlades) {
  for (const SizeOfTheText& size : kSizes) {
    const Torso& back = cachedBack(size.triangles);
    EXPECT_EQ(back.bones.size(), 41u) << size.triangles;
    EXPECT_EQ(bonesOfKind(back, BoneKind::vertebra), 15u) << "T1 to L3";
    EXPECT_EQ(bonesOfKind(back, BoneKind::rib), 24u);
    EXPECT_EQ(bonesOfKind(back, BoneKind::scapula), 2u);
    for (const char* name : {"spinous_T1", "spinous_T12", "spinous_L3"}) EXPECT_NO_THROW(landmark(back, name)) << name;
    EXPECT_THROW(landmark(back, "spinous_L4"), Error) << "below the piece";
  }
}

/// As one looks at it from behind: crossings of a ray along x with the outline.
bool isInside(const Skin& skin, const Vec3& p) {
  bool inside = false;
  for (Index i = 0, j = skin.border - 1; i < skin.border; j = i++) {
    const Vec3& a = skin.mesh.positions[i];
    const Vec3& b = skin.mesh.positions[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

TEST(BackOverBones, NoBoneIsSeenBeyondTheSkin) {
  const Torso& back = cachedBack(kSizes[0].triangles);
  for (const Bone& bone : back.bones) {
    const auto beyond =
        std::ranges::count_if(bone.mesh.positions, [&](const Vec3& p) { return !isInside(back.skin, p); });
    EXPECT_EQ(beyond, 0) << bone.name << " of " << bone.mesh.positions.size();
  }
}

/// Whether the nearest skin is at its border: there is no telling which side a point beyond the sheet is on.
bool nearestIsBorder(const Skin& skin, const mesh::NearestTriangle::Hit& hit) {
  const Triangle& corners = skin.mesh.triangles[hit.triangle];
  return std::ranges::any_of(corners, [&](Index v) { return v < skin.border; });
}

TEST(BackOverBones, EveryBoneLiesUnderTheSkin) {
  for (const SizeOfTheText& size : kSizes) {
    const Torso& back = cachedBack(size.triangles);
    const mesh::NearestTriangle skin(back.skin.mesh);
    std::size_t judged = 0;
    for (const Bone& bone : back.bones) {
      double least_mm = 1e9;
      for (const Vec3& p : bone.mesh.positions) {
        const auto hit = skin.find(p);
        if (nearestIsBorder(back.skin, hit)) continue;
        const Triangle& t = back.skin.mesh.triangles[hit.triangle];
        const auto& at = back.skin.mesh.positions;
        const Vec3 normal = mesh::areaVector2(at[t[0]], at[t[1]], at[t[2]]).normalized();
        least_mm = std::min(least_mm, (hit.point - p).dot(normal));
        ++judged;
      }
      EXPECT_GT(least_mm, 1.0) << bone.name << " under " << size.triangles << " triangles";
    }
    EXPECT_GT(judged, 1000u) << size.triangles;
  }
}

TEST(BackOverBones, EverySkinVertexKnowsTheNearestBone) {
  for (const SizeOfTheText& size : kSizes) {
    const Torso& back = cachedBack(size.triangles);
    ASSERT_EQ(back.depth_mm.size(), back.skin.mesh.positions.size());
    ASSERT_EQ(back.nearest_bone.size(), back.skin.mesh.positions.size());
    EXPECT_LT(*std::ranges::max_element(back.nearest_bone), back.bones.size());
    EXPECT_GT(*std::ranges::min_element(back.depth_mm), 2.0) << size.triangles;
    const Vec3& t6 = landmark(back, "spinous_T6").position;
    const auto over_t6 =
        std::ranges::min_element(back.skin.mesh.positions, {}, [&](const Vec3& p) { return (p - t6).squaredNorm(); });
    const auto v = static_cast<std::size_t>(over_t6 - back.skin.mesh.positions.begin());
    EXPECT_EQ(back.bones[back.nearest_bone[v]].name, "T6") << size.triangles;
  }
}

TEST(BackOverBones, RefusesTooFewTriangles) { EXPECT_THROW(makeBackOverBones({.triangles = 499, .shape = {}}), Error); }

}  // namespace
}  // namespace palpate::body
