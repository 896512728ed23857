// Pictures of every kind that people have, and of kinds that they should not have. What a picture must show is told by
// the colours of its corners.
#include "palpate/measure/photograph.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "measure/tests/measure/handmade_pictures.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/measure/pictures/picture_header.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::measure {
namespace {

using PixelColour = std::array<int, 3>;
constexpr PixelColour kRed = {255, 0, 0};
constexpr PixelColour kGreen = {0, 255, 0};
constexpr PixelColour kBlue = {0, 0, 255};
constexpr PixelColour kWhite = {255, 255, 255};

Photograph decodedPicture(const std::string& bytes) { return decodePhotograph(bytesOf(bytes), "it.jpg"); }
std::string pictureRefusal(const std::string& bytes) {
  return support::thrownMessage([&] { decodedPicture(bytes); });
}

PixelColour pixelAt(const Photograph& picture, int x, int y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) + static_cast<std::size_t>(x));
  return {picture.rgb.at(at), picture.rgb.at(at + 1), picture.rgb.at(at + 2)};
}

bool isNear(const PixelColour& a, const PixelColour& b, int tolerance) {
  return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance && std::abs(a[2] - b[2]) <= tolerance;
}

/// The four quarters from the top left, row by row; JPEG is not exact.
::testing::AssertionResult showsQuarters(const Photograph& picture, const std::array<PixelColour, 4>& colours,
                                         int tolerance = 6) {
  if (picture.rgb.size() !=
      std::size_t{3} * static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px)) {
    return ::testing::AssertionFailure() << "size and pixels differ";
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const int x = i % 2 == 0 ? picture.width_px / 4 : 3 * picture.width_px / 4;
    const int y = i < 2 ? picture.height_px / 4 : 3 * picture.height_px / 4;
    const PixelColour seen = pixelAt(picture, x, y);
    if (!isNear(seen, colours[i], tolerance)) {
      return ::testing::AssertionFailure() << "quarter " << i << " is " << seen[0] << ' ' << seen[1] << ' ' << seen[2];
    }
  }
  return ::testing::AssertionSuccess();
}

constexpr std::array<PixelColour, 4> kCard = {kRed, kGreen, kBlue, kWhite};

TEST(Photograph, IsReadFromJpegPngAndTiff) {
  for (const char* extension : {".jpg", ".png", ".tiff"}) {
    const Photograph picture = decodedPicture(coded(testCard(), extension));
    EXPECT_EQ(picture.width_px, 300) << extension;
    EXPECT_EQ(picture.height_px, 220) << extension;
    EXPECT_TRUE(showsQuarters(picture, kCard)) << extension;
    EXPECT_FALSE(picture.taken_at_s) << extension;
    EXPECT_TRUE(picture.notes.empty()) << extension;
  }
}

