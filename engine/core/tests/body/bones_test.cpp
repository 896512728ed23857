// The 43 bones: sound meshes, mirrored, scaled, exact counts, none inside another, under the skin at their covers.
#include "palpate/body/bones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <set>

#include "palpate/base/error.h"
#include "palpate/body/skin_surface.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/validate.h"
#include "support/sound_mesh.h"
#include "support/timed.h"
#include "support/winding_number.h"

namespace palpate::body {
namespace {

// Bones take half a second to make, so tests share them.
struct MadeBones {
  std::vector<Bone> bones;
  double seconds;  ///< of processor time: tests share the machine
};

MadeBones madeBones(const BonesSettings& settings) {
  const std::clock_t start = std::clock();
  std::vector<Bone> bones = makeBones(settings);
  return {std::move(bones), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

const MadeBones& defaultMade() {
  static const MadeBones made = madeBones({});
  return made;
}

const std::vector<Bone>& defaultBones() { return defaultMade().bones; }

const std::vector<Bone>& fewestBones() {
  static const std::vector<Bone> bones = makeBones({.triangles = kFewestBoneTriangles});
  return bones;
}

const Bone& bone(const std::string& name) {
  const auto& bones = defaultBones();
  const auto found = std::find_if(bones.begin(), bones.end(), [&](const Bone& b) { return b.name == name; });
  if (found == bones.end()) throw Error("no bone " + name);
  return *found;
}

std::size_t totalTriangles(const std::vector<Bone>& bones) {
  return std::accumulate(bones.begin(), bones.end(), std::size_t{0},
                         [](std::size_t sum, const Bone& b) { return sum + b.mesh.triangles.size(); });
}

// The skin above the bones as a dense sheet, 2.5 mm apart.
const mesh::NearestTriangle& skin() {
  static const mesh::NearestTriangle tree = [] {
    constexpr Index kAcross = 200;
    constexpr Index kAlong = 196;
    const SkinSurface surface;
    mesh::TriangleMesh sheet;
    for (Index i = 0; i <= kAcross; ++i) {
      for (Index j = 0; j <= kAlong; ++j) {
        sheet.positions.push_back(surface.at({-1.2 + 2.4 * i / kAcross, -290.0 + 490.0 * j / kAlong}).position);
      }
    }
    for (Index i = 0; i < kAcross; ++i) {
      for (Index j = 0; j < kAlong; ++j) {
        const Index a = i * (kAlong + 1) + j;
        const Index c = a + kAlong + 1;
        sheet.triangles.push_back({a, c, a + 1});
        sheet.triangles.push_back({a + 1, c, c + 1});
      }
    }
    return mesh::NearestTriangle(sheet);
  }();
  return tree;
}

// Least distance of a bone's vertices to the skin; of a vertebra only what lies near the midline.
double cover(const Bone& b) {
  double least = 1e9;
  for (const Vec3& p : b.mesh.positions) {
    if (b.kind == BoneKind::vertebra && std::abs(p.x()) > 12.0) continue;
    least = std::min(least, skin().find(p, least).distance);
  }
  return least;
}

TEST(Bones, AreFortyThreeInAFixedOrder) {
  const auto& bones = defaultBones();
  ASSERT_EQ(bones.size(), kBoneCount);
  EXPECT_EQ(bones[0].name, "T1");
  EXPECT_EQ(bones[16].name, "L5");
  EXPECT_EQ(bones[17].name, "rib_1_right");
  EXPECT_EQ(bones[40].name, "rib_12_left");
  EXPECT_EQ(bones[42].name, "scapula_left");
}

TEST(Bones, AreClosedManifoldOutwardInOnePieceAndDoNotPierceThemselves) {
  for (const Bone& b : defaultBones()) {
    SCOPED_TRACE(b.name);
    EXPECT_GT(support::expectOnePiece(b.mesh).volume_mm3, 3000.0);  // the twelfth rib has about 4 cm^3
  }
}

TEST(Bones, HaveTheSizeOfBones) {
  // Volumes in cm^3 of bodies built from the same dimensions: vertebrae 15-47, ribs 4-25, scapula 81.
  for (const Bone& b : defaultBones()) {
    SCOPED_TRACE(b.name);
    const double volume = mesh::validate(b.mesh, {false}).volume_mm3 / 1000.0;
    const auto [least, most] = b.kind == BoneKind::vertebra ? std::pair(12.0, 52.0)
                               : b.kind == BoneKind::rib    ? std::pair(3.5, 29.0)
                                                            : std::pair(60.0, 95.0);
    EXPECT_GT(volume, least);
    EXPECT_LT(volume, most);
  }
}

TEST(Bones, HaveTheAskedNumberOfTrianglesExactly) {
  EXPECT_EQ(totalTriangles(defaultBones()), 60000u);
  const auto check = [](const std::vector<Bone>& bones, std::size_t total) {
    EXPECT_EQ(totalTriangles(bones), total);
    for (const Bone& b : bones) EXPECT_TRUE(mesh::validate(b.mesh, {false}).closed) << b.name;
  };
  check(fewestBones(), kFewestBoneTriangles);
  for (const std::size_t total : {5002, 12344}) check(makeBones({.triangles = total}), total);
}

TEST(Bones, ShareTrianglesExactlyAndAlikeOnBothSides) {
  for (std::size_t total = kFewestBoneTriangles; total < 6000; total += 2) {
    const std::vector<std::size_t> counts = shareTriangles(total);
    ASSERT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), total);
    EXPECT_TRUE(std::all_of(counts.begin(), counts.end(), [](std::size_t n) { return n % 2 == 0 && n >= 40; }));
    EXPECT_EQ(counts[41], counts[42]);
    EXPECT_TRUE(std::equal(counts.begin() + 17, counts.begin() + 29, counts.begin() + 29));
  }
}

TEST(Bones, FewTrianglesStayNearTheFullShape) {
  BonesSettings fine;
  fine.cell_mm = 1.0;
  fine.triangles = 120000;
  BonesSettings coarse;
  coarse.triangles = 30000;  // a vertebra 412, a scapula 908
  const auto many = makeBones(fine);
  const auto few = makeBones(coarse);
  for (const std::size_t i : {std::size_t{5}, std::size_t{14}, std::size_t{23}, std::size_t{41}}) {
    SCOPED_TRACE(many[i].name);
    const mesh::NearestTriangle tree(few[i].mesh);
    double squares = 0.0;
    double worst = 0.0;
    for (const Vec3& p : many[i].mesh.positions) {
      const double d = tree.find(p).distance;
      squares += d * d;
      worst = std::max(worst, d);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(many[i].mesh.positions.size())), 0.25);
    EXPECT_LT(worst, 1.5);
  }
}

TEST(Bones, LeftAndRightAreExactMirrorImages) {
  for (const char* name : {"rib_1_", "rib_7_", "rib_12_", "scapula_"}) {
    const auto& right = bone(std::string(name) + "right").mesh.positions;
    const auto& left = bone(std::string(name) + "left").mesh.positions;
    ASSERT_EQ(right.size(), left.size());
    for (std::size_t v = 0; v < right.size(); ++v) {
      EXPECT_EQ(left[v], Vec3(-right[v].x(), right[v].y(), right[v].z()));
    }
  }
}

TEST(Bones, VertebraeAreExactlySymmetric) {
  const auto key = [](double x, const Vec3& p) { return std::array<double, 3>{x, p.y(), p.z()}; };
  for (const char* name : {"T1", "T6", "L3"}) {
    std::set<std::array<double, 3>> points;
    for (const Vec3& p : bone(name).mesh.positions) points.insert(key(p.x(), p));
    for (const Vec3& p : bone(name).mesh.positions) EXPECT_TRUE(points.count(key(-p.x(), p)) == 1) << name;
  }
}

// The first pair of which one has a vertex inside the other, or nothing.
std::string firstPiercedPair(const std::vector<Bone>& bones) {
  for (const Bone& outer : bones) {
    const auto box = mesh::boundingBox(outer.mesh);
    for (const Bone& inner : bones) {
      if (&inner == &outer) continue;
      for (const Vec3& p : inner.mesh.positions) {
        if (box.contains(p) && support::windingNumber(outer.mesh, p) > 0.5) return inner.name + " in " + outer.name;
      }
    }
  }
  return "";
}

TEST(Bones, NoVertexOfOneLiesInsideAnother) { EXPECT_EQ(firstPiercedPair(defaultBones()), ""); }

TEST(Bones, NoVertexOfOneLiesInsideAnotherInTheDefaultTorso) {
  BonesSettings settings;
  settings.triangles = 8972;  // its share of 20,389
  Asymmetry asymmetry;
  asymmetry.amount = 1.0;
  settings.warp = [&](const Vec3& p) { return warp(asymmetry, p).position; };
  EXPECT_EQ(firstPiercedPair(makeBones(settings)), "");
}

TEST(Bones, LieUnderTheSkinAtTheirCovers) {
  const std::array<double, 17> spinous = {8, 7, 6.5, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6.5, 7, 7, 7, 7.5};
  for (std::size_t i = 0; i < spinous.size(); ++i) {
    EXPECT_NEAR(cover(defaultBones()[i]), spinous[i], 0.5) << defaultBones()[i].name;
  }
  EXPECT_GT(cover(bone("scapula_right")), 3.5);
  for (int rib = 1; rib <= 12; ++rib) EXPECT_GT(cover(bone("rib_" + std::to_string(rib) + "_right")), 15.0) << rib;
}

TEST(Bones, DepthsAgreeWithPublishedOnes) {
  // Rib 5 between spine and scapula, 27 +- 4 mm under the skin (Wada 2025).
  double least = 1e9;
  for (const Vec3& p : bone("rib_5_right").mesh.positions) {
    if (std::abs(p.x() - 75.0) < 3.0 && p.z() > 60.0) least = std::min(least, skin().find(p).distance);
  }
  EXPECT_NEAR(least, 24.0, 4.0);
  // Lumbar transverse processes 45-59 mm (Yoon 2020, second-hand); a lean man.
  for (const char* name : {"L1", "L2", "L3", "L4", "L5"}) {
    double depth = 1e9;
    for (const Vec3& p : bone(name).mesh.positions) {
      if (std::abs(p.x()) > 30.0) depth = std::min(depth, skin().find(p).distance);
    }
    EXPECT_TRUE(depth > 38.0 && depth < 60.0) << name << ' ' << depth;
  }
}

TEST(Bones, ScaleWithStature) {
  BonesSettings settings;
  settings.stature_mm = 1575.0;
  const std::vector<Bone> shorter = makeBones(settings);
  for (std::size_t b = 0; b < kBoneCount; b += 7) {
    for (std::size_t v = 0; v < shorter[b].mesh.positions.size(); ++v) {
      EXPECT_TRUE(shorter[b].mesh.positions[v].isApprox(0.9 * defaultBones()[b].mesh.positions[v], 1e-12));
    }
  }
}

TEST(Bones, FollowAWarpBeforeTheScaling) {
  BonesSettings settings;
  settings.triangles = kFewestBoneTriangles;
  settings.stature_mm = 3500.0 / 2;
  settings.warp = [](const Vec3& p) { return Vec3(p + Vec3(2.0, 0.0, 0.0)); };
  const std::vector<Bone> bent = makeBones(settings);
  EXPECT_TRUE(bent[3].mesh.positions[0].isApprox(fewestBones()[3].mesh.positions[0] + Vec3(2.0, 0.0, 0.0), 1e-12));
}

TEST(Bones, AreTheSameEveryTime) {
  const auto again = makeBones({.triangles = kFewestBoneTriangles});
  for (std::size_t b = 0; b < kBoneCount; ++b) EXPECT_EQ(again[b].mesh.positions, fewestBones()[b].mesh.positions);
}

TEST(Bones, AreBuiltQuicklyEnoughForEveryStart) {
  if (!support::timesAreJudged()) GTEST_SKIP() << "PALPATE_TIMED=1 judges it (tools/check-speed)";
  EXPECT_LT(defaultMade().seconds, 2.5);  // about 1 s on a quiet core
}

TEST(Bones, RefuseWhatCannotBeBuilt) {
  EXPECT_THROW(makeBones({.triangles = 20001}), Error);
  EXPECT_THROW(makeBones({.triangles = 200}), Error);
  EXPECT_THROW(makeBones({.stature_mm = 0.0}), Error);
  EXPECT_THROW(makeBones({.cell_mm = std::nan("")}), Error);
}

TEST(BoneLandmarks, LieOnTheirBones) {
  for (const Landmark& landmark : boneLandmarks()) {
    SCOPED_TRACE(landmark.name);
    EXPECT_LT(mesh::NearestTriangle(bone(landmark.bone).mesh).find(landmark.position).distance, 1.0);
  }
}

TEST(BoneLandmarks, StandAtThePublishedLevels) {
  std::map<std::string, Vec3> at;
  for (const Landmark& landmark : boneLandmarks()) at[landmark.name] = landmark.position;
  EXPECT_EQ(at.size(), 17u + 24u + 8u);
  // The root of the scapular spine lies at the level of T3-T4, the inferior angle at T8 (T7-T9).
  EXPECT_LT(at["scapula_right_spine_root"].y(), at["spinous_T3"].y());
  EXPECT_GT(at["scapula_right_spine_root"].y(), at["spinous_T5"].y());
  EXPECT_LT(at["scapula_right_inferior_angle"].y(), at["spinous_T7"].y());
  EXPECT_GT(at["scapula_right_inferior_angle"].y(), at["spinous_T9"].y());
  for (int level = 1; level < 12; ++level) {
    const double step = at["spinous_T" + std::to_string(level)].y() - at["spinous_T" + std::to_string(level + 1)].y();
    EXPECT_TRUE(step > 18.0 && step < 35.0) << "T" << level << ": " << step;
  }
}

}  // namespace
}  // namespace palpate::body
