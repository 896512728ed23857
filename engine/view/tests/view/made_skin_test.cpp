#include "palpate/view/made_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::view {
namespace {

scene::MadeSkin aBack(std::uint64_t seed = 7) {
  return {.seed = seed, .size_mm = {350.0, 400.0}, .spine_mm = {{175.0, 380.0}, {177.0, 200.0}, {175.0, 20.0}}};
}

const Image& backOfSeed7() {
  static const Image image = paintedSkin(aBack());
  return image;
}

double linear(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

using Colour = std::array<double, 3>;

/// The mean factor on the tone within a rectangle of the back, in mm from its lower left corner.
Colour factorIn(const Image& image, const Vec2& low, const Vec2& high) {
  const double per_mm = image.height / 400.0;
  Colour sum{};
  double count = 0.0;
  for (int y = 0; y < image.height; ++y) {
    const double up = 400.0 - (y + 0.5) / per_mm;
    if (up < low.y() || up > high.y()) continue;
    for (int x = static_cast<int>(low.x() * per_mm); x < static_cast<int>(high.x() * per_mm); ++x) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += double{kMadeSkinWhite} * linear(image.at(x, y)[c]);
      count += 1.0;
    }
  }
  for (double& s : sum) s /= count;
  return sum;
}

TEST(PaintedSkin, IsTheSameForASeedAndAnotherForAnother) {
  const Image &once = backOfSeed7(), again = paintedSkin(aBack()), other = paintedSkin(aBack(8));
  EXPECT_EQ(once.width, 1400);
  EXPECT_EQ(once.height, 800);
  EXPECT_EQ(once.pixels, again.pixels);
  EXPECT_NE(once.pixels, other.pixels);
}

TEST(PaintedSkin, ChangesTheToneLittleOnTheWhole) {
  const Colour mean = factorIn(backOfSeed7(), {0.0, 0.0}, {350.0, 400.0});
  for (const double factor : mean) EXPECT_NEAR(factor, 1.0, 0.1);
}

TEST(PaintedSkin, IsRedderInTheFurrowOfTheSpineAndDarkerOnTheShoulders) {
  const Image& image = backOfSeed7();
  const Colour furrow = factorIn(image, {172.0, 60.0}, {180.0, 340.0});
  const Colour beside = factorIn(image, {90.0, 60.0}, {130.0, 340.0});
  EXPECT_GT(furrow[0] / furrow[1], 1.05 * beside[0] / beside[1]);
  const Colour shoulders = factorIn(image, {20.0, 340.0}, {330.0, 395.0});
  const Colour waist = factorIn(image, {20.0, 5.0}, {330.0, 60.0});
  EXPECT_LT(shoulders[2], 0.95 * waist[2]);
}

TEST(PaintedSkin, FitsAtItsEdges) {
  const Image& image = backOfSeed7();
  double across_edge = 0.0, inside = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (std::size_t c = 0; c < 3; ++c) {
      across_edge += std::abs(image.at(0, y)[c] - image.at(image.width - 1, y)[c]);
      inside += std::abs(image.at(700, y)[c] - image.at(701, y)[c]);
    }
  }
  EXPECT_LT(across_edge, 1.5 * inside);
}

/// Some tens of moles: small, far darker than what is around them, and brown (blue light is taken most).
TEST(PaintedSkin, HasMoles) {
  const Image& image = backOfSeed7();
  std::size_t dark = 0, brown = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width / 2; ++x) {
      const Pixel& p = image.at(x, y);
      if (linear(p[1]) * double{kMadeSkinWhite} > 0.45) continue;
      ++dark;
      brown += p[2] < p[1] && p[1] < p[0] ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 100u);
  EXPECT_LT(dark, static_cast<std::size_t>(image.width / 2 * image.height / 100));
  EXPECT_GT(brown, dark * 9 / 10);
}

TEST(PaintedSkin, OfAVastBodyIsStillAPicture) {
  const Image image = paintedSkin({.seed = 1, .size_mm = {9000.0, 300.0}});
  EXPECT_LE(std::max(image.width, image.height), 4096);
  EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * image.height);
}

}  // namespace
}  // namespace palpate::view
