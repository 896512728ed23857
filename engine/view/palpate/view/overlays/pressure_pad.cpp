// The finger's place is mapped to rest first, where the lumps are; the grid of taxels is cast onto the skin at rest and
// follows it, so that it is in the dent. Each picture.
#include "palpate/view/overlays/pressure_pad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/servo/finger_solver.h"
#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/overlays.h"

namespace palpate::view {

namespace {

/// Taxels below this share of the scale stay clear.
constexpr double kFelt = 0.01;
/// On the skin and through the finger, which stays visible where the pressure is low.
constexpr double kLeastOpacity = 0.25;
constexpr double kMaxOpacity = 0.9;
constexpr Paint kPadRimPaint = {kPadPaint[0], kPadPaint[1], kPadPaint[2], 220};

PadReading readingOf(const scene::World& world, const contact::PressureGround& ground, const FingerMark& finger,
                     double lift_mm) {
  contact::FingerOutput felt = finger.contact;
  if (world.breath) felt = servo::atRest(*world.breath, felt, lift_mm);
  PadReading reading{.pad = finger.pad, .kpa = {}, .colour = finger.colour};
  reading.kpa.resize(finger.pad.taxels * finger.pad.taxels);
  contact::pressureField(ground, world.surface.lumps.get(), felt, finger.pad, reading.kpa);
  reading.greatest_kpa = *std::max_element(reading.kpa.begin(), reading.kpa.end());
  reading.touches = felt.touch != contact::Touch::free;
  reading.middle = felt.proxy;
  reading.normal = felt.normal;
  return reading;
}

/// The corners of the taxels on the skin, rows from the head down; empty off the skin.
std::vector<std::optional<Vec3>> cornersOn(const PadReading& reading, const scene::World& world,
                                           const DrawnSkin& skin) {
  constexpr double kOutsideMm = 15.0;  // search range for the skin
  const contact::PadPlane plane = contact::padPlane(reading.normal);
  const std::size_t n = reading.pad.taxels;
  const double taxel_mm = reading.pad.size_mm / static_cast<double>(n);
  std::vector<std::optional<Vec3>> corners;
  for (std::size_t row = 0; row <= n; ++row) {
    for (std::size_t column = 0; column <= n; ++column) {
      const double u = taxel_mm * static_cast<double>(column) - 0.5 * reading.pad.size_mm;
      const double v = 0.5 * reading.pad.size_mm - taxel_mm * static_cast<double>(row);
      const Vec3 flat = reading.middle + u * plane.u + v * plane.v;
      const Vec3 out = kOutsideMm * reading.normal;
      const auto spot = spotBetween(world.surface, flat + out, flat - out);
      corners.push_back(spot ? std::optional(placeOf(*spot, skin)) : std::nullopt);
    }
  }
  return corners;
}

}  // namespace

PadReader::PadReader(const scene::World& world) : world_(world) {
  if (!world.healthy) {
    missing_ = "the pressure under a finger is not known here";
    return;
  }
  try {
    ground_ = scene::pressureGround(world);
  } catch (const Error& error) {
    missing_ = error.what();
  }
}

std::vector<PadReading> PadReader::read(std::span<const FingerMark> fingers, double lift_mm) const {
  std::vector<PadReading> readings;
  if (!ground_) return readings;
  for (const FingerMark& finger : fingers) readings.push_back(readingOf(world_, *ground_, finger, lift_mm));
  return readings;
}

double padScaleTop(std::span<const PadReading> readings) {
  constexpr double kLeastKpa = 5.0;
  double greatest = kLeastKpa;
  for (const PadReading& reading : readings) greatest = std::max(greatest, reading.greatest_kpa);
  return roundStepUp(greatest);
}

ColourBytes heatColour(double share) {
  constexpr std::array<std::array<double, 3>, 6> kKnots = {
      {{8, 5, 30}, {74, 12, 107}, {164, 44, 96}, {229, 92, 48}, {252, 165, 10}, {252, 255, 164}}};
  constexpr double kPieces = kKnots.size() - 1;
  const double at = kPieces * std::clamp(share, 0.0, 1.0);
  const auto piece = std::min(static_cast<std::size_t>(at), kKnots.size() - 2);
  ColourBytes bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double value = std::lerp(kKnots[piece][i], kKnots[piece + 1][i], at - static_cast<double>(piece));
    bytes[i] = static_cast<std::uint8_t>(std::lround(value));
  }
  return bytes;
}

void addPad(const PadReading& reading, double top_kpa, const scene::World& world, const DrawnSkin& skin,
            Patches& patches, Lines& lines) {
  if (!reading.touches) return;
  const auto corners = cornersOn(reading, world, skin);
  const std::size_t n = reading.pad.taxels;
  const auto edge = [&](std::size_t from, std::size_t to) {
    if (corners[from] && corners[to]) lines.add(*corners[from], *corners[to], kPadRimPaint);
  };
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < n; ++column) {
      const std::size_t first = row * (n + 1) + column;
      const std::array<std::size_t, 4> at = {first, first + 1, first + n + 2, first + n + 1};
      const double share = reading.kpa[row * n + column] / top_kpa;
      const bool whole = std::all_of(at.begin(), at.end(), [&](std::size_t i) { return corners[i].has_value(); });
      if (!whole || share < kFelt) continue;
      const ColourBytes heat = heatColour(share);
      patches.addQuad({*corners[at[0]], *corners[at[1]], *corners[at[2]], *corners[at[3]]},
                      faded({heat[0], heat[1], heat[2], 255}, std::lerp(kLeastOpacity, kMaxOpacity, std::sqrt(share))));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    edge(i, i + 1);
    edge(n * (n + 1) + i, n * (n + 1) + i + 1);
    edge(i * (n + 1), (i + 1) * (n + 1));
    edge(i * (n + 1) + n, (i + 1) * (n + 1) + n);
  }
}

}  // namespace palpate::view
