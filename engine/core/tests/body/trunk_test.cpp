#include "palpate/body/trunk/trunk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/body/skin_outline.h"
#include "palpate/body/trunk/trunk_field.h"
#include "palpate/body/trunk/trunk_folds.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/validate.h"

namespace palpate::body {
namespace {

constexpr std::size_t kFew = 20000;

/// Made once a test program.
const Trunk& trunkOf(const std::string& name) {
  static std::map<std::string, Trunk> made;
  const auto found = made.find(name);
  if (found != made.end()) return found->second;
  TrunkSettings settings{.triangles = kFew, .shape = {}};
  if (name == "thin") settings.shape.body_mass_index = 17;
  if (name == "wasted") settings.shape = {.body_mass_index = 16, .muscle = 0};
  if (name == "heavy") settings.shape.body_mass_index = 35;
  if (name == "athlete") settings.shape = {.body_mass_index = 25, .muscle = 2};
  if (name == "bent") settings.shape = {.kyphosis_deg = 60, .lordosis_deg = 45};
  if (name == "prone") settings.shape.posture = Posture::prone;
  if (name == "sitting") settings.shape.posture = Posture::sitting;
  if (name == "broad") settings.shape = {.stature_mm = 1900, .girth = 1.2};
  return made.emplace(name, makeTrunk(settings)).first->second;
}

/// What other tests look at too; the others are asked in the second circle.
constexpr const char* kBuilds[] = {"average", "heavy", "prone"};
constexpr const char* kOtherBuilds[] = {"thin", "bent", "sitting", "wasted", "athlete", "broad"};

const SkinLandmark& landmarkOf(const Trunk& trunk, const std::string& name) {
  return *std::find_if(trunk.landmarks.begin(), trunk.landmarks.end(), [&](const auto& l) { return l.name == name; });
}

void expectTriangles(std::size_t triangles) {
  const Trunk trunk = makeTrunk({.triangles = triangles, .shape = {}});
  std::size_t sum = trunk.skin.triangles.size();
  for (const Bone& bone : trunk.bones) sum += bone.mesh.triangles.size();
  EXPECT_EQ(sum, triangles);
}

TEST(Trunk, HasExactlyTheTrianglesAskedFor) {
  for (const std::size_t triangles : {8000u, 20388u}) expectTriangles(triangles);
  EXPECT_THROW(makeTrunk({.triangles = 20389, .shape = {}}), Error) << "a closed body has an even number";
}

/// Suites of their own, so that they need not run on every change: large and many trunks take long to make.
TEST(LargeTrunk, HasExactlyTheTrianglesAskedFor) {
  for (const std::size_t triangles : {41582u, 83164u}) expectTriangles(triangles);
}

void expectSoundSkin(const Trunk& trunk) {
  const mesh::ValidationReport found = mesh::validate(trunk.skin);
  EXPECT_TRUE(found.sound());
  EXPECT_EQ(found.self_intersections.count, 0u);
}

void expectBonesUnderSkin(const Trunk& trunk) {
  const auto least = std::min_element(trunk.depth_mm.begin(), trunk.depth_mm.end());
  const auto where = static_cast<std::size_t>(least - trunk.depth_mm.begin());
  EXPECT_GT(*least, 2.0) << trunk.bones[trunk.nearest_bone[where]].name << " near "
                         << describePlace(trunk.landmarks, trunk.skin.positions[where]);
  // A bone outside altogether would have skin at a distance too.
  for (const Bone& bone : trunk.bones) {
    EXPECT_TRUE(mesh::boundingBox(trunk.skin).contains(mesh::boundingBox(bone.mesh))) << bone.name;
  }
}

void expectNamesOverSpinousProcesses(const Trunk& trunk) {
  for (const SkinLandmark& landmark : trunk.landmarks) {
    if (!landmark.name.starts_with("spinous_")) continue;
    const Vec3 place = placeNamed(trunk.landmarks, spokenName(landmark.name)).point;
    // The drawn process, seen from behind.
    mesh::TriangleMesh shadow = std::find_if(trunk.bones.begin(), trunk.bones.end(), [&](const Bone& b) {
                                  return b.name == landmark.bone;
                                })->mesh;
    for (Vec3& p : shadow.positions) p.z() = 0;
    EXPECT_LT(mesh::NearestTriangle(shadow).find({place.x(), place.y(), 0}).distance, 3) << landmark.name;
  }
}

void expectSound(const char* build) {
  SCOPED_TRACE(build);
  const Trunk& trunk = trunkOf(build);
  expectSoundSkin(trunk);
  expectBonesUnderSkin(trunk);
  expectNamesOverSpinousProcesses(trunk);
}

/// One test for all builds: making them is what costs.
TEST(Trunk, EveryBuildIsSoundHidesItsBonesAndNamesItsLevels) {
  for (const char* build : kBuilds) expectSound(build);
}

TEST(TrunkOfOtherBuilds, IsSoundHidesItsBonesAndNamesItsLevels) {
  for (const char* build : kOtherBuilds) expectSound(build);
}

TEST(Trunk, SpinousProcessesLieShallowAndTheLoinIsSoft) {
  const Trunk& trunk = trunkOf("average");
  for (const char* level : {"T1", "T4", "T6", "T9", "T12", "L2", "L4"}) {
    const SkinLandmark& point = landmarkOf(trunk, std::string("spinous_") + level);
    EXPECT_GT((point.position - point.bone_position).norm(), 4) << level;
    EXPECT_LT((point.position - point.bone_position).norm(), 14) << level;
  }
  const Vec3 belly(0, -170, -200);
  const mesh::NearestTriangle skin(trunk.skin);
  const Index triangle = skin.find(belly).triangle;
  EXPECT_GT(trunk.depth_mm[trunk.skin.triangles[triangle][0]], 60);
}

TEST(Trunk, ItsBackIsTheBackThatWasFittedBefore) {
  const TrunkField field;
  const SkinSurface back;
  double squares = 0;
  int count = 0;
  for (double y = -190; y <= 190; y += 10) {
    for (double angle = -0.9; angle <= 0.9; angle += 0.05) {
      if (std::abs(angle) > borderAngle(y) - 0.1) continue;
      const Vec3 place = back.at({angle, y}).position;
      const double off = (field.project(place).position - place).norm();
      squares += off * off;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.6) << "two fits of one body, one by radius, one by distance";
}

TEST(TrunkFolds, MoveNothingOnTheBackFromTheNeckToTheSacrum) {
  const TrunkField field;
  const TrunkFolds folds(field, {});
  int count = 0;
  for (double y = -390; y <= 230; y += 5) {
    for (double x = -135; x <= 135; x += 5) {
      const SkinPoint place = field.project(Vec3(x, y, 105));
      if (place.normal.z() < 0.3 || place.position.z() < 40) continue;
      EXPECT_EQ(folds.at(place), Vec3::Zero()) << place.position.transpose();
      ++count;
    }
  }
  EXPECT_GT(count, 4000);
}

TEST(TrunkFolds, MakeCreaseNavelAndCollarBonesOnBothSidesAlike) {
  const TrunkField field;
  const TrunkFolds folds(field, {});
  const auto out = [&](const Vec3& near) {
    const SkinPoint place = field.project(near);
    const SkinPoint other = field.project(Vec3(-near.x(), near.y(), near.z()));
    const Vec3 moved = folds.at(place);
    EXPECT_LT((folds.at(other) - Vec3(-moved.x(), moved.y(), moved.z())).norm(), 1e-6);
    return moved.dot(place.normal);
  };
  EXPECT_LT(out({60, -469, 92}), -4) << "gluteal crease";
  EXPECT_LT(out({0, -220, -100}), -5) << "navel";
  EXPECT_LT(out({178, 16, 8}), -4) << "armpit";
  EXPECT_GT(out({90, 160, -8}), 2) << "collar bone";
  EXPECT_GT(out({0, -280, -103}), 5) << "belly";
  const TrunkFolds of_sitting(field, {.gluteal = 0, .belly = 0});
  EXPECT_EQ(of_sitting.at(field.project({60, -469, 92})), Vec3::Zero());
  EXPECT_EQ(of_sitting.at(field.project({0, -290, -103})), Vec3::Zero());
}

TEST(Trunk, MoreBodyMassMovesTheBellyMostAndTheBonesNotAtAll) {
  const Trunk& average = trunkOf("average");
  const Trunk& heavy = trunkOf("heavy");
  ASSERT_EQ(average.skin.positions.size(), heavy.skin.positions.size());
  double most = 0;
  Vec3 where = Vec3::Zero();
  for (std::size_t v = 0; v < average.skin.positions.size(); ++v) {
    const double moved = (heavy.skin.positions[v] - average.skin.positions[v]).norm();
    if (moved > most) {
      most = moved;
      where = average.skin.positions[v];
    }
  }
  EXPECT_GT(most, 25);
  EXPECT_LT(where.z(), -80);
  EXPECT_NEAR(where.y(), -210, 60);
  EXPECT_EQ(average.bones[10].mesh.positions[0], heavy.bones[10].mesh.positions[0]);
}

/// What a tape around the body measures at this height, cm: the hull of what is cut there.
double tapeAt(const mesh::TriangleMesh& skin, double y) {
  std::vector<Vec2> cut;
  for (const Triangle& t : skin.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& a = skin.positions[t[i]];
      const Vec3& b = skin.positions[t[(i + 1) % 3]];
      if ((a.y() < y) == (b.y() < y)) continue;
      const Vec3 at = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
      cut.emplace_back(at.x(), at.z());
    }
  }
  double length = 0;
  constexpr int kTurns = 720;
  for (int i = 0; i < kTurns; ++i) {  // Cauchy: the mean width times pi
    const double turn = std::numbers::pi * i / kTurns;
    const Vec2 way(std::cos(turn), std::sin(turn));
    double low = 1e9, high = -1e9;
    for (const Vec2& p : cut) {
      low = std::min(low, p.dot(way));
      high = std::max(high, p.dot(way));
    }
    length += std::numbers::pi / kTurns * (high - low);
  }
  return length / 10;
}

TEST(Trunk, TheWaistGainsTwoCentimetresAUnitOfBodyMassIndex) {
  constexpr double kWaistY = -230;
  const double average = tapeAt(trunkOf("average").skin, kWaistY);
  EXPECT_NEAR(average, 76, 3);
  EXPECT_NEAR((tapeAt(trunkOf("heavy").skin, kWaistY) - average) / 12.5, 2.1, 0.4);
  EXPECT_NEAR((average - tapeAt(trunkOf("thin").skin, kWaistY)) / 5.5, 1.5, 0.5) << "bone and muscle do not go";
}

TEST(Trunk, ThinSkinFollowsTheRibs) {
  const Trunk& average = trunkOf("average");
  const Trunk& thin = trunkOf("thin");
  double lost = 0;  // of the cover, vertex by vertex
  int count = 0;
  for (std::size_t v = 0; v < average.depth_mm.size(); ++v) {
    if (average.bones[average.nearest_bone[v]].kind != BoneKind::rib || average.depth_mm[v] > 25) continue;
    lost += average.depth_mm[v] - thin.depth_mm[v];
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_GT(lost / count, 1.5);
}

TEST(Trunk, KyphosisBendsTheSpineByWhatIsAsked) {
  const auto kyphosis = [](const Trunk& trunk) {
    const auto body_axis = [&](const char* name) {
      const Bone& bone =
          *std::find_if(trunk.bones.begin(), trunk.bones.end(), [&](const Bone& b) { return b.name == name; });
      Vec3 middle = Vec3::Zero();
      for (const Vec3& p : bone.mesh.positions) middle += p / static_cast<double>(bone.mesh.positions.size());
      return middle;
    };
    const Vec3 upper = body_axis("T1") - body_axis("T3");
    const Vec3 lower = body_axis("T10") - body_axis("T12");
    return (std::atan2(-upper.z(), upper.y()) - std::atan2(-lower.z(), lower.y())) * 180 / 3.14159265;
  };
  const double more = kyphosis(trunkOf("bent")) - kyphosis(trunkOf("average"));
  EXPECT_NEAR(more, 22, 4) << "60 degrees where 38 were";
}

TEST(Trunk, LyingIsFlatInFrontAndLeavesTheBackAsItIs) {
  const Trunk& prone = trunkOf("prone");
  const Trunk& standing = trunkOf("average");
  ASSERT_TRUE(prone.support.has_value());
  int flat = 0;
  for (std::size_t v = 0; v < prone.skin.positions.size(); ++v) {
    const double above = prone.skin.positions[v].z() - prone.support->point.z();
    EXPECT_GT(above, -1e-9);
    flat += above < 2 ? 1 : 0;
    if (standing.skin.positions[v].z() > 50) {
      EXPECT_LT((prone.skin.positions[v] - standing.skin.positions[v]).norm(), 1e-6);
    }
  }
  EXPECT_GT(flat, 30);
  EXPECT_FALSE(standing.support.has_value());
}

TEST(Trunk, BonesOfTheBackShowOnTheBackAlone) {
  const Trunk even = makeTrunk({.triangles = kFew, .shape = {.relief = noRelief(), .asymmetry = 0}});
  const Trunk lean = makeTrunk({.triangles = kFew, .shape = {.asymmetry = 0}});
  double most = 0;
  for (std::size_t v = 0; v < even.skin.positions.size(); ++v) {
    const double moved = (even.skin.positions[v] - lean.skin.positions[v]).norm();
    most = std::max(most, moved);
    const Vec3& p = even.skin.positions[v];
    const bool in_front = p.z() < -30 && std::abs(p.x()) < 35;  // from the jugular notch to the pubis
    if (in_front) {
      EXPECT_EQ(moved, 0) << p.transpose();
    }
  }
  EXPECT_GT(most, 0.5);
}

TEST(Trunk, RefusesWhatIsNoBuildAndNamesIt) {
  try {
    makeTrunk({.triangles = kFew, .shape = {.body_mass_index = 60}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("body mass index 60.0 kg/m2 is out of range: 16.0 to 45.0"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace palpate::body
