// Synthetic photographs: their truth against other ways to compute it, and against what the pictures show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/random.h"
#include "palpate/measure/synthesis/synthetic_body.h"
#include "palpate/measure/synthesis/synthetic_camera.h"
#include "palpate/measure/synthesis/synthetic_pair.h"
#include "palpate/measure/synthesis/true_field.h"

namespace palpate::measure {
namespace {

/// Small and quick to paint.
CaseRequests smallRequests(double drift_mm = 0.3) { return {.megapixels = 1.0, .drift_mm = drift_mm}; }

SyntheticCase flatCase() {
  SyntheticCase made = drawCase(4, smallRequests());
  made.back = {.flank_mm = 0.0, .sway_mm = 0.0, .blade_mm = 0.0, .furrow_mm = 0.0};
  return made;
}

Vec3 colourAt(const Photograph& picture, int x, int y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) + static_cast<std::size_t>(x));
  return {static_cast<double>(picture.rgb[at]), static_cast<double>(picture.rgb[at + 1]),
          static_cast<double>(picture.rgb[at + 2])};
}

struct SeenMark {
  Vec2 place_px = Vec2::Zero();
  double contrast = 0.0;  ///< between the colours of mark and skin, of 255
};

/// A mark near `guess`: the middle of what differs from the ring of skin about it.
SeenMark seenMark(const Photograph& picture, const Vec2& guess, double radius_px) {
  const int reach = static_cast<int>(2.0 * radius_px);
  const auto x0 = static_cast<int>(std::lround(guess.x()));
  const auto y0 = static_cast<int>(std::lround(guess.y()));
  Vec3 skin = Vec3::Zero();
  Vec3 ink = Vec3::Zero();
  int ring = 0;
  int core = 0;
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      const double distance = (Vec2(x, y) - guess).norm() / radius_px;
      if (distance > 1.6 && distance < 2.0) skin += colourAt(picture, x, y), ++ring;
      if (distance < 0.4) ink += colourAt(picture, x, y), ++core;
    }
  }
  const Vec3 step = ink / core - skin / ring;
  SeenMark seen{.contrast = step.norm()};
  double sum = 0.0;
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      if ((Vec2(x, y) - guess).norm() > 1.6 * radius_px) continue;
      const double share = (colourAt(picture, x, y) - skin / ring).dot(step) / step.squaredNorm();
      const double weight = std::clamp((share - 0.25) / 0.5, 0.0, 1.0);
      seen.place_px += weight * Vec2(x, y);
      sum += weight;
    }
  }
  seen.place_px /= std::max(sum, 1e-9);
  return seen;
}

double nearest(const std::vector<Vec2>& places, const Vec2& place) {
  double least = 1e9;
  for (const Vec2& other : places) least = std::min(least, (other - place).norm());
  return least;
}

struct Spread {
  double mean = 0.0;
  double worst = 0.0;
  std::size_t count = 0;
  void add(double value) {
    mean = (mean * static_cast<double>(count) + value) / static_cast<double>(count + 1);
    worst = std::max(worst, value);
    ++count;
  }
};

/// Length of the surface between two places of one row or of the midline, summed over short pieces.
double lengthAlong(const SyntheticBody& body, const Vec2& from, const Vec2& to) {
  constexpr int kPieces = 4000;
  double length = 0.0;
  Vec3 before = body.placeAt(from);
  for (int i = 1; i <= kPieces; ++i) {
    const Vec3 next = body.placeAt(from + (to - from) * (static_cast<double>(i) / kPieces));
    length += (next - before).norm();
    before = next;
  }
  return length;
}

}  // namespace

TEST(SyntheticBody, TheChartIsArcLengthAlongTheMidlineAndAlongRows) {
  const SyntheticBody body(drawCase(7).back);
  EXPECT_NEAR(lengthAlong(body, {0.0, -180.0}, {0.0, 180.0}), 360.0, 0.05);
  for (const double row : {-150.0, 0.0, 90.0}) {
    EXPECT_NEAR(lengthAlong(body, {0.0, row}, {160.0, row}), 160.0, 0.1) << row;
    EXPECT_NEAR(lengthAlong(body, {-160.0, row}, {0.0, row}), 160.0, 0.1) << row;
  }
}

