#include "palpate/view/offscreen.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "pictures/read_png.h"
#include "support/temporary_folder.h"

namespace palpate::view {
namespace {

TEST(Target, ComesBackAsItWasDrawn) {
  const OffscreenContext context;
  const Target target(7, 5);
  target.bind();
  glClearColor(0.2f, 0.4f, 0.6f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 4, 1, 1);  // GL counts rows from below
  glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  const Image image = target.read();
  EXPECT_EQ(image.at(0, 0), (Pixel{255, 0, 0}));
  EXPECT_EQ(image.at(6, 4), (Pixel{51, 102, 153}));
}

TEST(Image, SurvivesAPngFile) {
  const support::TemporaryFolder folder;
  Image image(3, 2);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {static_cast<std::uint8_t>(40 * i), 7, static_cast<std::uint8_t>(255 - i)};
  }
  writePng(folder / "a.png", image);
  EXPECT_EQ(support::readPng(folder / "a.png").pixels, image.pixels);
}

}  // namespace
}  // namespace palpate::view