TEST(Photograph, ProgressiveJpegWithAnythingBehindItsEndIsRead) {
  const std::string jpeg = coded(testCard(), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  EXPECT_TRUE(showsQuarters(decodedPicture(jpeg + "a film that the phone hung on to it"), kCard));
}

/// Where the first row and the first column of what is stored lie, as the standard says it.
struct Held {
  int orientation;
  char row;
  char column;
};
constexpr std::array kHeld = {Held{1, 't', 'l'}, Held{2, 't', 'r'}, Held{3, 'b', 'r'}, Held{4, 'b', 'l'},
                              Held{5, 'l', 't'}, Held{6, 'r', 't'}, Held{7, 'r', 'b'}, Held{8, 'l', 'b'}};

char opposite(char side) { return side == 't' ? 'b' : side == 'b' ? 't' : side == 'l' ? 'r' : 'l'; }
std::size_t cornerIndex(char one, char other) {
  const bool bottom = one == 'b' || other == 'b';
  const bool right = one == 'r' || other == 'r';
  return (bottom ? 2U : 0U) + (right ? 1U : 0U);
}
std::array<PixelColour, 4> cardHeld(const Held& held) {
  std::array<PixelColour, 4> upright;
  upright[cornerIndex(held.row, held.column)] = kRed;
  upright[cornerIndex(held.row, opposite(held.column))] = kGreen;
  upright[cornerIndex(opposite(held.row), held.column)] = kBlue;
  upright[cornerIndex(opposite(held.row), opposite(held.column))] = kWhite;
  return upright;
}

TEST(Photograph, IsTurnedAsItWasHeld) {
  for (const Held& held : kHeld) {
    const std::string exif = exifBytes({.orientation = held.orientation});
    const std::string jpeg = withExif(coded(testCard(), ".jpg"), exif);
    const std::string png = withChunk(coded(testCard(), ".png"), "eXIf", exif);
    const std::string tiff = tiffBytes({.orientation = held.orientation, .pixels = cardPixels()});
    const std::string big_tiff =
        tiffBytes({.big_endian = true, .orientation = held.orientation, .pixels = cardPixels()});
    for (const std::string& bytes : {jpeg, png, tiff, big_tiff}) {
      const Photograph picture = decodedPicture(bytes);
      EXPECT_EQ(picture.width_px, held.orientation < 5 ? 300 : 220) << held.orientation;
      EXPECT_TRUE(showsQuarters(picture, cardHeld(held))) << held.orientation << ' ' << bytes.substr(0, 4);
    }
  }
}

TEST(Photograph, HeldInNoKnownWayStaysAsItIs) {
  EXPECT_TRUE(showsQuarters(decodedPicture(withExif(coded(testCard(), ".jpg"), exifBytes({.orientation = 9}))), kCard));
}

TEST(Photograph, KnowsWhenItWasTaken) {
  // 17 May 2024, 10:20:30 UTC.
  constexpr double kSecond = 1715941230.0;
  const HandmadeExif exif{.made = "2024:05:18 00:00:00", .original = "2024:05:17 10:20:30", .fractions = "25  "};
  EXPECT_DOUBLE_EQ(decodedPicture(withExif(coded(testCard(), ".jpg"), exifBytes(exif))).taken_at_s.value(),
                   kSecond + 0.25);
  EXPECT_DOUBLE_EQ(decodedPicture(withChunk(coded(testCard(), ".png"), "eXIf", exifBytes(exif))).taken_at_s.value(),
                   kSecond + 0.25);
  const HandmadeTiff tiff{.further = {textTag(0x0132, "2024:05:17 10:20:30")}, .pixels = cardPixels()};
  EXPECT_DOUBLE_EQ(decodedPicture(tiffBytes(tiff)).taken_at_s.value(), kSecond);
  const HandmadeExif only_made{.big_endian = false, .made = "2024:05:17 10:20:30"};
  EXPECT_DOUBLE_EQ(decodedPicture(withExif(coded(testCard(), ".jpg"), exifBytes(only_made))).taken_at_s.value(),
                   kSecond);
}

TEST(Photograph, ATimeThatIsNoneIsNotBelieved) {
  for (const char* words : {"0000:00:00 00:00:00", "2024:02:30 10:00:00", "2024:05:17 25:00:00",
                            "    :  :     :  :  ", "2024-05-17 10:20:30", "2024:05:17"}) {
    const std::string exif = exifBytes({.original = words});
    EXPECT_FALSE(decodedPicture(withExif(coded(testCard(), ".jpg"), exif)).taken_at_s) << words;
  }
}

TEST(Photograph, GreyPaletteAndTransparentOnesBecomeThreeChannels) {
  const cv::Mat grey(220, 300, CV_8UC1, cv::Scalar(90));
  for (const char* extension : {".jpg", ".png", ".tiff"}) {
    EXPECT_TRUE(isNear(pixelAt(decodedPicture(coded(grey, extension)), 10, 10), {90, 90, 90}, 1)) << extension;
  }
  cv::Mat see_through(220, 300, CV_8UC4, cv::Scalar(0, 0, 200, 51));  // a fifth of red
  const Photograph picture = decodedPicture(coded(see_through, ".png"));
  EXPECT_TRUE(isNear(pixelAt(picture, 10, 10), {244, 204, 204}, 1));
  EXPECT_EQ(picture.notes, std::vector<std::string>{"transparency, laid over white"});
}

TEST(Photograph, PaletteIsReadWithAndWithoutTransparency) {
  // OpenCV writes no palette: two colours, 300 x 220, each row a filter byte and a byte a pixel, uncompressed deflate.
  std::string rows;
  for (int row = 0; row < 220; ++row) rows += '\0' + std::string(150, '\0') + std::string(150, '\1');
  std::string packed(compressBound(rows.size()), '\0');
  uLongf length = packed.size();
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(rows.data()),
                     rows.size()),
            Z_OK);
  packed.resize(length);
  const std::string frame = number(300, 4, true) + number(220, 4, true) + std::string("\10\3\0\0\0", 5);
  // Chunks are put behind the first: the last comes first.
  std::string png = std::string("\x89PNG\r\n\x1a\n") + std::string(25, ' ');
  const std::string head = std::string("\x89PNG\r\n\x1a\n");
  const auto chunk = [](const std::string& kind, const std::string& data) {
    return withChunk(std::string(33, ' '), kind, data).substr(33);
  };
  const std::string palette = chunk("PLTE", {"\xc8\x64\x32\x0a\x14\x1e", 6});
  const std::string tail = chunk("IDAT", packed) + chunk("IEND", "");
  const Photograph opaque = decodedPicture(head + chunk("IHDR", frame) + palette + tail);
  EXPECT_EQ(pixelAt(opaque, 10, 10), (PixelColour{200, 100, 50}));
  EXPECT_EQ(pixelAt(opaque, 290, 10), (PixelColour{10, 20, 30}));
  const Photograph see_through =
      decodedPicture(head + chunk("IHDR", frame) + palette + chunk("tRNS", std::string(1, '\0')) + tail);
  EXPECT_EQ(pixelAt(see_through, 10, 10), kWhite);
  EXPECT_EQ(pixelAt(see_through, 290, 10), (PixelColour{10, 20, 30}));
}

