#include "pictures/image_compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "palpate/base/text.h"
#include "pictures/read_png.h"
#include "support/places.h"

namespace palpate::support {

namespace {

namespace fs = std::filesystem;
using view::Image;
using view::Pixel;

constexpr int kBlock = 16;
constexpr double kUnknownRendererFactor = 10.0;
constexpr const char* kReferenceRenderer = "llvmpipe-22";

/// The renderer in software, with as many threads and as wide vectors everywhere.
class SameRendererEverywhere : public testing::Environment {
  void SetUp() override {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("LP_NUM_THREADS", "2", 1);
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
};
[[maybe_unused]] const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new SameRendererEverywhere);

int distance(const Pixel& a, const Pixel& b) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
  return most;
}

/// From a pixel to the nearest colour around the same place of a picture.
int distanceToNeighbourhood(const Image& image, int x, int y, const Pixel& pixel) {
  int least = 255;
  for (int v = std::max(0, y - 1); v <= std::min(image.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(image.width - 1, x + 1); ++u) {
      least = std::min(least, distance(image.at(u, v), pixel));
    }
  }
  return least;
}

bool isBad(const Image& expected, const Image& actual, int x, int y, const Tolerance& tolerance) {
  if (distance(expected.at(x, y), actual.at(x, y)) <= tolerance.levels) return false;
  if (tolerance.content == Content::smooth) return true;
  // Both ways: what appeared must have been near, and what was there must still be near.
  return distanceToNeighbourhood(expected, x, y, actual.at(x, y)) > tolerance.levels ||
         distanceToNeighbourhood(actual, x, y, expected.at(x, y)) > tolerance.levels;
}

double meanDistance(const Image& expected, const Image& actual) {
  double sum = 0.0;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(expected.pixels[i][c] - actual.pixels[i][c]);
  }
  return sum / (3.0 * static_cast<double>(expected.pixels.size()));
}

void countBad(const Image& expected, const Image& actual, const Tolerance& tolerance, Comparison& result) {
  const int columns = (expected.width + kBlock - 1) / kBlock;
  const int rows = (expected.height + kBlock - 1) / kBlock;
  std::vector<int> blocks(static_cast<std::size_t>(columns) * rows, 0);
  int all = 0;
  for (int y = 0; y < expected.height; ++y) {
    for (int x = 0; x < expected.width; ++x) {
      if (!isBad(expected, actual, x, y, tolerance)) continue;
      ++all;
      ++blocks[static_cast<std::size_t>(y / kBlock) * columns + x / kBlock];
    }
  }
  result.bad_pixels = static_cast<double>(all) / static_cast<double>(expected.pixels.size());
  result.worst_block = static_cast<double>(*std::max_element(blocks.begin(), blocks.end())) / (kBlock * kBlock);
}

Image sideBySide(const Image& a, const Image& b, const Image& c) {
  Image all(a.width + b.width + c.width, std::max({a.height, b.height, c.height}));
  int left = 0;
  for (const Image* one : {&a, &b, &c}) {
    for (int y = 0; y < one->height; ++y) std::copy_n(&one->at(0, y), one->width, &all.at(left, y));
    left += one->width;
  }
  return all;
}

fs::path keptFile(const std::string& renderer, const std::string& name) {
  return support::testData() / "pictures" / renderer / (name + ".png");
}

bool isToBeBlessed(const std::string& name) {
  const char* wanted = std::getenv("PALPATE_BLESS");
  if (wanted == nullptr) return false;
  const auto names = split(wanted, ',');
  return std::find(names.begin(), names.end(), name) != names.end();
}

void bless(const fs::path& file, const Image& actual) {
  const std::string change =
      fs::exists(file) ? "changes: " + compare(support::readPng(file), actual).words() : std::string("is new");
  fs::create_directories(file.parent_path());
  view::writePng(file, actual);
  fmt::print("kept {}: {}\n", file.string(), change);
}

fs::path leaveEvidence(const std::string& name, const Image& expected, const Image& actual) {
  const fs::path folder = support::buildFolder() / "pictures";
  fs::create_directories(folder);
  view::writePng(folder / (name + "_expected.png"), expected);
  view::writePng(folder / (name + "_actual.png"), actual);
  const Image difference = differenceOf(expected, actual);
  view::writePng(folder / (name + "_difference.png"), difference);
  const fs::path all = folder / (name + "_compared.png");
  view::writePng(all, sideBySide(expected, actual, difference));
  return all;
}

}  // namespace

Tolerance Tolerance::times(double factor) const {
  Tolerance wider = *this;
  wider.bad_pixels *= factor;
  wider.mean_levels *= factor;
  wider.bad_in_block = std::min(1.0, bad_in_block * factor);
  return wider;
}

std::string Comparison::words() const {
  return fmt::format("{:.3f} % of the pixels are off, {:.0f} % of the worst block, {:.2f} levels on average",
                     100.0 * bad_pixels, 100.0 * worst_block, mean_levels);
}

Comparison compare(const Image& expected, const Image& actual, const Tolerance& tolerance) {
  Comparison result;
  if (expected.width != actual.width || expected.height != actual.height) return {false, 1.0, 1.0, 255.0};
  countBad(expected, actual, tolerance, result);
  result.mean_levels = meanDistance(expected, actual);
  result.same = result.bad_pixels <= tolerance.bad_pixels && result.worst_block <= tolerance.bad_in_block &&
                result.mean_levels <= tolerance.mean_levels;
  return result;
}

Image differenceOf(const Image& expected, const Image& actual) {
  constexpr int kLouder = 8;
  Image difference(std::min(expected.width, actual.width), std::min(expected.height, actual.height));
  for (int y = 0; y < difference.height; ++y) {
    for (int x = 0; x < difference.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const int off = std::abs(expected.at(x, y)[c] - actual.at(x, y)[c]);
        difference.at(x, y)[c] = static_cast<std::uint8_t>(std::min(255, kLouder * off));
      }
    }
  }
  return difference;
}

void expectPicture(const std::string& name, const Image& actual, const std::string& drawn_by,
                   const Tolerance& tolerance) {
  if (isToBeBlessed(name)) return bless(keptFile(drawn_by, name), actual);
  const bool known = fs::is_directory(keptFile(drawn_by, name).parent_path());
  const fs::path file = keptFile(known ? drawn_by : kReferenceRenderer, name);
  if (!fs::exists(file)) {
    ADD_FAILURE() << "there is no kept picture " << file << "; see "
                  << leaveEvidence(name, Image(actual.width, actual.height), actual);
    return;
  }
  if (!known) fmt::print("no pictures of {} are kept: comparing with {} generously\n", drawn_by, kReferenceRenderer);
  const Image expected = support::readPng(file);
  const Comparison result = compare(expected, actual, known ? tolerance : tolerance.times(kUnknownRendererFactor));
  if (!result.same)
    ADD_FAILURE() << name << ": " << result.words() << "; see " << leaveEvidence(name, expected, actual);
}

}  // namespace palpate::support
