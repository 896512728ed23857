// Ink is what differs from the skin around it in hue: the chroma of every pixel less the median of its surroundings.
// The commonest hue among round blobs is the pen's, so that no colour need be named; lightness counts for nothing, so
// shadows and moles drop out. Found on a picture reduced to two megapixels, centred on the full one.
#include "palpate/measure/dots.h"
#include "palpate/base/order_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace palpate::measure {

namespace {

constexpr double kReducedPixels = 2e6;   // more gives no better centres of blobs, only time
constexpr double kWindowShare = 0.12;    // share of the width, for the skin around: must exceed one spacing of the dots
constexpr int kBackgroundReduction = 4;  // a median over so wide a window needs no finer picture
constexpr double kBlurPx = 0.8;          // in the reduced picture: sensor noise
constexpr double kMinChroma = 8.0;       // below it a blot of redness is as strong
constexpr double kChromaNoises = 4.0;    // robust sd's of the chroma
constexpr int kMinBlobPx = 12;           // in the reduced picture
constexpr double kLargestBlobShare = 0.004;  // share of the picture
constexpr double kMinFill = 0.6;             // share of a blob's box: a disc has 0.785
constexpr double kMaxFill = 0.95;
constexpr double kMinAspect = 0.5;
constexpr double kHueKernelRad = 0.15;
constexpr double kSameHueRad = 0.35;  // blobs of the ink, among the first ones
constexpr double kPeakShare = 0.45;   // share of the middle blob's peak: where a dot ends
constexpr double kCrossShare = 0.6;   // another hue than the ink's
constexpr double kMinArea = 0.2;      // share of the middle blob's
constexpr double kMaxArea = 4.0;
// Centring: weights rise from a quarter to three quarters of the way from the skin around to the dot's own peak.
constexpr double kRampFrom = 0.25;
constexpr double kRampTo = 0.75;
constexpr int kCentrings = 3;
constexpr double kInsideRadii = 1.35;  // in radii of the dot: the weighed disc
constexpr double kRingRadii = 1.8;     // in radii of the dot: the skin around is between these two

/// Chroma less that of the skin around, and how much the full picture was reduced for it.
struct InkPicture {
  cv::Mat1f a;
  cv::Mat1f b;
  double reduction = 1.0;  // pixels of the full picture a pixel
};

cv::Mat3b asMatrix(const Photograph& picture) {
  // OpenCV wants to write; nothing here does.
  return {picture.height_px, picture.width_px,
          reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(picture.rgb.data()))};  // NOLINT
}

cv::Mat1b background(const cv::Mat1b& channel, int window) {
  cv::Mat1b small;
  cv::resize(channel, small, {}, 1.0 / kBackgroundReduction, 1.0 / kBackgroundReduction, cv::INTER_AREA);
  cv::medianBlur(small, small, window);
  cv::Mat1b wide;
  cv::resize(small, wide, channel.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return wide;
}

cv::Mat1f lessBackground(const cv::Mat1b& channel, int window) {
  cv::Mat1f difference;
  cv::subtract(channel, background(channel, window), difference, cv::noArray(), CV_32F);
  cv::GaussianBlur(difference, difference, {}, kBlurPx);
  return difference;
}

InkPicture makeInkPicture(const Photograph& picture) {
  const cv::Mat3b full = asMatrix(picture);
  const double pixels = static_cast<double>(full.total());
  InkPicture ink;
  cv::Mat reduced = full;
  if (pixels > kReducedPixels) {
    const double scale = std::sqrt(kReducedPixels / pixels);
    cv::resize(full, reduced, {}, scale, scale, cv::INTER_AREA);
    ink.reduction = static_cast<double>(full.cols) / reduced.cols;
  }
  cv::Mat lab;
  cv::cvtColor(reduced, lab, cv::COLOR_RGB2Lab);
  std::array<cv::Mat1b, 3> channels;
  cv::split(lab, channels.data());
  const int window = std::clamp(static_cast<int>(kWindowShare * reduced.cols / kBackgroundReduction) | 1, 3, 255);
  ink.a = lessBackground(channels[1], window);
  ink.b = lessBackground(channels[2], window);
  return ink;
}

/// Robust sd of a channel that is zero but for dots: 1.48 medians of its size.
double robustSd(const cv::Mat1f& channel) {
  constexpr int kStep = 3;  // a ninth of the pixels will do
  std::vector<float> sizes;
  for (int y = 0; y < channel.rows; y += kStep) {
    for (int x = 0; x < channel.cols; x += kStep) sizes.push_back(std::abs(channel(y, x)));
  }
  return 1.4826 * static_cast<double>(upperMedianOf(std::move(sizes)));
}

struct Blob {
  cv::Rect box;
  int label = 0;
  int area = 0;
};

struct Blobs {
  cv::Mat1i labels;
  std::vector<Blob> all;
};

Blobs findBlobs(const cv::Mat1b& mask) {
  Blobs blobs;
  cv::Mat stats;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(mask, blobs.labels, stats, centres, 8, CV_32S);
  for (int i = 1; i < count; ++i) {
    const auto stat = [&](int which) { return stats.at<int>(i, which); };
    blobs.all.push_back(
        {{stat(cv::CC_STAT_LEFT), stat(cv::CC_STAT_TOP), stat(cv::CC_STAT_WIDTH), stat(cv::CC_STAT_HEIGHT)},
         i,
         stat(cv::CC_STAT_AREA)});
  }
  return blobs;
}

bool isRound(const Blob& blob) {
  const double fill = static_cast<double>(blob.area) / blob.box.area();
  const double aspect =
      static_cast<double>(std::min(blob.box.width, blob.box.height)) / std::max(blob.box.width, blob.box.height);
  return fill > kMinFill && fill < kMaxFill && aspect > kMinAspect;
}

/// A round blob as the vote for the pen's hue sees it.
struct Sample {
  double hue_rad = 0.0;
  double peak = 0.0;  // greatest chroma
  double weight = 0.0;
  double area = 0.0;
};

Sample sampleBlob(const InkPicture& ink, const Blobs& blobs, const Blob& blob) {
  double a = 0.0;
  double b = 0.0;
  Sample sample;
  for (int y = blob.box.y; y < blob.box.br().y; ++y) {
    for (int x = blob.box.x; x < blob.box.br().x; ++x) {
      if (blobs.labels(y, x) != blob.label) continue;
      a += static_cast<double>(ink.a(y, x));
      b += static_cast<double>(ink.b(y, x));
      sample.peak = std::max(sample.peak, static_cast<double>(std::hypot(ink.a(y, x), ink.b(y, x))));
    }
  }
  sample.area = blob.area;
  sample.hue_rad = std::atan2(b, a);
  sample.weight = std::sqrt(sample.area) * std::hypot(a, b) / sample.area;
  return sample;
}

std::vector<Sample> roundSamples(const InkPicture& ink) {
  const double noise = std::hypot(robustSd(ink.a), robustSd(ink.b)) / std::numbers::sqrt2;
  cv::Mat1f chroma;
  cv::magnitude(ink.a, ink.b, chroma);
  const Blobs blobs = findBlobs(chroma > std::max(kMinChroma, kChromaNoises * noise));
  const double largest = kLargestBlobShare * static_cast<double>(chroma.total());
  std::vector<Sample> samples;
  for (const Blob& blob : blobs.all) {
    if (blob.area >= kMinBlobPx && blob.area <= largest && isRound(blob))
      samples.push_back(sampleBlob(ink, blobs, blob));
  }
  return samples;
}

double angleBetween(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)); }