TEST(Photograph, TransparentTiffIsLaidOverWhite) {
  cv::Mat card = testCard();
  // A fifth opaque: 2, apart from the colours; 1, multiplied into them already.
  const Photograph apart = decodedPicture(tiffBytes({.samples = 4, .extra_samples = 2, .pixels = cardPixels("\x33")}));
  EXPECT_TRUE(showsQuarters(apart, {PixelColour{255, 204, 204}, {204, 255, 204}, {204, 204, 255}, kWhite}, 1));
  std::string pixels;
  for (int i = 0; i < 300 * 220; ++i) pixels += std::string("\x28\0\0\x33", 4);  // 40 of 51
  const Photograph multiplied = decodedPicture(tiffBytes({.samples = 4, .extra_samples = 1, .pixels = pixels}));
  EXPECT_TRUE(isNear(pixelAt(multiplied, 10, 10), {244, 204, 204}, 1));
}

TEST(Photograph, SixteenBitsAreReducedWithANote) {
  cv::Mat deep;
  testCard().convertTo(deep, CV_16U, 257.0);
  for (const char* extension : {".png", ".tiff"}) {
    const Photograph picture = decodedPicture(coded(deep, extension));
    EXPECT_TRUE(showsQuarters(picture, kCard)) << extension;
    EXPECT_EQ(picture.notes, std::vector<std::string>{"16 bits a channel, reduced to 8"}) << extension;
  }
  cv::Mat see_through(220, 300, CV_16UC4, cv::Scalar(0, 0, 51400, 13107));
  EXPECT_TRUE(isNear(pixelAt(decodedPicture(coded(see_through, ".png")), 10, 10), {244, 204, 204}, 1));
}

TEST(Photograph, OfSeveralPagesTheFirstIsTaken) {
  const Photograph picture = decodedPicture(tiffBytes({.has_second_page = true, .pixels = cardPixels()}));
  EXPECT_TRUE(showsQuarters(picture, kCard));
  EXPECT_EQ(picture.notes, std::vector<std::string>{"several pages, of which the first is used"});
}

TEST(Photograph, ACutOffFileIsRefusedWhereverItEnds) {
  const std::string tiff = tiffBytes({.pixels = cardPixels()});
  // Its page stands behind the pixels: what is cut off of it may be tags that nobody needs.
  const std::array files = {coded(testCard(), ".jpg"), coded(testCard(), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
                            coded(testCard(), ".png"), tiff.substr(0, 8 + cardPixels().size() + 60)};
  for (const std::string& file : files) {
    for (std::size_t length = 12; length < file.size(); length += 1 + file.size() / 97) {
      EXPECT_NE(pictureRefusal(file.substr(0, length)), "no error") << length << " of " << file.size();
    }
  }
  EXPECT_EQ(pictureRefusal(files[0].substr(0, files[0].size() / 2)),
            "it.jpg: is cut off: the end of the picture is missing; copy the file again");
  EXPECT_EQ(pictureRefusal(files[2].substr(0, files[2].size() / 2)),
            "it.jpg: is cut off: the end of the picture is missing; copy the file again");
  EXPECT_EQ(pictureRefusal(tiff.substr(0, 5000)), "it.jpg: is cut off, a TIFF without its page; copy the file again");
  // Its page is whole, its pixels are not.
  EXPECT_EQ(pictureRefusal(tiffBytes({.pixels = cardPixels().substr(0, 5000)})),
            "it.jpg: is cut off, with part of the picture missing; copy the file again");
  EXPECT_EQ(pictureRefusal(tiffBytes({.further = {longTag(273, 100, false), longTag(279, 1U << 30, false)}})),
            "it.jpg: is cut off, with part of the picture missing; copy the file again");
}

TEST(Photograph, ADamagedFileIsRefused) {
  std::string png = coded(testCard(), ".png");
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 0x10);
  EXPECT_EQ(pictureRefusal(png), "it.jpg: is damaged (wrong checksum); copy the file again");
  std::string jpeg = coded(testCard(), ".jpg");
  jpeg[2] = 'x';
  EXPECT_EQ(pictureRefusal(jpeg), "it.jpg: is not a JPEG, PNG or TIFF");
  jpeg = coded(testCard(), ".jpg");
  jpeg[20] = 'x';  // where a marker should be
  EXPECT_EQ(pictureRefusal(jpeg), "it.jpg: is damaged: a marker is missing; copy the file again");
}

