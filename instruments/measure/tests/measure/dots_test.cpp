// Discs painted onto skin: each is found where it was painted, and nothing else is.
#include "palpate/measure/dots.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::measure {
namespace {

struct Colour {
  double red;
  double green;
  double blue;
};

constexpr Colour kSkin{214.0, 170.0, 146.0};
constexpr Colour kRedInk{170.0, 40.0, 50.0};
constexpr Colour kBlueInk{60.0, 70.0, 160.0};
constexpr Colour kMole{110.0, 80.0, 65.0};

Photograph skin(int width = 900, int height = 1100) {
  Photograph picture{.name = "skin", .width_px = width, .height_px = height};
  for (int i = 0; i < width * height; ++i) {
    // Light from the left: a third brighter there.
    const double light = 1.1 - 0.3 * (i % width) / width;
    for (const double channel : {kSkin.red, kSkin.green, kSkin.blue})
      picture.rgb.push_back(static_cast<std::uint8_t>(std::min(255.0, light * channel)));
  }
  return picture;
}

/// With soft rims a pixel wide.
void paint(Photograph& picture, const Vec2& centre, double radius, const Colour& colour) {
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const double cover = std::clamp(radius + 0.5 - (Vec2(x, y) - centre).norm(), 0.0, 1.0);
      if (cover == 0.0) continue;
      std::uint8_t* pixel = &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                                              static_cast<std::size_t>(x))];
      const double ink[] = {colour.red, colour.green, colour.blue};
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((1.0 - cover) * pixel[c] + cover * ink[c]);
    }
  }
}

std::vector<Vec2> paintGrid(Photograph& picture, const Colour& ink) {
  std::vector<Vec2> places;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 7; ++column) {
      places.emplace_back(120.3 + 108.0 * column + 3.0 * row, 130.7 + 110.0 * row);
      paint(picture, places.back(), 13.0, ink);
    }
  }
  return places;
}

/// Distance of the farthest of `places` from the nearest dot found.
double farthestMiss(const FoundDots& found, const std::vector<Vec2>& places) {
  double farthest = 0.0;
  for (const Vec2& place : places) {
    double nearest = 1e9;
    for (const Dot& dot : found.dots) nearest = std::min(nearest, (dot.place_px - place).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(FindDots, FindsEveryDotToATenthOfAPixel) {
  for (const Colour& ink : {kRedInk, kBlueInk}) {
    Photograph picture = skin();
    const std::vector<Vec2> places = paintGrid(picture, ink);
    const FoundDots found = findDots(picture);
    EXPECT_EQ(found.dots.size(), places.size());
    EXPECT_LT(farthestMiss(found, places), 0.1);
    for (const Dot& dot : found.dots) EXPECT_NEAR(dot.area_px, 3.1416 * 13.0 * 13.0, 80.0);
  }
}

TEST(FindDots, LeavesMolesAndMarksOfAnotherPenOut) {
  Photograph picture = skin();
  const std::vector<Vec2> places = paintGrid(picture, kRedInk);
  for (const double x : {170.0, 400.0, 610.0}) paint(picture, {x, 188.0}, 9.0, kMole);
  paint(picture, {500.0, 520.0}, 12.0, kBlueInk);
  const FoundDots found = findDots(picture);
  EXPECT_EQ(found.dots.size(), places.size());
}

TEST(FindDots, LooksForTheInkItIsTold) {
  Photograph red = skin();
  paintGrid(red, kRedInk);
  const Ink ink = findDots(red).ink;
  Photograph mixed = skin();
  paintGrid(mixed, kBlueInk);
  paint(mixed, {175.0, 185.0}, 13.0, kRedInk);
  const FoundDots found = findDots(mixed, ink);
  ASSERT_EQ(found.dots.size(), 1u);
  EXPECT_LT((found.dots.front().place_px - Vec2(175.0, 185.0)).norm(), 0.2);
}

TEST(FindDots, ReducesALargePictureAndCentresInTheWholeOfIt) {
  Photograph picture = skin(2700, 3300);
  std::vector<Vec2> places;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      places.emplace_back(400.25 + 350.0 * column, 420.75 + 380.0 * row);
      paint(picture, places.back(), 40.0, kRedInk);
    }
  }
  const FoundDots found = findDots(picture);
  EXPECT_EQ(found.dots.size(), places.size());
  EXPECT_LT(farthestMiss(found, places), 0.1);
}

TEST(FindDots, FindsNothingOnBareSkinOrInTheDark) {
  EXPECT_LT(findDots(skin()).dots.size(), 5u);
  Photograph dark{.name = "dark", .width_px = 300, .height_px = 300};
  dark.rgb.assign(3u * 300u * 300u, 0);
  EXPECT_TRUE(findDots(dark).dots.empty());
}

}  // namespace
}  // namespace palpate::measure
