#include "palpate/tissue/user_profile.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::tissue {

std::string messageForKnots(const std::string& text) {
  return support::thrownMessage([&] { parseProfileKnots(text, "p.csv"); });
}

TEST(UserProfile, ReadsRowsWithHeaderAndComments) {
  const auto knots = parseProfileKnots("# of my own\nq,value\n0, 1\n0.5, 0.3  # half way\n\n1, 0\n", "p.csv");
  ASSERT_EQ(knots.size(), 3u);
  EXPECT_EQ(knots[1].q, 0.5);
  EXPECT_EQ(knots[1].value, 0.3);
}

TEST(UserProfile, NamesTheLineOfEveryMistake) {
  support::expectEach(messageForKnots, {{"0,1\n0.5,0.2\n0.5,0.1\n1,0\n", "p.csv:3: q must ascend: 0.5 after 0.5"},
                                        {"0.1,1\n1,0\n", "p.csv:1: the first q must be 0, not 0.1"},
                                        {"0,0.9\n1,0\n", "p.csv:1: the value at q = 0 must be 1, not 0.9"},
                                        {"0,1\n0.9,0\n", "p.csv:2: the last q must be 1, not 0.9"},
                                        {"0,1\n1,0.01\n", "p.csv:2: the value at q = 1 must be 0, not 0.01"},
                                        {"0,1\n1.5,0\n", "p.csv:2: q must not go beyond 1, the rim; it is 1.5"},
                                        {"0,1\n0.5,0.2,7\n1,0\n", "p.csv:2: expected a row q,value"},
                                        {"0,1\n", "p.csv: a profile requires at least two rows q,value"},
                                        {"", "p.csv: a profile requires at least two rows q,value"}});
  EXPECT_EQ(messageForKnots("0,1\n0.5,many\n1,0\n").substr(0, 8), "p.csv:2:");
  EXPECT_EQ(messageForKnots("0,1\nq,value\n1,0\n").substr(0, 8), "p.csv:2:") << "a header stands in front only";
  EXPECT_EQ(messageForKnots("0,1\n0.5,nan\n1,0\n").substr(0, 8), "p.csv:2:");
}

TEST(UserProfile, ReadsAFile) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "mine.csv";
  std::ofstream(file) << "0,1\n1,0\n";
  EXPECT_EQ(readProfileKnots(file).size(), 2u);
  EXPECT_THROW(readProfileKnots(folder.path() / "none.csv"), Error);
}

ProfileCurve makeCurve(std::vector<ProfileKnot> knots, UserInterpolation interpolation) {
  ProfileSettings settings;
  settings.kind = ProfileKind::user;
  settings.knots = std::move(knots);
  settings.interpolation = interpolation;
  return ProfileCurve(settings);
}

const std::vector<ProfileKnot> kUneven{{0, 1}, {0.1, 0.98}, {0.15, 0.6}, {0.6, 0.55}, {0.9, 0.01}, {1, 0}};

TEST(UserProfile, PassesThroughItsRows) {
  for (const auto interpolation : {UserInterpolation::monotone_cubic, UserInterpolation::linear}) {
    const ProfileCurve curve = makeCurve(kUneven, interpolation);
    for (const ProfileKnot& knot : kUneven) EXPECT_NEAR(curve.at(knot.q).value, knot.value, 1e-12);
  }
}

TEST(UserProfile, CubicIsLevelWhereItsRowsTurn) {
  const ProfileCurve curve = makeCurve({{0, 1}, {0.3, 0.2}, {0.6, 0.5}, {1, 0}}, UserInterpolation::monotone_cubic);
  EXPECT_NEAR(curve.at(0.3).slope, 0.0, 1e-12);
  EXPECT_NEAR(curve.at(0.6).slope, 0.0, 1e-12);
}

TEST(UserProfile, LinearIsStraightBetweenRows) {
  const ProfileCurve curve = makeCurve(kUneven, UserInterpolation::linear);
  EXPECT_NEAR(curve.at(0.75).value, 0.28, 1e-12);
  EXPECT_NEAR(curve.at(0.75).slope, -1.8, 1e-12);
}

TEST(UserProfile, CubicNeverOvershoots) {
  const ProfileCurve curve = makeCurve(kUneven, UserInterpolation::monotone_cubic);
  double before = 1.0;
  for (double q = 0.0; q < 1.0; q += 0.0005) {
    EXPECT_LE(curve.at(q).value, before + 1e-15) << q;
    before = curve.at(q).value;
  }
}

TEST(UserProfile, CubicHasNoKinks) {
  const ProfileCurve curve = makeCurve(kUneven, UserInterpolation::monotone_cubic);
  for (std::size_t i = 1; i + 1 < kUneven.size(); ++i) {
    EXPECT_NEAR(curve.at(kUneven[i].q - 1e-9).slope, curve.at(kUneven[i].q + 1e-9).slope, 1e-5);
  }
}

TEST(UserProfile, TwoRowsAreASmoothStep) {
  const ProfileCurve curve = makeCurve({{0, 1}, {1, 0}}, UserInterpolation::monotone_cubic);
  for (double q = 0.0; q < 1.0; q += 0.1) EXPECT_NEAR(curve.at(q).value, 1.0 - q * q * (3.0 - 2.0 * q), 1e-14);
}

}  // namespace palpate::tissue