TEST(Photograph, WhatMovesIsRefused) {
  EXPECT_EQ(pictureRefusal(withChunk(coded(testCard(), ".png"), "acTL", std::string(8, '\1'))),
            "it.jpg: is an animated PNG; save one picture of it as JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal("GIF89a and so on \x21\xff\x0bNETSCAPE2.0 and so on"),
            "it.jpg: is an animated GIF; save one picture of it as JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal("RIFF    WEBPVP8X    \x02"),
            "it.jpg: is an animated WebP; save one picture of it as JPEG, PNG or TIFF");
}

TEST(Photograph, OtherFormatsAreNamed) {
  EXPECT_EQ(pictureRefusal(""), "it.jpg: is empty");
  EXPECT_EQ(pictureRefusal("name,x_mm,y_mm\nP1,0,0\n"),
            "it.jpg: is text, not a picture, despite its name; expected a JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal("RIFF    WEBPVP8 "), "it.jpg: is a WebP picture; save it as JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal(std::string("BM\0\0\0\0", 6)), "it.jpg: is a BMP picture; save it as JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal(std::string("\0\0\0\x18", 4) + "ftypheic"),
            "it.jpg: is a HEIC picture; save it as JPEG, PNG or TIFF (phones: camera format 'most compatible')");
  EXPECT_EQ(pictureRefusal(std::string("\0\0\0\x18", 4) + "ftypcrx "),
            "it.jpg: is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF");
  EXPECT_EQ(pictureRefusal(std::string("\0\1\2\3\4\5", 6)), "it.jpg: is not a JPEG, PNG or TIFF");
}

TEST(Photograph, RawPicturesWithinTiffAreRefused) {
  const std::string raw = "it.jpg: is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF";
  EXPECT_EQ(pictureRefusal(tiffBytes({.further = {longTag(50706, 4, false)}, .pixels = cardPixels()})), raw);
  EXPECT_EQ(pictureRefusal(tiffBytes({.photometric = 32803, .pixels = cardPixels()})), raw);
  EXPECT_EQ(pictureRefusal(tiffBytes({.further = {longTag(254, 1, false)}, .pixels = cardPixels()})), raw);
}