/// The fullest place of the density of hues.
double commonestHue(const std::vector<Sample>& samples) {
  double best = 0.0;
  double best_density = -1.0;
  for (const Sample& centre : samples) {
    double density = 0.0;
    for (const Sample& other : samples) {
      const double apart = angleBetween(centre.hue_rad, other.hue_rad) / kHueKernelRad;
      density += other.weight * std::exp(-0.5 * apart * apart);
    }
    if (density > best_density) {
      best_density = density;
      best = centre.hue_rad;
    }
  }
  return best;
}

/// The ink with the strength that it has in this picture, and the middle area of its blobs (reduced pixels).
struct InkHere {
  Ink ink;
  double area = 0.0;
};

std::optional<InkHere> estimateInk(const std::vector<Sample>& samples, const std::optional<Ink>& known) {
  if (samples.empty()) return {};
  const double hue = known ? known->hue_rad : commonestHue(samples);
  std::vector<float> peaks;
  std::vector<float> areas;
  for (const Sample& sample : samples) {
    if (angleBetween(sample.hue_rad, hue) > kSameHueRad) continue;
    peaks.push_back(static_cast<float>(sample.peak));
    areas.push_back(static_cast<float>(sample.area));
  }
  if (peaks.empty()) return {};
  return InkHere{{hue, static_cast<double>(upperMedianOf(peaks))}, static_cast<double>(upperMedianOf(areas))};
}

/// Strength along the ink's hue for pixels that differ in it, elsewhere 0.
cv::Mat1f alongInk(const InkPicture& picture, const Ink& ink) {
  const auto c = static_cast<float>(std::cos(ink.hue_rad));
  const auto s = static_cast<float>(std::sin(ink.hue_rad));
  const cv::Mat1f along = picture.a * c + picture.b * s;
  const cv::Mat1f across = cv::abs(picture.b * c - picture.a * s);
  cv::Mat1f strength = along.clone();
  strength.setTo(0.0f, across > kCrossShare * along);
  return strength;
}

/// A dot while it is centred: in pixels of the full picture.
struct Disc {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
  double area = 0.0;
};

/// Ink along the hue in a piece of the full picture.
cv::Mat1f inkIn(const cv::Mat3b& picture, const cv::Rect& box, double hue_rad) {
  cv::Mat lab;
  cv::cvtColor(picture(box), lab, cv::COLOR_RGB2Lab);
  std::array<cv::Mat, 3> channels;
  cv::split(lab, channels.data());
  cv::Mat1f along;
  cv::addWeighted(channels[1], std::cos(hue_rad), channels[2], std::sin(hue_rad), 0.0, along, CV_32F);
  return along;
}

