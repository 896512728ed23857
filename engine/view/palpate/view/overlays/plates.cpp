// Fourteen places round the point, in order of preference; each is moved onto the page, then rated by the area that it
// shares with other labels. The first that shares nothing wins, else the one that shares least.
#include "palpate/view/overlays/plates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace palpate::view {

namespace {

/// Between the finger and its plate, points: the drawn ball stays free.
constexpr float kBeside = 34.0f;
constexpr float kAbove = 30.0f;

/// A candidate place for the plate, seen from the tip; in order of preference.
struct Direction {
  float x, y;     ///< from the tip to the plate: -1, 0 or 1
  float farther;  ///< factor on the usual distance
};
// clang-format off
constexpr std::array<Direction, 14> kDirections = {{
    {1, -1, 1}, {1, 1, 1}, {-1, -1, 1}, {-1, 1, 1},
    {1, 0, 1}, {-1, 0, 1}, {0, -1, 1}, {0, 1, 1},
    {1, -1, 3}, {1, 1, 3}, {-1, -1, 3}, {-1, 1, 3}, {0, -1, 4}, {0, 1, 4},
}};
// clang-format on

/// From the tip to the plate's upper or left edge, along one axis.
float plateOffset(float direction, float away, float extent) {
  if (direction > 0.0f) return away;
  return direction < 0.0f ? -away - extent : -0.5f * extent;
}

constexpr LabelInks kOnDark{{{250, 250, 250}},       {{20, 20, 24}, 0.72},   {{20, 20, 24}, 0.72},
                            {{255, 255, 255}, 0.14}, {{160, 165, 175}, 1.0}, {{255, 176, 112}}};
constexpr LabelInks kOnLight{{{22, 22, 26}},    {{255, 255, 255}, 0.8}, {{250, 250, 250}, 0.88},
                             {{0, 0, 0}, 0.16}, {{92, 97, 108}, 1.0},   {{170, 66, 0}}};

LabelBox movedOnto(const LabelBox& page, const Vec2f& wanted, const Vec2f& size) {
  const Vec2f last = (page.opposite - size).cwiseMax(page.corner);
  const Vec2f corner = wanted.cwiseMax(page.corner).cwiseMin(last).array().round();
  return {corner, corner + size};
}

}  // namespace

const LabelInks& inksFor(const Look& look) { return look.hasLightGround() ? kOnLight : kOnDark; }

float overlapArea(const LabelBox& a, const LabelBox& b) {
  const Vec2f shared = a.opposite.cwiseMin(b.opposite) - a.corner.cwiseMax(b.corner);
  return std::max(0.0f, shared.x()) * std::max(0.0f, shared.y());
}

LabelBox placePlate(const Vec2f& tip, const Vec2f& size, const LabelBox& page, std::span<const LabelBox> taken) {
  LabelBox best;
  float least = std::numeric_limits<float>::infinity();
  for (const Direction& direction : kDirections) {
    const Vec2f wanted = tip + Vec2f(plateOffset(direction.x, direction.farther * kBeside, size.x()),
                                     plateOffset(direction.y, direction.farther * kAbove, size.y()));
    const LabelBox plate = movedOnto(page, wanted, size);
    float hidden = 0.0f;
    for (const LabelBox& box : taken) hidden += overlapArea(plate, box);
    if (hidden >= least) continue;
    least = hidden;
    best = plate;
    if (hidden == 0.0f) break;
  }
  return best;
}

Vec2f nearestCorner(const LabelBox& plate, const Vec2f& place) {
  const Vec2f middle = 0.5f * (plate.corner + plate.opposite);
  return {place.x() < middle.x() ? plate.corner.x() : plate.opposite.x(),
          place.y() < middle.y() ? plate.corner.y() : plate.opposite.y()};
}

ColourBytes encodedColour(const Vec3f& linear) {
  ColourBytes bytes;
  for (int i = 0; i < 3; ++i) {
    const double c = std::clamp<double>(linear[i], 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
  }
  return bytes;
}

void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, const LabelInks& inks, Align align,
                TextSize size) {
  for (const auto& [x, y] : {std::pair{-1.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, -1.0f}, {0.0f, 1.0f}}) {
    page.text(place + Vec2f(x, y), words, inks.rim, align, size);
  }
  page.text(place, words, inks.letter, align, size);
}

}  // namespace palpate::view