TEST(SyntheticCamera, SeesAFlatBackAsAPlaneIsSeen) {
  SyntheticCase made = flatCase();
  made.camera = {.distance_mm = 1200.0, .tilt_rad = 0.3};
  const SyntheticTruth truth = computeTruth(made);
  // Tilted to the right by 0.3 and looking at the middle of the back: rotated by hand, divided by the depth.
  const double focal = truth.px_per_mm * 1200.0;
  for (const TrueDot& dot : truth.dots) {
    const double depth = 1200.0 - std::sin(0.3) * dot.skin_mm.x();
    const Vec2 expected(0.5 * (made.width_px - 1) + focal * std::cos(0.3) * dot.skin_mm.x() / depth,
                        0.5 * (made.height_px - 1) - focal * dot.skin_mm.y() / depth);
    EXPECT_NEAR((dot.before_px - expected).norm(), 0.0, 1e-6);
  }
}

TEST(SyntheticCamera, RollTurnsThePictureAndDistortionMovesItsCorner) {
  SyntheticCase made = flatCase();
  made.camera = {.distance_mm = 1200.0, .tilt_rad = 0.0, .roll_rad = 10.0 * kRadPerDeg};
  const Vec2 middle = 0.5 * Vec2(made.width_px - 1, made.height_px - 1);
  const SyntheticTruth rolled = computeTruth(made);
  const TrueDot& dot = rolled.dots.front();
  const Vec2 seen = (dot.before_px - middle) / rolled.px_per_mm;
  EXPECT_NEAR(std::abs(std::remainder(std::atan2(-seen.y(), seen.x()) - std::atan2(dot.skin_mm.y(), dot.skin_mm.x()),
                                      2.0 * std::numbers::pi)),
              10.0 * kRadPerDeg, 1e-9);
  made.camera.distortion = 0.02;
  const SyntheticTruth bent = computeTruth(made);
  const double out = (dot.before_px - middle).norm() / middle.norm();
  EXPECT_NEAR((bent.dots.front().before_px - middle).norm() / (dot.before_px - middle).norm(), 1.0 + 0.02 * out * out,
              1e-9);
}

TEST(SyntheticCamera, HasTheWholeBackInItsFrame) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SyntheticCase made = drawCase(seed);
    const SyntheticTruth truth = computeTruth(made);
    EXPECT_GT(truth.px_per_mm, 2.3) << seed;
    EXPECT_LT(truth.px_per_mm, 3.21) << seed;
    for (const TrueDot& dot : truth.dots) {
      EXPECT_TRUE(dot.before_px.x() > 10.0 && dot.before_px.x() < made.width_px - 10.0) << seed;
      EXPECT_TRUE(dot.before_px.y() > 10.0 && dot.before_px.y() < made.height_px - 10.0) << seed;
    }
  }
}

TEST(SyntheticPair, MarksLieWhereTheTruthSays) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SyntheticCase made = drawCase(seed);
    made.look.noise = 1.0;
    const SyntheticPair pair = renderPair(made);
    Spread before;
    Spread after;
    for (const TrueDot& dot : pair.truth.dots) {
      if (nearest(pair.truth.strays_px, dot.before_px) < 12.0 * pair.truth.px_per_mm) continue;
      const double radius = made.marks.radius_mm * pair.truth.px_per_mm;
      before.add((seenMark(pair.before, dot.before_px, radius).place_px - dot.before_px).norm());
      // Near the tip skin is stretched and in shadow.
      if (dot.covered > 0.0 || (dot.after_px - pair.truth.tip_px).norm() < 50.0 * pair.truth.px_per_mm) continue;
      after.add((seenMark(pair.after, dot.after_px, radius).place_px - dot.after_px).norm());
    }
    EXPECT_GT(before.count, 60u);
    EXPECT_GT(after.count, 40u);
    EXPECT_LT(before.mean, 0.35) << seed;  // px; a ragged mark has no better middle
    EXPECT_LT(before.worst, 2.5) << seed;  // beside a mole
    EXPECT_LT(after.mean, 0.45) << seed;
    EXPECT_LT(after.worst, 2.5) << seed;
  }
}

