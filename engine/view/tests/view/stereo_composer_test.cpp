#include "palpate/view/layers/stereo_composer.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "palpate/view/offscreen.h"

namespace palpate::view {
namespace {

constexpr int kSmallWidth = 24;
constexpr int kSmallHeight = 12;

using PixelAt = std::function<Pixel(int x, int y)>;

/// Fills the target pixel by pixel; y counts from the top.
void fill(const Target& target, const PixelAt& colour) {
  target.bind();
  glEnable(GL_SCISSOR_TEST);
  for (int y = 0; y < target.height(); ++y) {
    for (int x = 0; x < target.width(); ++x) {
      const Pixel p = colour(x, y);
      glScissor(x, target.height() - 1 - y, 1, 1);
      glClearColor(p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f, 1.0f);
      glClear(GL_COLOR_BUFFER_BIT);
    }
  }
  glDisable(GL_SCISSOR_TEST);
}

Image composed(const StereoSettings& settings, const PixelAt& left, const PixelAt& right, int row_height = 1) {
  const OffscreenContext context;
  StereoComposer composer;
  const EyePicture picture = eyePictureIn(settings.mode, kSmallWidth, kSmallHeight);
  fill(composer.eye(Eye::left, picture), left);
  fill(composer.eye(Eye::right, picture), right);
  const Target target(kSmallWidth, kSmallHeight);
  composer.compose(settings, target.framebuffer(), kSmallWidth, kSmallHeight, row_height);
  return target.read();
}

StereoSettings composedAs(StereoMode mode) {
  StereoSettings settings;
  settings.mode = mode;
  return settings;
}

std::uint8_t toByte(int value) { return static_cast<std::uint8_t>(value); }
Pixel leftPixel(int x, int y) { return {toByte(10 * x), toByte(20 * y), 40}; }
Pixel rightPixel(int x, int y) { return {toByte(255 - 10 * x), 90, toByte(15 * y)}; }
Pixel greyPixel(int x, int y) { return {toByte(9 * x + y), toByte(9 * x + y), toByte(9 * x + y)}; }

double linear(double byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double encoded(double c) {
  c = std::min(1.0, std::max(0.0, c));
  return 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055);
}

TEST(StereoComposer, PutsTheEyesBesideEachOther) {
  const Image image = composed(composedAs(StereoMode::sbs_half), leftPixel, rightPixel);
  EXPECT_EQ(image.at(3, 5), leftPixel(3, 5));
  EXPECT_EQ(image.at(12 + 3, 5), rightPixel(3, 5));
  const Image cross = composed(composedAs(StereoMode::sbs_cross), leftPixel, rightPixel);
  EXPECT_EQ(cross.at(3, 5), rightPixel(3, 5));
  EXPECT_EQ(cross.at(12 + 3, 5), leftPixel(3, 5));
}

TEST(StereoComposer, PutsTheLeftEyeOnTop) {
  const Image image = composed(composedAs(StereoMode::tb_half), leftPixel, rightPixel);
  EXPECT_EQ(image.at(3, 2), leftPixel(3, 2));
  EXPECT_EQ(image.at(3, 6 + 2), rightPixel(3, 2));
}

TEST(StereoComposer, InterlacesRowsOfTheEyes) {
  StereoSettings settings = composedAs(StereoMode::interlaced);
  for (const int monitor_row : {0, 7}) {
    settings.monitor_row = monitor_row;
    const Image image = composed(settings, leftPixel, rightPixel);
    for (int y = 0; y < kSmallHeight; ++y) {
      const bool left = (y + monitor_row) % 2 == 0;
      for (int x = 0; x < kSmallWidth; ++x) EXPECT_EQ(image.at(x, y), left ? leftPixel(x, y) : rightPixel(x, y));
    }
  }
}

TEST(StereoComposer, InterlacesWholeRowsOfASupersampledPicture) {
  const Image image = composed(composedAs(StereoMode::interlaced), leftPixel, rightPixel, 2);
  for (int y = 0; y < kSmallHeight; ++y)
    EXPECT_EQ(image.at(5, y), y / 2 % 2 == 0 ? leftPixel(5, y) : rightPixel(5, y)) << y;
}

TEST(StereoComposer, SwapsTheEyesOnRequest) {
  StereoSettings settings = composedAs(StereoMode::interlaced);
  settings.swap_eyes = true;
  EXPECT_EQ(composed(settings, leftPixel, rightPixel).at(4, 0), rightPixel(4, 0));
}

TEST(StereoComposer, KeepsGreyGreyInEveryAnaglyph) {
  for (const auto mode : {StereoMode::anaglyph_grey, StereoMode::anaglyph_dubois, StereoMode::anaglyph_half}) {
    const Image image = composed(composedAs(mode), greyPixel, greyPixel);
    for (int x = 0; x < kSmallWidth; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(image.at(x, 3)[channel], greyPixel(x, 3)[channel], 1)
            << kStereoModeNames[static_cast<std::size_t>(mode)] << " channel " << channel;
      }
    }
  }
}

TEST(StereoComposer, MixesColoursInLinearLight) {
  const Pixel left{200, 60, 40};
  const Pixel right{30, 120, 220};
  const auto same = [](const Pixel& pixel) { return [pixel](int, int) { return pixel; }; };
  const Image half = composed(composedAs(StereoMode::anaglyph_half), same(left), same(right));
  const double luma = 0.2126 * linear(left[0]) + 0.7152 * linear(left[1]) + 0.0722 * linear(left[2]);
  EXPECT_NEAR(half.at(0, 0)[0], encoded(luma), 1.0);
  EXPECT_EQ(half.at(0, 0)[1], right[1]);
  EXPECT_EQ(half.at(0, 0)[2], right[2]);
  const Image dubois = composed(composedAs(StereoMode::anaglyph_dubois), same(left), same(right));
  const double red = 0.437 * linear(left[0]) + 0.449 * linear(left[1]) + 0.164 * linear(left[2]) -
                     0.011 * linear(right[0]) - 0.032 * linear(right[1]) - 0.007 * linear(right[2]);
  EXPECT_NEAR(dubois.at(0, 0)[0], encoded(red), 1.0);
}

}  // namespace
}  // namespace palpate::view
