// The hand: closed, one piece, exact count, its length, sides mirrored.
#include "palpate/body/hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/validate.h"
#include "support/sound_mesh.h"

namespace palpate::body {
namespace {

const mesh::TriangleMesh& defaultHand() {
  static const mesh::TriangleMesh hand = makeHand();
  return hand;
}

TEST(Hand, IsAClosedManifoldInOnePiece) {
  const mesh::ValidationReport report = support::expectOnePiece(defaultHand());
  EXPECT_TRUE(report.volume_mm3 > 300e3 && report.volume_mm3 < 550e3) << report.volume_mm3;  // about 0.4 litre
}

TEST(Hand, HasTheAskedNumberOfTriangles) {
  EXPECT_EQ(defaultHand().triangles.size(), HandSettings{}.triangles);
  for (const std::size_t count : {std::size_t{200}, std::size_t{20000}}) {
    HandSettings settings;
    settings.triangles = count;
    EXPECT_EQ(makeHand(settings).triangles.size(), count);
  }
}

TEST(Hand, HasTheAskedLengthAndPointsWithItsIndexFinger) {
  for (const double length : {221.0, 180.0}) {
    HandSettings settings;
    settings.length_mm = length;
    const mesh::TriangleMesh hand = makeHand(settings);
    const auto box = mesh::boundingBox(hand);
    EXPECT_NEAR(box.sizes().y(), length, 0.01 * length);
    const Vec3 tip = indexTip(settings);
    EXPECT_NEAR(tip.y(), box.max().y(), 0.5);
    EXPECT_LT(mesh::NearestTriangle(hand).find(tip).distance, 0.5);
  }
}

TEST(Hand, LeftIsTheMirrorImageOfRight) {
  HandSettings settings;
  const auto& right = defaultHand().positions;
  settings.side = Side::left;
  const auto left = makeHand(settings).positions;
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t v = 0; v < left.size(); ++v) EXPECT_EQ(left[v], Vec3(-right[v].x(), right[v].y(), right[v].z()));
  EXPECT_GT(indexTip(settings).x(), 0.0);
}

TEST(Hand, FewTrianglesStayNearTheFullShape) {
  HandSettings settings;
  settings.triangles = 30000;
  const mesh::TriangleMesh fine = makeHand(settings);
  const mesh::NearestTriangle few(defaultHand());
  double squares = 0.0;
  double worst = 0.0;
  for (const Vec3& p : fine.positions) {
    const double d = few.find(p).distance;
    squares += d * d;
    worst = std::max(worst, d);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(fine.positions.size())), 0.15);
  EXPECT_LT(worst, 0.8);
}

TEST(Hand, RefusesWhatCannotBeBuilt) {
  EXPECT_THROW(makeHand({.triangles = 2801}), Error);
  EXPECT_THROW(makeHand({.triangles = 100}), Error);
  EXPECT_THROW(makeHand({.triangles = 4000000}), Error);
  EXPECT_THROW(makeHand({.length_mm = std::nan("")}), Error);
}

const PalpatingHand& palpatingHand() {
  static const PalpatingHand hand = makePalpatingHand(Side::right);
  return hand;
}

TEST(PalpatingHand, IsAClosedManifoldInOnePiece) {
  support::expectOnePiece(palpatingHand().mesh);
  EXPECT_EQ(palpatingHand().redness.size(), palpatingHand().mesh.positions.size());
}

TEST(PalpatingFinger, IsAClosedManifoldInOnePieceAndSmall) {
  support::expectOnePiece(makePalpatingFinger().mesh);
  EXPECT_EQ(makePalpatingFinger().redness.size(), makePalpatingFinger().mesh.positions.size());
  EXPECT_LE(makePalpatingFinger().mesh.triangles.size(), 1000u) << "it is drawn where a hand is too much";
}

TEST(PalpatingHand, HasAForearmAsLongAsItSays) {
  const PalpatingHand& hand = palpatingHand();
  double farthest = 0.0;
  for (const Vec3& p : hand.mesh.positions) farthest = std::max(farthest, hand.forearm.dot(p));
  EXPECT_NEAR(farthest, hand.forearm_mm, 1.0);
  EXPECT_GT(hand.forearm.z(), 0.2) << "the wrist is bent back";
}

TEST(PalpatingHand, HasNailsOnItsSkinAndAPadUnderIt) {
  const PalpatingHand& hand = palpatingHand();
  const mesh::NearestTriangle skin(hand.mesh);
  for (const Nail& nail : hand.nails) {
    EXPECT_LT(skin.find(nail.centre).distance, 3.3);
    EXPECT_NEAR(nail.along.dot(nail.across), 0.0, 1e-9);
    EXPECT_NEAR(nail.along.dot(nail.up), 0.0, 1e-9);
  }
  EXPECT_GT(skin.find(hand.pad).distance, 2.0);
  EXPECT_LT(skin.find(hand.pad).distance, 8.0);
  EXPECT_LT(hand.pad_along.z(), -0.3) << "the index finger is bent down";
}

TEST(PalpatingHand, LeftIsTheMirrorImageOfRight) {
  const PalpatingHand left = makePalpatingHand(Side::left);
  const auto& right = palpatingHand().mesh.positions;
  ASSERT_EQ(left.mesh.positions.size(), right.size());
  for (std::size_t v = 0; v < right.size(); ++v) {
    EXPECT_EQ(left.mesh.positions[v], Vec3(-right[v].x(), right[v].y(), right[v].z()));
  }
  EXPECT_EQ(left.pad.x(), -palpatingHand().pad.x());
}

}  // namespace
}  // namespace palpate::body