TEST(SyntheticPair, HidesMarksUnderTheHand) {
  SyntheticCase made = drawCase(3);
  made.press.contact_mm = {0.0, 30.0};
  made.press.drag_rad = 0.5 * std::numbers::pi;  // the hand comes from below, over the dots
  made.press.stick_turn_rad = made.press.arm_turn_rad = 0.0;
  const SyntheticPair pair = renderPair(made);
  int hidden = 0;
  for (const TrueDot& dot : pair.truth.dots) {
    if (dot.covered < 1.0) continue;
    ++hidden;
    EXPECT_LT(seenMark(pair.after, dot.after_px, 4.0 * pair.truth.px_per_mm).contrast,
              0.5 * seenMark(pair.before, dot.before_px, 4.0 * pair.truth.px_per_mm).contrast);
  }
  EXPECT_GT(hidden, 3);
}

TEST(SyntheticPair, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const SyntheticPair first = renderPair(drawCase(5, smallRequests()));
  const SyntheticPair again = renderPair(drawCase(5, smallRequests()));
  EXPECT_EQ(first.before.rgb, again.before.rgb);
  EXPECT_EQ(first.after.rgb, again.after.rgb);
  EXPECT_NE(first.before.rgb, renderPair(drawCase(6, smallRequests())).before.rgb);
  EXPECT_EQ(first.truth.dots.back().after_px, again.truth.dots.back().after_px);
}

TEST(SyntheticPair, WithoutPressAndMotionDiffersByNoiseAlone) {
  SyntheticCase made = drawCase(5, smallRequests(0.0));
  made.press.peak_mm = 0.0;
  made.press.dent_mm = 0.0;
  made.press.stick = false;
  for (const TrueDot& dot : computeTruth(made).dots) EXPECT_EQ(dot.before_px, dot.after_px);
  const Photograph before = renderPicture(made, Moment::before);
  const Photograph after = renderPicture(made, Moment::after);
  double squares = 0.0;
  for (std::size_t i = 0; i < before.rgb.size(); ++i) {
    const double difference = before.rgb[i] - static_cast<double>(after.rgb[i]);
    squares += difference * difference;
  }
  const double sd = std::sqrt(squares / static_cast<double>(before.rgb.size()));
  EXPECT_NEAR(sd, std::sqrt(2.0) * made.look.noise, 0.25 * made.look.noise + 0.4);  // rounding adds to it
}

TEST(SyntheticPair, MayBeBlackAndWhiteOrDark) {
  SyntheticCase made = drawCase(5, smallRequests());
  made.look.grey = true;
  const Photograph grey = renderPicture(made, Moment::before);
  EXPECT_EQ(colourAt(grey, 300, 300).x(), colourAt(grey, 300, 300).z());
  made.look.exposure *= 0.05;
  const Photograph dark = renderPicture(made, Moment::before);
  EXPECT_LT(colourAt(dark, 300, 300).x(), 0.5 * colourAt(grey, 300, 300).x());
}

TEST(SyntheticMotion, MovesTheBodyByTheDriftThatWasAskedFor) {
  Spread sideways;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    sideways.add(std::pow(drawMotion(seed, 0.3).shift_mm.x(), 2));
  }
  EXPECT_NEAR(std::sqrt(sideways.mean), 0.3, 0.03);
  const Vec3 moved = movedBody({100.0, 0.0, 0.0}, {.shift_mm = {1.0, 2.0, 3.0}, .turn_rad = {0.0, 0.0, 0.01}});
  EXPECT_NEAR((moved - Vec3(1.0 + 100.0 * std::cos(0.01), 2.0 + 100.0 * std::sin(0.01), 3.0)).norm(), 0.0, 1e-12);
}

TEST(TrueField, MovesByTheLevelOnItsEllipse) {
  for (const TailFamily family : {TailFamily::compact, TailFamily::long_tail}) {
    Press press{.family = family, .contact_mm = {10.0, -20.0}, .peak_mm = 18.0, .drag_rad = 1.0};
    press.half_major_mm = 90.0;
    press.ratio = 1.5;
    press.direction_rad = -0.4;
    const TrueField field(press);
    const KeyEllipse at_2 = field.ellipseAt(2.0);
    EXPECT_NEAR(at_2.half_major_mm.value, 90.0, 1e-9);
    EXPECT_NEAR(at_2.major_over_minor.value, 1.5, 1e-9);
    EXPECT_NEAR(at_2.direction_deg.value, -0.4 * kDegPerRad, 1e-9);
    for (const double level : {2.0, 4.0}) {
      const KeyEllipse ellipse = field.ellipseAt(level);
      const Vec2 major(std::cos(-0.4), std::sin(-0.4));
      const Vec2 minor(-major.y(), major.x());
      EXPECT_NEAR(field.displacementAt(press.contact_mm + ellipse.half_major_mm.value * major).norm(), level, 1e-9);
      EXPECT_NEAR(field.displacementAt(press.contact_mm - ellipse.half_minor_mm.value * minor).norm(), level, 1e-9);
    }
    EXPECT_NEAR((field.displacementAt(press.contact_mm) - 18.0 * Vec2(std::cos(1.0), std::sin(1.0))).norm(), 0.0, 1e-9);
  }
}