struct Levels {
  double skin = 0.0;
  double peak = 0.0;
};

/// The skin around as the ring's median, the dot's own strength as the upper tenth of the pixels within it.
std::optional<Levels> measureLevels(const cv::Mat1f& ink, const Vec2& centre, double radius) {
  std::vector<float> ring;
  std::vector<float> inside;
  for (int y = 0; y < ink.rows; ++y) {
    for (int x = 0; x < ink.cols; ++x) {
      const double r = (Vec2(x, y) - centre).norm() / radius;
      if (r < 1.0) inside.push_back(ink(y, x));
      if (r > kInsideRadii && r < kRingRadii) ring.push_back(ink(y, x));
    }
  }
  if (ring.size() < 8 || inside.size() < 4) return {};
  const auto tenth = inside.begin() + static_cast<std::ptrdiff_t>(inside.size() * 9 / 10);
  std::nth_element(inside.begin(), tenth, inside.end());
  const Levels levels{static_cast<double>(upperMedianOf(std::move(ring))), static_cast<double>(*tenth)};
  return levels.peak > levels.skin + 1.0 ? std::optional(levels) : std::nullopt;
}

/// One step of centring: the weighed mean of the inked pixels, and the inked area.
void centre(const cv::Mat1f& ink, const Levels& levels, Vec2& place, double radius, double& area) {
  const double from = levels.skin + kRampFrom * (levels.peak - levels.skin);
  const double width = (kRampTo - kRampFrom) * (levels.peak - levels.skin);
  Vec2 sum = Vec2::Zero();
  double weights = 0.0;
  for (int y = 0; y < ink.rows; ++y) {
    for (int x = 0; x < ink.cols; ++x) {
      if ((Vec2(x, y) - place).squaredNorm() > kInsideRadii * kInsideRadii * radius * radius) continue;
      const double weight = std::clamp((static_cast<double>(ink(y, x)) - from) / width, 0.0, 1.0);
      sum += weight * Vec2(x, y);
      weights += weight;
    }
  }
  if (weights <= 0.0) return;
  place = sum / weights;
  area = weights;
}

void centreFinely(const cv::Mat3b& picture, double hue_rad, Disc& disc) {
  const double reach = kRingRadii * disc.radius + 2.0;
  const cv::Rect wanted(static_cast<int>(std::floor(disc.centre.x() - reach)),
                        static_cast<int>(std::floor(disc.centre.y() - reach)), static_cast<int>(2.0 * reach) + 2,
                        static_cast<int>(2.0 * reach) + 2);
  const cv::Rect box = wanted & cv::Rect(0, 0, picture.cols, picture.rows);
  if (box.width < 3 || box.height < 3) return;
  const cv::Mat1f ink = inkIn(picture, box, hue_rad);
  const Vec2 corner(box.x, box.y);
  Vec2 place = disc.centre - corner;
  const std::optional<Levels> levels = measureLevels(ink, place, disc.radius);
  if (!levels) return;
  for (int i = 0; i < kCentrings; ++i) centre(ink, *levels, place, disc.radius, disc.area);
  disc.centre = corner + place;
}

Disc measureDisc(const Blobs& blobs, const Blob& blob, double reduction) {
  Vec2 sum = Vec2::Zero();
  for (int y = blob.box.y; y < blob.box.br().y; ++y) {
    for (int x = blob.box.x; x < blob.box.br().x; ++x) {
      if (blobs.labels(y, x) == blob.label) sum += Vec2(x, y);
    }
  }
  const Vec2 centre = sum / blob.area;
  Disc disc;
  disc.centre = (centre + Vec2::Constant(0.5)) * reduction - Vec2::Constant(0.5);
  disc.area = blob.area * reduction * reduction;
  disc.radius = std::sqrt(disc.area / std::numbers::pi);
  return disc;
}

}  // namespace

FoundDots findDots(const Photograph& picture, const std::optional<Ink>& known) {
  FoundDots found;
  if (known) found.ink = *known;
  const InkPicture ink_picture = makeInkPicture(picture);
  const std::optional<InkHere> here = estimateInk(roundSamples(ink_picture), known);
  if (!here) return found;
  found.ink = here->ink;
  const Blobs blobs = findBlobs(alongInk(ink_picture, here->ink) > kPeakShare * here->ink.peak_chroma);
  std::vector<float> areas;
  for (const Blob& blob : blobs.all) {
    if (blob.area >= kMinBlobPx && isRound(blob)) areas.push_back(static_cast<float>(blob.area));
  }
  const double area = areas.empty() ? here->area : static_cast<double>(upperMedianOf(areas));
  const cv::Mat3b full = asMatrix(picture);
  for (const Blob& blob : blobs.all) {
    if (blob.area < kMinArea * area || blob.area > kMaxArea * area || blob.area < kMinBlobPx / 2) continue;
    Disc disc = measureDisc(blobs, blob, ink_picture.reduction);
    centreFinely(full, here->ink.hue_rad, disc);
    found.dots.push_back({disc.centre, disc.area});
  }
  return found;
}

}  // namespace palpate::measure
