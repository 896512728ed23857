// Two layers are painted, pigment and blood, as the excess over the average; the colour follows from how much each of
// them absorbs of red, green and blue light. Broad variation is noise on a cylinder, so that back and front meet; fine
// variation is noise per pixel; moles, freckles and the like are spots at random places.
//
// The amounts are by eye, against photographs of backs; the ratios of the colours follow the absorption of melanin and
// haemoglobin. Based on: Jacques, "Optical properties of biological tissues: a review", 2013 (melanin falls with the
// wavelength to the power 3.5; blood takes green most); Tsumura et al., "Image-based skin color and texture analysis/
// synthesis by extracting hemoglobin and melanin information in the skin", 2003 (skin as two layers of pigment).
#include "palpate/view/made_skin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "palpate/base/random.h"

namespace palpate::view {

namespace {

constexpr double kPixelsPerMm = 2.0;
constexpr double kMaxPixels = 4096.0;
/// Broad variation is computed once in this many pixels and joined by straight lines.
constexpr int kCoarse = 8;

/// Absorption per unit of each: red, green, blue.
const Vec3 kPigment(0.60, 0.95, 1.45);
const Vec3 kBlood(0.10, 0.75, 0.55);

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double bell(double x) { return std::exp(-x * x); }

struct Layers {
  double pigment = 0.0;
  double blood = 0.0;
};

struct Spot {
  Vec2 at = Vec2::Zero();  ///< mm, across the whole picture and up
  double radius_mm = 1.0;
  double softness = 0.5;  ///< share of the radius over which it fades
  Layers more = {};
};

class Painter {
 public:
  explicit Painter(const scene::MadeSkin& made)
      : made_(made),
        wide_mm_(2.0 * made.size_mm.x()),
        high_mm_(made.size_mm.y()),
        pixels_per_mm_(std::min(kPixelsPerMm, kMaxPixels / std::max(wide_mm_, high_mm_))),
        random_(made.seed) {
    for (int axis = 0; axis < 3; ++axis) shift_[axis] = random_.uniform(0.0, 1000.0);
    width_ = std::max(2, static_cast<int>(wide_mm_ * pixels_per_mm_));
    height_ = std::max(2, static_cast<int>(high_mm_ * pixels_per_mm_));
    layers_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  }

  Image paint() {
    paintBroad();
    paintFine();
    for (const Spot& spot : spots()) paintSpot(spot);
    return picture();
  }

 private:
  /// The middle of a pixel; rows count from above.
  Vec2 placeOf(double x, double y) const { return {(x + 0.5) / pixels_per_mm_, high_mm_ - (y + 0.5) / pixels_per_mm_}; }
  /// On a cylinder as wide as the body, so that the left edge fits the right one.
  Vec3 onCylinder(const Vec2& place) const {
    const double angle = 2.0 * std::numbers::pi * place.x() / wide_mm_;
    const double radius = 0.5 * wide_mm_ / std::numbers::pi;
    return shift_ + Vec3(radius * std::cos(angle), place.y(), radius * std::sin(angle));
  }
  bool isBack(const Vec2& place) const { return place.x() < made_.size_mm.x(); }

  /// Distance from the line of the spinous processes, mm; and 1 along them, falling to 0 beyond the first and last.
  std::pair<double, double> besideSpine(const Vec2& place) const {
    if (made_.spine_mm.size() < 2 || !isBack(place)) return {1e9, 0.0};
    const auto below = std::find_if(made_.spine_mm.begin() + 1, made_.spine_mm.end() - 1,
                                    [&](const Vec2& tip) { return tip.y() < place.y(); });
    const Vec2 &low = *below, &high = *(below - 1);
    const double share = std::clamp((place.y() - low.y()) / std::max(1e-9, high.y() - low.y()), 0.0, 1.0);
    const double beyond = std::max(made_.spine_mm.back().y() - place.y(), place.y() - made_.spine_mm.front().y());
    return {std::abs(place.x() - (low + share * (high - low)).x()), 1.0 - smoothstep(0.0, 40.0, beyond)};
  }

  /// Sun on neck and shoulders, less of it at the waist; the furrow of the spine; blotches.
  Layers broadAt(const Vec2& place) const {
    const double up = place.y() / high_mm_;
    const Vec3 p = onCylinder(place);
    const auto [beside_mm, along] = besideSpine(place);
    Layers layers;
    layers.pigment = 0.13 * smoothstep(0.55, 1.0, up) - 0.05 * smoothstep(0.45, 0.1, up);
    layers.pigment += 0.07 * noiseAt(p / 55.0) + 0.04 * noiseAt(p / 21.0);
    layers.blood = 0.11 * noiseAt(p / 38.0 + Vec3::Constant(31.0)) + 0.08 * noiseAt(p / 14.0 + Vec3::Constant(57.0));
    layers.pigment += 0.07 * along * bell(beside_mm / 8.0);
    layers.blood += along * (0.16 * bell(beside_mm / 10.0) + 0.09 * bell(beside_mm / 32.0));
    return layers;
  }

