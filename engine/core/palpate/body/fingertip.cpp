// A tube of rings along two joints. Half of each ring is the back of the finger and half its pulp, each an ellipse of
// its own height, so that the nail is flat and the pad is round.
//
// Own: dimensions are our choice for an index finger 16 mm wide, set by eye against photographs.
#include <algorithm>
#include <array>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/body/hand.h"

namespace palpate::body {
namespace {

/// A ring of the tube: how far it is from the tip, and its half axes.
struct TipRing {
  double from_tip, half_width, back, pulp;  // mm
};

constexpr std::array<TipRing, 23> kTipRings = {{
    {0.15, 1.3, 0.9, 1.3}, {0.7, 2.8, 2.0, 2.8},  {1.8, 4.5, 3.1, 4.6},   {3.4, 6.0, 4.1, 6.1},   {5.5, 7.1, 4.9, 7.3},
    {8.0, 7.8, 5.5, 7.9},  {11.0, 8.0, 5.9, 8.1}, {14.5, 7.9, 6.3, 7.9},  {18.0, 7.8, 6.7, 7.3},  {21.5, 8.0, 7.2, 6.9},
    {24.5, 8.2, 7.4, 6.9}, {28.0, 8.0, 7.2, 7.2}, {33.0, 7.9, 7.0, 7.7},  {38.0, 8.0, 7.1, 7.8},  {43.0, 8.2, 7.3, 7.8},
    {43.4, 9.4, 8.6, 9.0}, {44.2, 9.9, 9.1, 9.5}, {50.0, 10.1, 9.3, 9.7}, {56.0, 10.2, 9.4, 9.8}, {58.6, 9.9, 9.1, 9.5},
    {60.6, 8.9, 8.2, 8.5}, {62.0, 6.9, 6.3, 6.6}, {62.7, 3.6, 3.3, 3.4},
}};
constexpr Index kTipSectors = 20;
constexpr double kLastJointMm = 24.5;  ///< from the tip
constexpr double kPadMm = 9.0;         ///< the middle of the pad, from the tip
/// The last joint is bent against the one before.
constexpr double kBentRad = 0.24;
constexpr double kSleeveFromMm = 43.2;
constexpr double kSleeveToMm = 64.0;

Vec3 lastJointAlong() { return {0.0, elementary::cos(kBentRad), -elementary::sin(kBentRad)}; }
Vec3 lastJointBack() { return {0.0, elementary::sin(kBentRad), elementary::cos(kBentRad)}; }

/// The middle of a ring, and the way out of the finger's back there. Round the joint the rings turn little by little.
struct TipFrame {
  Vec3 middle, back;
};

TipFrame tipFrameAt(double from_tip) {
  const double before = kLastJointMm - from_tip;  // towards the tip
  const Vec3 middle = before > 0.0 ? Vec3(before * lastJointAlong()) : Vec3(before * Vec3::UnitY());
  constexpr double kTurnMm = 6.0;
  const double share = std::clamp(0.5 + 0.5 * before / kTurnMm, 0.0, 1.0);
  const double bent = share * kBentRad;
  return {middle, {0.0, elementary::sin(bent), elementary::cos(bent)}};
}

mesh::TriangleMesh fingertipMesh() {
  mesh::TriangleMesh mesh;
  mesh.positions.push_back(tipFrameAt(0.0).middle);
  for (const TipRing& ring : kTipRings) {
    const TipFrame frame = tipFrameAt(ring.from_tip);
    for (Index sector = 0; sector < kTipSectors; ++sector) {
      const double angle = 2.0 * std::numbers::pi * sector / kTipSectors;
      const double up = elementary::sin(angle);
      mesh.positions.push_back(frame.middle + ring.half_width * elementary::cos(angle) * Vec3::UnitX() +
                               (up > 0.0 ? ring.back : ring.pulp) * up * frame.back);
    }
  }
  const auto end = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(tipFrameAt(kTipRings.back().from_tip).middle);
  const auto at = [](std::size_t ring, Index sector) {
    return static_cast<Index>(1 + ring * kTipSectors + sector % kTipSectors);
  };
  for (Index sector = 0; sector < kTipSectors; ++sector) {
    mesh.triangles.push_back({0, at(0, sector + 1), at(0, sector)});
    mesh.triangles.push_back({end, at(kTipRings.size() - 1, sector), at(kTipRings.size() - 1, sector + 1)});
    for (std::size_t ring = 0; ring + 1 < kTipRings.size(); ++ring) {
      mesh.triangles.push_back({at(ring, sector), at(ring, sector + 1), at(ring + 1, sector)});
      mesh.triangles.push_back({at(ring, sector + 1), at(ring + 1, sector + 1), at(ring + 1, sector)});
    }
  }
  return mesh;
}

/// Red at the tip and over the joint.
float fingertipRedness(const Vec3& place) {
  constexpr double kTipReachMm = 13.0;
  constexpr double kJointReachMm = 8.0;
  const double from_tip = (place - kLastJointMm * lastJointAlong()).norm() / kTipReachMm;
  const double from_joint = (place - 7.0 * Vec3::UnitZ()).norm() / kJointReachMm;
  return static_cast<float>(0.6 * elementary::exp(-from_tip * from_tip) +
                            0.35 * elementary::exp(-from_joint * from_joint));
}

}  // namespace

PalpatingHand makePalpatingFinger() {
  PalpatingHand finger;
  finger.mesh = fingertipMesh();
  for (const Vec3& place : finger.mesh.positions) finger.redness.push_back(fingertipRedness(place));
  // A missing finger has no nail: it is put far away.
  const Vec3 nowhere = Vec3::Constant(1e4);
  finger.nails.fill({nowhere, Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()});
  finger.nails[1] = {(kLastJointMm - 7.6) * lastJointAlong() + 5.2 * lastJointBack(), 6.6 * lastJointAlong(),
                     5.6 * Vec3::UnitX(), 4.5 * lastJointBack()};
  finger.pad_along = lastJointAlong();
  finger.pad = (kLastJointMm - kPadMm) * finger.pad_along - 8.0 * lastJointBack();
  finger.forearm = -Vec3::UnitY();
  finger.forearm_mm = 1e5;  // no end is near that it could fade to
  finger.band_mm = 0.5 * (kSleeveFromMm + kSleeveToMm) - kLastJointMm;
  finger.band_half_mm = 0.5 * (kSleeveToMm - kSleeveFromMm);
  return finger;
}

}  // namespace palpate::body
