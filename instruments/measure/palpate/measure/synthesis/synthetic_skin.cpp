#include "palpate/measure/synthesis/synthetic_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "palpate/base/random.h"
#include "palpate/measure/synthesis/synthetic_body.h"

namespace palpate::measure {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

cv::Vec3f linear(double red, double green, double blue) {
  return {static_cast<float>(decodeSrgb(red / 255.0)), static_cast<float>(decodeSrgb(green / 255.0)),
          static_cast<float>(decodeSrgb(blue / 255.0))};
}

/// Smooth noise of variance about 1 with bumps of this size.
cv::Mat makeSmoothNoise(cv::Size size, double bump_texels, Random& random) {
  const cv::Size coarse(static_cast<int>(size.width / bump_texels) + 4,
                        static_cast<int>(size.height / bump_texels) + 4);
  cv::Mat_<float> small(coarse);
  for (float& value : small) value = static_cast<float>(random.uniform(-1.7, 1.7));
  cv::Mat large;
  cv::resize(small, large, size, 0.0, 0.0, cv::INTER_CUBIC);
  return large;
}

/// A place of the back that is not at its very rim.
Vec2 somewhere(Random& random) {
  return {random.uniform(-0.97, 0.97) * kHalfWidthMm, random.uniform(-0.97, 0.97) * kHalfLengthMm};
}

double rise(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Texels around a place, each with its offset from there in mm.
template <class Paint>
void paintAt(cv::Mat& albedo, const SkinTexture& texture, const Vec2& place, double reach_mm, const Paint& paint) {
  const cv::Point2f middle = texture.toTexel(place);
  const auto reach = static_cast<float>(reach_mm * texture.texels_per_mm);
  const int left = std::max(0, static_cast<int>(middle.x - reach));
  const int right = std::min(albedo.cols - 1, static_cast<int>(middle.x + reach) + 1);
  const int top = std::max(0, static_cast<int>(middle.y - reach));
  const int bottom = std::min(albedo.rows - 1, static_cast<int>(middle.y + reach) + 1);
  for (int y = top; y <= bottom; ++y) {
    auto* row = albedo.ptr<cv::Vec3f>(y);
    for (int x = left; x <= right; ++x) {
      paint(row[x], Vec2(x - static_cast<double>(middle.x), static_cast<double>(middle.y) - y) / texture.texels_per_mm);
    }
  }
}

void blendInk(cv::Vec3f& skin, const cv::Vec3f& colour, double opacity) {
  skin += static_cast<float>(opacity) * (colour - skin);
}

/// A closed outline that a hand draws: its radius over the angle, 1 on average.
class RaggedRim {
 public:
  RaggedRim(Random& random, double roughness) {
    for (std::size_t i = 0; i < waves_.size(); ++i) {
      const double size = roughness / std::sqrt(static_cast<double>(i + 2));
      waves_[i] = {size * random.normal(), random.uniform(0.0, kTurn)};
    }
  }
  double at(double angle) const {
    double radius = 1.0;
    for (std::size_t i = 0; i < waves_.size(); ++i) {
      // From two waves on: one would shift the mark.
      radius += waves_[i].size * std::cos(static_cast<double>(i + 2) * angle + waves_[i].phase);
    }
    return radius;
  }

 private:
  struct Wave {
    double size = 0.0;
    double phase = 0.0;
  };
  std::array<Wave, 12> waves_;
};

void paintBlot(cv::Mat& albedo, const SkinTexture& texture, const Vec2& place, double radius, const cv::Vec3f& colour,
               double opacity) {
  paintAt(albedo, texture, place, 1.6 * radius, [&](cv::Vec3f& skin, const Vec2& offset) {
    blendInk(skin, colour, opacity * rise(1.5 * radius, 0.6 * radius, offset.norm()));
  });
}

void paintMolesAndPimples(cv::Mat& albedo, const SkinTexture& texture, const SkinLook& look, Random& random) {
  const cv::Vec3f base = skinColour(look.colour);
  const cv::Vec3f mole = 0.22f * base + 0.5f * linear(70, 40, 25);
  const cv::Vec3f pimple(base[0], 0.55f * base[1], 0.55f * base[2]);
  for (int i = 0; i < look.moles; ++i) {
    const Vec2 place = somewhere(random);
    const double strength = random.uniform(0.6, 0.95);
    paintBlot(albedo, texture, place, random.uniform(0.6, 2.6), mole, strength);
  }
  for (int i = 0; i < look.moles; ++i) {
    const Vec2 place = somewhere(random);
    const double strength = random.uniform(0.3, 0.7);
    paintBlot(albedo, texture, place, random.uniform(0.7, 2.0), pimple, strength);
  }
}

void paintHairs(cv::Mat& albedo, const SkinTexture& texture, const SkinLook& look, Random& random) {
  constexpr int kPieces = 12;
  cv::Mat mask(albedo.size(), CV_8U, cv::Scalar(0));
  constexpr int kShift = 4;
  for (int i = 0; i < look.hairs; ++i) {
    Vec2 place = somewhere(random);
    double angle = random.uniform(0.0, kTurn);
    const double bend = random.uniform(-0.12, 0.12);
    const double step = random.uniform(5.0, 22.0) / kPieces;
    std::vector<cv::Point> line;
    for (int piece = 0; piece < kPieces; ++piece) {
      const cv::Point2f texel = texture.toTexel(place);
      line.emplace_back(cv::saturate_cast<int>(texel.x * (1 << kShift)),
                        cv::saturate_cast<int>(texel.y * (1 << kShift)));
      place += step * Vec2(std::cos(angle), std::sin(angle));
      angle += bend;
    }
    const int thickness = std::max(1, static_cast<int>(std::lround(0.15 * texture.texels_per_mm)));
    cv::polylines(mask, line, false, cv::Scalar(random.uniform(100.0, 200.0)), thickness, cv::LINE_AA, kShift);
  }
  const cv::Vec3f hair = linear(45, 32, 25);
  for (int y = 0; y < albedo.rows; ++y) {
    const auto* covered = mask.ptr<std::uint8_t>(y);
    auto* row = albedo.ptr<cv::Vec3f>(y);
    for (int x = 0; x < albedo.cols; ++x) {
      if (covered[x] != 0) blendInk(row[x], hair, covered[x] / 255.0);
    }
  }
}

cv::Vec3f inkColour(InkColour ink) {
  switch (ink) {
    case InkColour::red:
      return linear(196, 28, 42);
    case InkColour::blue:
      return linear(38, 62, 165);
    case InkColour::green:
      return linear(24, 122, 62);
  }
  return {};
}

/// Ink is darker on dark skin, and never quite even.
void paintInk(cv::Mat& albedo, const SkinTexture& texture, const SyntheticCase& made, const InkMark& mark,
              Random& random, double roughness) {
  const RaggedRim rim(random, roughness);
  const RaggedRim cloud(random, 0.12);
  const cv::Vec3f base = skinColour(made.skin.colour);
  const float shade = 0.45f + 0.55f * std::min(1.0f, base[1] / 0.4f);
  const cv::Vec3f colour = shade * inkColour(made.marks.ink);
  const double opacity = made.marks.opacity * random.uniform(0.93, 1.0);
  paintAt(albedo, texture, mark.skin_mm, 1.8 * mark.radius_mm, [&](cv::Vec3f& skin, const Vec2& offset) {
    const double angle = std::atan2(offset.y(), offset.x());
    const double inside = mark.radius_mm * rim.at(angle) - offset.norm();
    if (inside < -0.3) return;
    const double even = std::min(1.0, 0.92 + 0.08 * cloud.at(3.0 * angle + offset.norm()));
    blendInk(skin, colour, std::min(1.0, opacity * even) * rise(-0.3, 0.3, inside));
  });
}

}  // namespace

double decodeSrgb(double shown) { return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4); }