  void paintBroad() {
    const int across = width_ / kCoarse + 2, down = height_ / kCoarse + 2;
    std::vector<Layers> coarse(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int j = 0; j < down; ++j) {
      for (int i = 0; i < across; ++i) coarse[indexOf(i, j, across)] = broadAt(placeOf(i * kCoarse, j * kCoarse));
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const int i = x / kCoarse, j = y / kCoarse;
        const double s = static_cast<double>(x % kCoarse) / kCoarse, t = static_cast<double>(y % kCoarse) / kCoarse;
        const auto mixed = [&](double Layers::*part) {
          const auto at = [&](int di, int dj) { return coarse[indexOf(i + di, j + dj, across)].*part; };
          return (1.0 - t) * ((1.0 - s) * at(0, 0) + s * at(1, 0)) + t * ((1.0 - s) * at(0, 1) + s * at(1, 1));
        };
        layers_[indexOf(x, y, width_)] = {mixed(&Layers::pigment), mixed(&Layers::blood)};
      }
    }
  }

  /// The net of small vessels, a few millimetres wide, and the grain of the skin.
  void paintFine() {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Vec3 p = onCylinder(placeOf(x, y));
        Layers& layers = layers_[indexOf(x, y, width_)];
        const double net = 1.0 - 2.0 * std::abs(noiseAt(p / 5.5));
        const double grain = noiseAt(p / 1.3 + Vec3::Constant(7.0));
        layers.blood += 0.045 * net + 0.05 * grain;
        layers.pigment += 0.030 * grain;
      }
    }
  }

  Vec2 anywhere() { return {random_.uniform(0.0, wide_mm_), random_.uniform(0.0, high_mm_)}; }
  /// A size between these, small ones far more often.
  double sized(double least, double most) { return least * std::pow(most / least, std::pow(random_.uniform(), 2.2)); }

  /// Spots of a kind per square decimetre; `make` may reject one.
  template <class Make>
  void addSpots(double per_square_dm, std::vector<Spot>& spots, Make&& make) {
    const double wanted = per_square_dm * 1e-4 * wide_mm_ * high_mm_;
    for (auto left = std::lround(wanted); left > 0; --left) {
      Spot spot{.at = anywhere()};
      if (make(spot)) spots.push_back(spot);
    }
  }

  std::vector<Spot> spots() {
    std::vector<Spot> spots;
    addSpots(1.9, spots, [&](Spot& mole) {
      mole.radius_mm = sized(0.7, 2.6);
      mole.softness = random_.uniform(0.5, 1.0);
      mole.more = {random_.uniform(0.55, 1.7), random_.uniform(0.0, 0.5)};
      return true;
    });
    addSpots(45.0, spots, [&](Spot& freckle) {  // where the sun was
      const double sun = smoothstep(0.45, 1.0, freckle.at.y() / high_mm_);
      freckle.radius_mm = sized(0.6, 1.9);
      freckle.softness = 0.9;
      freckle.more = {random_.uniform(0.10, 0.45), 0.0};
      return random_.uniform() < sun * sun;
    });
    addSpots(0.7, spots, [&](Spot& pimple) {
      pimple.radius_mm = random_.uniform(0.9, 2.4);
      pimple.softness = 1.0;
      pimple.more = {0.05, random_.uniform(0.25, 0.7)};
      return random_.uniform() < smoothstep(0.3, 0.8, pimple.at.y() / high_mm_);
    });
    addSpots(0.25, spots, [&](Spot& angioma) {
      angioma.radius_mm = sized(0.5, 1.3);
      angioma.softness = 0.4;
      angioma.more = {0.15, random_.uniform(1.2, 2.0)};
      return true;
    });
    return spots;
  }

  /// Round, with an irregular edge. Across the picture's edge it continues at the other one.
  void paintSpot(const Spot& spot) {
    const double reach = 1.35 * spot.radius_mm * pixels_per_mm_ + 1.0;
    const double x0 = spot.at.x() * pixels_per_mm_, y0 = (high_mm_ - spot.at.y()) * pixels_per_mm_;
    for (int y = std::max(0, static_cast<int>(y0 - reach)); y <= std::min(height_ - 1.0, y0 + reach); ++y) {
      for (int x = static_cast<int>(x0 - reach); x <= static_cast<int>(x0 + reach); ++x) {
        const Vec2 off = placeOf(x, y) - spot.at;
        const Vec3 edge(off.x() / spot.radius_mm, off.y() / spot.radius_mm, spot.at.x() + spot.at.y());
        const double away = off.norm() / spot.radius_mm + 0.22 * noiseAt(0.9 * edge);
        const double within = 1.0 - smoothstep(1.0 - spot.softness, 1.0, away);
        Layers& layers = layers_[indexOf((x + width_) % width_, y, width_)];
        layers.pigment += within * spot.more.pigment;
        layers.blood += within * spot.more.blood;
      }
    }
  }

  Image picture() const {
    Image image(width_, height_);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double taken = layers_[i].pigment * kPigment[channel] + layers_[i].blood * kBlood[channel];
        const double linear = std::min(1.0, std::exp(-taken) / double{kMadeSkinWhite});
        const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        image.pixels[i][static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
      }
    }
    return image;
  }

  static std::size_t indexOf(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  const scene::MadeSkin& made_;
  double wide_mm_, high_mm_, pixels_per_mm_;
  Random random_;
  Vec3 shift_;
  int width_ = 0, height_ = 0;
  std::vector<Layers> layers_;
};

}  // namespace

Image paintedSkin(const scene::MadeSkin& made) { return Painter(made).paint(); }

}  // namespace palpate::view
