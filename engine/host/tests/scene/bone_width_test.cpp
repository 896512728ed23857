// Posts, ridges and planes under a flat skin: how narrow each is found to be, and how hard the skin over it pushes
// back.
#include "palpate/scene/beneath/bone_width.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "palpate/body/bones.h"
#include "palpate/scene/tissue_of_body.h"
#include "palpate/tissue/layered_library.h"
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

using Height = std::function<double(double, double)>;

/// A flat skin `cover_mm` above the top of a bone in z = 0.
struct SkinOverBone {
  mesh::TriangleMesh skin;
  Anatomy anatomy;

  SkinOverBone(double cover_mm, const Height& bone) : skin(sheet(4.0, [&](double, double) { return cover_mm; })) {
    anatomy.bones = {{.name = "bone", .mesh = sheet(0.5, bone)}};
    anatomy.depth_mm = body::depthToBones(skin.positions, anatomy.bones).depth_mm;
    anatomy.bone_radius_mm = boneRadii(skin, anatomy.depth_mm, anatomy.bones);
  }
  std::size_t middle() const { return skin.positions.size() / 2; }
};

double foundRadius(double cover_mm, const Height& bone) {
  const SkinOverBone body(cover_mm, bone);
  return static_cast<double>(body.anatomy.bone_radius_mm[body.middle()]);
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

/// Height of a post's flat top of this radius in z = 0, and of what lies around it.
double flatTop(double distance, double radius) { return distance < radius ? 0.0 : -40.0; }

Height post(double radius, double (*top)(double, double)) {
  return [=](double x, double y) { return top(std::hypot(x, y), radius); };
}

double flat(double, double) { return 0.0; }

/// N, as a body with this bone pushes back where it is pressed by 2 and by 5 mm.
std::array<double, 2> forcesOver(double cover_mm, const Height& bone) {
  const SkinOverBone body(cover_mm, bone);
  const auto library = std::make_shared<const tissue::LayeredTissue>(tissue::libraryNodes(8.0));
  const PlacedTissue placed = placedTissue({}, body.anatomy.depth_mm, library);
  const double felt_mm =
      tissue::feltThicknesses(*library, placed.thickness_mm, body.anatomy.bone_radius_mm)[body.middle()];
  return {2.0 * library->secantAt(felt_mm, 2.0), 5.0 * library->secantAt(felt_mm, 5.0)};
}

/// By finite elements that share nothing with ours: a sphere of 8 mm on skin of 2 mm and 150 kPa, fat of 4.6 mm and 10
/// kPa, muscle of 3 mm and 27 kPa, over a plane and over posts with flat tops.
TEST(BoneWidth, OverPostsWithFlatTopsTheForceIsThatOfIndependentFiniteElements) {
  struct Case {
    Height bone;
    double light_n, firm_n;
  };
  const std::vector<Case> cases = {
      {flat, 0.60, 3.67}, {post(7.0, flatTop), 0.56, 3.18}, {post(4.0, flatTop), 0.50, 2.64}};
  for (const auto& [bone, light_n, firm_n] : cases) {
    const auto [light, firm] = forcesOver(9.6, bone);
    EXPECT_NEAR(light, light_n, 0.1 * light_n) << "of " << firm_n << " N at 5 mm";
    EXPECT_NEAR(firm, firm_n, 0.1 * firm_n);
  }
}

/// Shares of the force over a plane at 2 and 5 mm that `palpate tissue solve --bone-radius-mm R --fineness 2` gives,
/// for flat tops with --flat-bone.
TEST(BoneWidth, OverPostsTheForceIsTheSolvedOne) {
  struct Case {
    double cover_mm;
    Height bone;
    double light, firm;
  };
  const std::vector<Case> cases = {
      {9, post(2.8, flatTop), 0.75, 0.59},  {9, post(4.2, flatTop), 0.82, 0.69},  {9, post(7, flatTop), 0.93, 0.86},
      {9, post(14, flatTop), 1.00, 1.00},   {11, post(4.2, flatTop), 0.85, 0.73}, {11, post(7, flatTop), 0.93, 0.86},
      {13, post(2.8, flatTop), 0.84, 0.72}, {13, post(5.6, flatTop), 0.91, 0.82}, {13, post(9.8, flatTop), 0.97, 0.93},
      {16, post(4.2, flatTop), 0.90, 0.81}, {20, post(2.8, flatTop), 0.91, 0.82}, {20, post(9.8, flatTop), 0.97, 0.93},
      {9, post(5, ballTop), 0.75, 0.60},    {9, post(12, ballTop), 0.84, 0.73},   {13, post(3, ballTop), 0.83, 0.70},
      {13, post(20, ballTop), 0.93, 0.86},  {20, post(5, ballTop), 0.91, 0.83}};
  for (const auto& [cover_mm, bone, light, firm] : cases) {
    const auto over_bone = forcesOver(cover_mm, bone);
    const auto over_plane = forcesOver(cover_mm, flat);
    EXPECT_NEAR(over_bone[0] / over_plane[0], light, 0.1 * light) << cover_mm << " mm, at 5 mm " << firm;
    EXPECT_NEAR(over_bone[1] / over_plane[1], firm, 0.1 * firm) << cover_mm << " mm";
  }
}

TEST(BoneWidth, IsNotAskedForUnderThickTissue) {
  EXPECT_EQ(foundRadius(35.0, [](double x, double y) { return ballTop(std::hypot(x, y), 4.0); }), tissue::kFlatBoneMm);
}

}  // namespace
}  // namespace palpate::scene
