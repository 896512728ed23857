#include "palpate/view/layers/drawing.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "palpate/view/offscreen.h"

namespace palpate::view {
namespace {

constexpr Ink kWhite{{255, 255, 255}};
constexpr Ink kRed{{200, 30, 40}};

Image drawn(int width, int height, double scale, const std::function<void(Drawing&)>& draw) {
  const OffscreenContext context;
  const Target target(width, height);
  target.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  Drawing drawing;
  drawing.begin(Vec2f(width, height) / static_cast<float>(scale), scale);
  draw(drawing);
  drawing.end();
  target.bind();
  drawing.present(width, height);
  return target.read();
}

int brightPixels(const Image& image) {
  return static_cast<int>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](const Pixel& p) { return p[0] > 127; }));
}

TEST(Drawing, FillsABoxExactly) {
  const Image image = drawn(20, 10, 1.0, [](Drawing& page) { page.box(Vec2f(3, 2), Vec2f(8, 6), kRed); });
  EXPECT_EQ(image.at(3, 2), kRed.colour);
  EXPECT_EQ(image.at(7, 5), kRed.colour);
  EXPECT_EQ(image.at(2, 2), (Pixel{0, 0, 0}));
  EXPECT_EQ(image.at(8, 5), (Pixel{0, 0, 0}));
  EXPECT_EQ(image.at(7, 6), (Pixel{0, 0, 0}));
}

TEST(Drawing, WritesTextWhereItSays) {
  float width = 0.0f;
  const Image image = drawn(120, 40, 1.0, [&](Drawing& page) {
    page.text(Vec2f(60, 10), "12.5 mm", kWhite, Align::centre);
    width = page.measure("12.5 mm").x();
  });
  EXPECT_GT(width, 40.0f);
  EXPECT_GT(brightPixels(image), 80);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y)[0] < 128) continue;
      EXPECT_NEAR(x, 60, 0.5f * width + 1.0f);
      EXPECT_TRUE(y >= 10 && y <= 25) << y;
    }
  }
}

TEST(Drawing, LaysOutASupersampledPageAlike) {
  const auto draw = [](Drawing& page) {
    page.text(Vec2f(5, 5), "press", kWhite);
    page.box(Vec2f(10, 30), Vec2f(60, 35), kRed);
  };
  const Image once = drawn(80, 40, 1.0, draw);
  const Image twice = reduced(drawn(160, 80, 2.0, draw), 2);
  EXPECT_EQ(twice.at(59, 34), once.at(59, 34));
  EXPECT_NEAR(brightPixels(once), brightPixels(twice), 0.35 * brightPixels(once));
}

}  // namespace
}  // namespace palpate::view