cv::Vec3f skinColour(int colour) {
  switch (colour) {
    case 0:
      return linear(236, 202, 180);
    case 1:
      return linear(220, 176, 144);
    case 2:
      return linear(182, 132, 98);
    default:
      return linear(122, 84, 62);
  }
}

cv::Point2f SkinTexture::toTexel(const Vec2& skin_mm) const {
  return {static_cast<float>((skin_mm.x() + kHalfWidthMm) * texels_per_mm - 0.5),
          static_cast<float>((kHalfLengthMm - skin_mm.y()) * texels_per_mm - 0.5)};
}

InkMarks makeInkMarks(const DotMarks& marks) {
  Random random(marks.seed);
  InkMarks laid;
  for (int row = 0; row < marks.rows; ++row) {
    for (int column = 0; column < marks.columns; ++column) {
      const Vec2 site = marks.corner_mm + marks.spacing_mm * Vec2(column, row);
      const Vec2 slip = marks.jitter_mm * random.normal2();
      laid.dots.push_back({{column, row}, site + slip, marks.radius_mm * random.uniform(0.9, 1.1)});
    }
  }
  for (int i = 0; i < marks.missing && !laid.dots.empty(); ++i) {
    laid.dots.erase(laid.dots.begin() + static_cast<std::ptrdiff_t>(random.below(laid.dots.size())));
  }
  for (int i = 0; i < marks.strays; ++i) {
    laid.strays.push_back({{}, 0.92 * somewhere(random), marks.radius_mm * random.uniform(0.4, 1.1)});
  }
  return laid;
}

SkinTexture paintSkin(const SyntheticCase& made, const InkMarks& marks, double texels_per_mm) {
  SkinTexture texture;
  texture.texels_per_mm = texels_per_mm;
  const cv::Size size(static_cast<int>(2.0 * kHalfWidthMm * texels_per_mm),
                      static_cast<int>(2.0 * kHalfLengthMm * texels_per_mm));
  Random random(made.skin.seed);
  cv::Mat light(size, CV_32F, cv::Scalar(1.0));
  for (const auto& [bump_mm, strength] : {std::pair(40.0, 0.06), {8.0, 0.035}, {2.0, 0.03}, {0.6, 0.03}}) {
    cv::scaleAdd(makeSmoothNoise(size, bump_mm * texels_per_mm, random), strength, light, light);
  }
  const cv::Mat blotches = makeSmoothNoise(size, 22.0 * texels_per_mm, random);
  const cv::Vec3f base = skinColour(made.skin.colour);
  cv::Mat albedo(size, CV_32FC3);
  for (int y = 0; y < size.height; ++y) {
    const auto* bright = light.ptr<float>(y);
    const auto* blotch = blotches.ptr<float>(y);
    auto* row = albedo.ptr<cv::Vec3f>(y);
    for (int x = 0; x < size.width; ++x) {
      const float red = 0.10f * std::max(0.0f, blotch[x]);
      row[x] = bright[x] * cv::Vec3f(base[0], base[1] * (1.0f - red), base[2] * (1.0f - red));
    }
  }
  paintMolesAndPimples(albedo, texture, made.skin, random);
  Random hand(made.marks.seed ^ 0x5bd1e995ull);
  for (const InkMark& mark : marks.dots) paintInk(albedo, texture, made, mark, hand, 0.07);
  for (const InkMark& mark : marks.strays) paintInk(albedo, texture, made, mark, hand, 0.3);
  paintHairs(albedo, texture, made.skin, random);
  albedo.convertTo(texture.albedo, CV_16U, 65535.0);
  return texture;
}

}  // namespace palpate::measure
