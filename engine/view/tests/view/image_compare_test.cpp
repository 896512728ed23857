#include "pictures/image_compare.h"

#include <gtest/gtest.h>

namespace palpate::support {
namespace {

using view::Image;
using view::Pixel;

constexpr Pixel kGrey{100, 100, 100};
constexpr Pixel kWhite{255, 255, 255};
constexpr Tolerance kSmooth{.content = Content::smooth};

Image grey() { return {480, 270, kGrey}; }

TEST(ImageCompare, ForgivesAFewLevelsInSomePixels) {
  Image other = grey();
  for (std::size_t i = 0; i < 5000; ++i) other.pixels[20 * i] = {103, 97, 100};
  EXPECT_TRUE(compare(grey(), other, kSmooth).same);
}

TEST(ImageCompare, FindsALostLetter) {
  Image written = grey();
  for (int y = 34; y < 46; ++y) {
    for (int x = 66; x < 74; ++x) written.at(x, y) = kWhite;
  }
  const Comparison result = compare(written, grey());
  EXPECT_FALSE(result.same);
  EXPECT_LT(result.bad_pixels, 0.001) << "a limit on all pixels alone would hardly see it";
  EXPECT_GT(result.worst_block, 0.2);
}

TEST(ImageCompare, LetsLinesMoveByAPixelButNothingElse) {
  Image here = grey();
  Image there = grey();
  for (int x = 0; x < 400; ++x) {
    here.at(x, 100) = kWhite;
    there.at(x, 101) = kWhite;
  }
  Tolerance lines;
  lines.mean_levels = 5.0;
  EXPECT_TRUE(compare(here, there, lines).same);
  Tolerance smooth = lines;
  smooth.content = Content::smooth;
  EXPECT_FALSE(compare(here, there, smooth).same);
}

TEST(ImageCompare, FindsAPictureThatIsALittleDarker) {
  EXPECT_FALSE(compare(grey(), Image(480, 270, {99, 99, 99}), kSmooth).same);
}

TEST(ImageCompare, RefusesAnotherSize) { EXPECT_FALSE(compare(grey(), Image(479, 270, kGrey)).same); }

TEST(ImageCompare, ShowsDifferencesLoudly) {
  EXPECT_EQ(differenceOf(grey(), Image(480, 270, {101, 100, 90})).at(7, 7), (Pixel{8, 0, 80}));
}

}  // namespace
}  // namespace palpate::support
