#include "palpate/body/places.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "support/error_message.h"

namespace palpate::body {
namespace {

SkinLandmark at(const char* name, double x, double y) { return {name, "", {x, y, 100}, Vec3::UnitZ(), {x, y, 92}}; }

const std::vector<SkinLandmark> kLandmarks = {at("spinous_C7", 0, 200),
                                              at("spinous_T4", 0, 100),
                                              at("spinous_T6", 2, 40),
                                              at("spinous_L2", 0, -170),
                                              at("sacrum_S2", 0, -290),
                                              at("psis_left", -48, -295),
                                              at("psis_right", 48, -295),
                                              at("rib_7_right_angle", 73, 20),
                                              at("scapula_left_inferior_angle", -105, -10),
                                              at("iliac_crest_top_right", 100, -200)};

TEST(Places, AreFoundByTheWordsOfAnExaminer) {
  const auto point = [](const char* words) { return placeNamed(kLandmarks, words).point; };
  EXPECT_EQ(point("T6"), Vec3(2, 40, 100));
  EXPECT_EQ(point("t6"), Vec3(2, 40, 100));
  EXPECT_EQ(point("spinous process T6"), Vec3(2, 40, 100));
  EXPECT_EQ(point("spinous_T6"), Vec3(2, 40, 100));
  EXPECT_EQ(point("left PSIS"), Vec3(-48, -295, 100));
  EXPECT_EQ(point("PSIS right"), Vec3(48, -295, 100));
  EXPECT_EQ(point("S2"), Vec3(0, -290, 100));
  EXPECT_EQ(point("right rib 7 angle"), Vec3(73, 20, 100));
  EXPECT_EQ(point("left scapula inferior angle"), Vec3(-105, -10, 100));
  EXPECT_EQ(point("right iliac crest"), Vec3(100, -200, 100));
}

TEST(Places, AreMovedByDistances) {
  const NamedPlace moved = placeNamed(kLandmarks, "T6 right 30 mm up 12.5mm");
  EXPECT_EQ(moved.point, Vec3(32, 52.5, 100));
  EXPECT_EQ(moved.name, "T6 right 30 mm up 12.5 mm");
  EXPECT_TRUE(moved.moved);
  EXPECT_EQ(placeNamed(kLandmarks, "left PSIS left 10 caudal 5").point, Vec3(-58, -300, 100));
}

TEST(Places, OfAPointAreSaidInWordsThatAreReadBack) {
  EXPECT_EQ(makePlaceName(kLandmarks, Vec2(2.2, 39.9)), "T6");
  EXPECT_EQ(makePlaceName(kLandmarks, Vec2(-28.4, 47.6)), "T6 left 30 mm up 8 mm");
  for (const Vec2& place : {Vec2(-28.4, 47.6), Vec2(70, 18), Vec2(-51, -290), Vec2(0, 195)}) {
    const Vec3 read = placeNamed(kLandmarks, makePlaceName(kLandmarks, place)).point;
    EXPECT_LT((read.head<2>() - place).cwiseAbs().maxCoeff(), 0.51) << makePlaceName(kLandmarks, place);
  }
  EXPECT_EQ(makePlaceName({}, Vec2(0, 0)), "");
}

TEST(Places, TwelveSitesLieBesideSixLevels) {
  EXPECT_EQ(placeNamed(kLandmarks, "left site 1").point, Vec3(-30, 100, 100)) << "beside T4";
  EXPECT_EQ(placeNamed(kLandmarks, "site 2 right").point, Vec3(32, 40, 100)) << "beside T6";
  EXPECT_THROW(placeNamed(kLandmarks, "left site 3"), Error) << "this body has no T8";
}

TEST(Places, AMisspeltNameIsAnsweredWithTheOneThatIsNear) {
  try {
    placeNamed(kLandmarks, "left PSISS");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("left PSIS"), std::string::npos) << error.what();
  }
  EXPECT_THROW(placeNamed({}, "T6"), Error);
  EXPECT_THROW(placeNamed(kLandmarks, ""), Error);
  EXPECT_THROW(placeNamed(kLandmarks, "T6 right 1e9 mm"), Error);
}

TEST(Places, AMisspeltWordIsAnsweredWithFewNames) {
  const auto message_of = [](const char* words) {
    return support::thrownMessage([&] { placeNamed(kLandmarks, words); });
  };
  EXPECT_EQ(message_of("T6 rigth 30 mm"), "unknown place 'T6 rigth 30 mm'; did you mean 'T6 right 30 mm'?");
  EXPECT_EQ(message_of("right iliac crest up 10 lft 5"),
            "unknown place 'right iliac crest up 10 lft 5'; did you mean 'right iliac crest left 5 mm up 10 mm'?");
  EXPECT_EQ(
      message_of("somewhere on the belly"),
      "unknown place 'somewhere on the belly'; the nearest names are 'left site 1', 'right site 1', 'left site 2'");
}

TEST(Places, APointIsToldFromTheLandmarkThatAnExaminerWouldStartFrom) {
  EXPECT_EQ(describePlace(kLandmarks, {3, 41, 100}), "T6");
  EXPECT_EQ(describePlace(kLandmarks, {32, 48, 98}), "T6, 30 mm right and 8 mm up");
  EXPECT_EQ(describePlace(kLandmarks, {-48, -300, 98}), "left PSIS, 5 mm down");
  EXPECT_EQ(describePlace({}, {0, 0, 0}), "");
}

TEST(Places, EveryNameInTheListIsFound) {
  for (const std::string& name : placeNames(kLandmarks)) EXPECT_EQ(placeNamed(kLandmarks, name).name, name);
}

}  // namespace
}  // namespace palpate::body