TEST(Photograph, ColoursOfPrintAreRefused) {
  std::string jpeg = coded(testCard(), ".jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  jpeg[frame + 9] = 4;
  EXPECT_EQ(pictureRefusal(jpeg), "it.jpg: is a JPEG in print colours (CMYK); save it in RGB, as cameras do");
  EXPECT_EQ(pictureRefusal(tiffBytes({.samples = 4, .photometric = 5, .pixels = cardPixels("k")})),
            "it.jpg: is a TIFF in print colours (CMYK); save it in RGB, as cameras do");
  EXPECT_EQ(pictureRefusal(tiffBytes({.sample_format = 3, .pixels = cardPixels()})),
            "it.jpg: is a TIFF of signed or fractional 8 bits per channel; save it with 8");
}

TEST(Photograph, AreOfFiftyTwoMillionPixelsAtMostAndTwoHundredASideAtLeast) {
  EXPECT_NO_THROW(checkPictureSize({.width_px = 10'000, .height_px = 5'200}, "it.jpg"));
  EXPECT_THROW(checkPictureSize({.width_px = 10'000, .height_px = 5'201}, "it.jpg"), Error);
  EXPECT_NO_THROW(checkPictureSize({.width_px = 200, .height_px = 200}, "it.jpg"));
  EXPECT_THROW(checkPictureSize({.width_px = 199, .height_px = 200}, "it.jpg"), Error);
  EXPECT_THROW(checkPictureSize({.width_px = 200, .height_px = 199}, "it.jpg"), Error);
}

TEST(Photograph, HugeAndTinyOnesAreRefusedByTheirHeader) {
  std::string png = coded(testCard(), ".png");
  const std::string frame = number(60000, 4, true) + number(60000, 4, true) + png.substr(24, 5);
  const std::string checked = "IHDR" + frame;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  png.replace(12, 21, checked + number(static_cast<std::uint32_t>(sum), 4, true));
  const std::string huge =
      "it.jpg: 60000 x 60000 pixels is more than the maximum of 52 million; make it smaller, 2 megapixels are enough";
  EXPECT_EQ(pictureRefusal(png), huge);
  EXPECT_EQ(pictureRefusal(tiffBytes({.width = 60000, .height = 60000, .pixels = cardPixels()})), huge);
  std::string jpeg = coded(testCard(), ".jpg");
  const std::size_t frame_at = jpeg.find("\xff\xc0");
  jpeg.replace(frame_at + 5, 4, number(60000, 2, true) + number(60000, 2, true));
  EXPECT_EQ(pictureRefusal(jpeg), huge);
  EXPECT_EQ(pictureRefusal(coded(testCard(300, 199), ".png")),
            "it.jpg: 300 x 199 pixels is too small to find dots in; at least 200 x 200 are needed");
}

TEST(Photograph, AJpegOfScansWithoutEndIsRefused) {
  const std::string jpeg = coded(testCard(), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const std::size_t scan = jpeg.rfind("\xff\xda");
  std::string scans;
  for (int i = 0; i < 100; ++i) scans += jpeg.substr(scan, jpeg.size() - 2 - scan);
  EXPECT_EQ(pictureRefusal(jpeg.substr(0, scan) + scans + jpeg.substr(jpeg.size() - 2)),
            "it.jpg: is a JPEG in more than 64 layers; save it again");
}

TEST(Photograph, IsReducedByMeans) {
  Photograph picture = decodedPicture(coded(testCard(), ".png"));
  for (std::size_t i = 0; i < picture.rgb.size(); i += 6)
    picture.rgb[i] = static_cast<std::uint8_t>(255 - picture.rgb[i]);
  const Photograph half = reducedTo(picture, 150);
  EXPECT_EQ(half.width_px, 150);
  EXPECT_EQ(half.height_px, 110);
  // Every other red is turned round.
  EXPECT_TRUE(showsQuarters(half, {PixelColour{128, 0, 0}, {128, 255, 0}, {128, 0, 255}, {128, 255, 255}}, 1));
  EXPECT_EQ(reducedTo(picture, 300).rgb, picture.rgb);
}

TEST(Photograph, IsWrittenAndReadBack) {
  const support::TemporaryFolder folder;
  Photograph picture = decodedPicture(coded(testCard(), ".png"));
  picture.taken_at_s = 1715941230.25;
  writePhotograph(folder / "it.png", picture);
  writePhotograph(folder / "it.jpg", picture);
  writeJpeg(folder / "poor.jpg", picture, 20);
  const Photograph png = readPhotograph(folder / "it.png");
  EXPECT_EQ(png.rgb, picture.rgb);
  EXPECT_EQ(png.name, (folder / "it.png").string());
  EXPECT_DOUBLE_EQ(png.taken_at_s.value(), 1715941230.25);
  const Photograph jpeg = readPhotograph(folder / "it.jpg");
  EXPECT_TRUE(showsQuarters(jpeg, kCard));
  EXPECT_DOUBLE_EQ(jpeg.taken_at_s.value(), 1715941230.25);
  EXPECT_LT(std::filesystem::file_size(folder / "poor.jpg"), std::filesystem::file_size(folder / "it.jpg"));
}

TEST(Photograph, FilesThatCannotBeReadOrWrittenAreNamed) {
  const support::TemporaryFolder folder;
  const Photograph picture = decodedPicture(coded(testCard(), ".png"));
  EXPECT_EQ(support::thrownMessage([&] { readPhotograph(folder / "none.jpg"); }),
            (folder / "none.jpg").string() + ": no such file");
  EXPECT_EQ(support::thrownMessage([&] { writePhotograph(folder / "it.webp", picture); }),
            (folder / "it.webp").string() + ": a photograph's name must end in .png or .jpg");
  writeFile(folder / "text.jpg", "no picture\n");
  EXPECT_EQ(
      support::thrownMessage([&] { readPhotograph(folder / "text.jpg"); }),
      (folder / "text.jpg").string() + ": is text, not a picture, despite its name; expected a JPEG, PNG or TIFF");
}

}  // namespace
}  // namespace palpate::measure
