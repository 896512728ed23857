// An ellipsoid as bands of quads round its axis; the light is part of the paint. Each picture.
#include "palpate/view/overlays/lump_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/scene/lumps_of_body.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/overlays.h"

namespace palpate::view {

namespace {

constexpr int kLumpBands = 12;
constexpr int kLumpSectors = 24;

/// Lit from the viewer's upper left, as the picture's own light.
Paint shaded(const contact::Lump& lump, const Vec3& normal) {
  constexpr double kAmbient = 0.42;
  const Vec3 light = (0.75 * lump.axis + 0.5 * lump.up - 0.43 * lump.across).normalized();
  const double share = kAmbient + (1.0 - kAmbient) * std::max(0.0, normal.dot(light));
  Paint paint = kLumpPaint;
  for (std::size_t i = 0; i < 3; ++i) paint[i] = static_cast<std::uint8_t>(std::lround(share * paint[i]));
  return paint;
}

/// A point of the unit sphere in the lump's frame.
Vec3 onSphere(int band, int sector) {
  const double polar = std::numbers::pi * band / kLumpBands;
  const double round = 2.0 * std::numbers::pi * sector / kLumpSectors;
  return {std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar)};
}

void addLump(const contact::Lump& lump, const Vec3& middle, Patches& solid) {
  const auto& half = lump.shape.half_axes_mm;
  const auto placed = [&](const Vec3& unit) {
    return Vec3(middle + half[0] * unit.x() * lump.across + half[1] * unit.y() * lump.up +
                half[2] * unit.z() * lump.axis);
  };
  const auto paint = [&](const Vec3& unit) {
    const Vec3 normal =
        unit.x() / half[0] * lump.across + unit.y() / half[1] * lump.up + unit.z() / half[2] * lump.axis;
    return shaded(lump, normal.normalized());
  };
  for (int band = 0; band < kLumpBands; ++band) {
    for (int sector = 0; sector < kLumpSectors; ++sector) {
      const std::array<Vec3, 4> at = {onSphere(band, sector), onSphere(band + 1, sector),
                                      onSphere(band + 1, sector + 1), onSphere(band, sector + 1)};
      for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
        solid.points.push_back({placed(at[i]), paint(at[i])});
      }
    }
  }
}

}  // namespace

Vec2 lumpShift(std::size_t lump, std::span<const FingerMark> fingers) {
  for (const FingerMark& finger : fingers) {
    if (finger.contact.lump == lump) return finger.contact.lump_moved_mm;
  }
  return Vec2::Zero();
}

Vec3 lumpCentre(const scene::World& world, std::size_t lump, std::span<const FingerMark> fingers,
                const DrawnSkin& skin) {
  constexpr double kSkinMm = 20.0;  // search range for the skin over a moved lump
  const contact::Lump& placed = world.lumps[lump]->lump;
  const Vec2 moved = lumpShift(lump, fingers);
  const Vec3 foot = placed.foot + moved.x() * placed.across + moved.y() * placed.up;
  const double depth_mm = placed.shape.centreMm();
  const Vec3 out = kSkinMm * placed.axis;
  const auto spot = spotBetween(world.surface, foot + out, foot - out);
  Vec3 down = Vec3::Zero();
  if (spot) {
    Vec3 rest = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      rest += static_cast<double>(spot->weights[i]) * world.deformable->restPlace(spot->vertices[i]);
    }
    down = placeOf(*spot, skin) - rest;
  }
  const double share = std::clamp(1.0 - depth_mm / world.lumps[lump]->thickness_mm, 0.0, 1.0);
  return foot - depth_mm * placed.axis + share * down;
}

void addLumps(const scene::World& world, std::span<const FingerMark> fingers, const DrawnSkin& skin, Patches& solid) {
  for (std::size_t i = 0; i < world.lumps.size(); ++i) {
    addLump(world.lumps[i]->lump, lumpCentre(world, i, fingers, skin), solid);
  }
}

}  // namespace palpate::view