TEST(TrueField, OfAHalfSpaceIsTheSumOfPointForces) {
  Press press{.family = TailFamily::half_space, .peak_mm = 15.0, .drag_rad = 0.0, .half_major_mm = 80.0};
  const TrueField field(press);
  EXPECT_NEAR(field.displacementAt(Vec2(80.0, 0.0)).norm(), 2.0, 1e-6);
  EXPECT_NEAR(field.displacementAt(Vec2(1e-9, 0.0)).x(), 15.0, 1e-4);
  // Cerruti for incompressible tissue, nearly: ux ~ ((1 - nu) + nu cos^2) / r, uy ~ nu cos sin / r, summed over a
  // Gaussian patch of forces. Its width and weight follow from two places; the others are judged.
  const double poisson = 0.48;
  const auto summed = [&](const Vec2& place, double patch) {
    Vec2 moved = Vec2::Zero();
    Random random(3);
    constexpr int kForces = 200000;
    for (int i = 0; i < kForces; ++i) {
      const Vec2 arm = place - patch * random.normal2();
      const double r = arm.norm();
      moved += Vec2(1.0 - poisson + poisson * arm.x() * arm.x() / (r * r), poisson * arm.x() * arm.y() / (r * r)) / r;
    }
    return Vec2(moved / kForces);
  };
  const double weight = 2.0 * 80.0;  // far away along the drag: u r
  const double patch = weight * (1.0 - 0.5 * poisson) * std::sqrt(0.5 * std::numbers::pi) / 15.0;
  const double scale = 2.0 / summed({80.0, 0.0}, patch).x();
  for (const Vec2& place : {Vec2(30.0, 0.0), Vec2(0.0, 40.0), Vec2(25.0, 25.0), Vec2(-60.0, 70.0)}) {
    const Vec2 expected = scale * summed(place, patch);
    EXPECT_NEAR((field.displacementAt(place) - expected).norm(), 0.0, 0.03 * expected.norm() + 0.02)
        << place.transpose();
  }
  const KeyEllipse ellipse = field.ellipseAt(2.0);
  // Along the drag the contour reaches 1 / (1 - nu) times as far as across it, but it is rounder than an ellipse.
  EXPECT_GT(ellipse.major_over_minor.value, 1.55);
  EXPECT_LT(ellipse.major_over_minor.value, 1.92);
  EXPECT_NEAR(ellipse.direction_deg.value, 0.0, 0.1);
}

TEST(TrueField, IsStrongerBehindTheStickWhenAskedFor) {
  Press press{.peak_mm = 15.0, .drag_rad = 0.5 * std::numbers::pi, .half_major_mm = 80.0, .ratio = 1.0};
  press.asymmetry = 0.2;
  const TrueField field(press);
  const double behind = field.displacementAt({0.0, -60.0}).norm();
  const double before = field.displacementAt({0.0, 60.0}).norm();
  EXPECT_NEAR(behind / before, 1.2, 0.04);
}

TEST(SyntheticCase, NeverFoldsTheSkinAndStaysInItsRanges) {
  int compact = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SyntheticCase made = drawCase(seed);
    EXPECT_LE(TrueField(made.press).largestShortening(), 0.7) << seed;
    EXPECT_TRUE(made.press.peak_mm >= 8.0 && made.press.peak_mm <= 25.0);
    EXPECT_TRUE(made.press.half_major_mm >= 50.0 && made.press.half_major_mm <= 130.0);
    EXPECT_TRUE(made.camera.tilt_rad >= 0.0 && made.camera.tilt_rad <= 25.0 * kRadPerDeg);
    EXPECT_TRUE(made.marks.columns >= 9 && made.marks.columns <= 11);
    if (made.press.family == TailFamily::compact) ++compact;
  }
  EXPECT_NEAR(compact, 100, 25);
}

}  // namespace palpate::measure
