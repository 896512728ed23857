// A table look-up for each lump within reach. Called by felt_force.cpp in every tick of a world that has lumps.
#include "palpate/contact/lump_force.h"

#include <algorithm>
#include <cmath>

namespace palpate::contact {

namespace {

/// Nearer than this to the axis, mm, the direction away from it is undefined; the push sideways is 0 there.
constexpr double kOnAxisMm = 1e-9;

Vec2 lumpPlace(const LumpPlaces* places, std::size_t lump) noexcept {
  return places == nullptr ? Vec2(0.0, 0.0) : places->moved_mm[lump];
}

/// Share of the push felt by a press whose normal leans from the lump's axis: all of it up to 60 degrees, nothing from
/// 90 degrees on. The other side of a finger lies over the same axis and has nothing to do with the lump.
double facing(const Lump& lump, const Vec3& normal) noexcept {
  constexpr double kWhole = 0.5;  // cosine
  const double cosine = normal.dot(lump.axis);
  if (cosine >= kWhole) return 1.0;
  if (!(cosine > 0.0)) return 0.0;
  const double t = cosine / kWhole;
  return t * t * (3.0 - 2.0 * t);
}

/// A press beside a lump, as the lump's energy sees it; a share of 0: out of reach.
struct PressAtLump {
  Vec2 offset = Vec2::Zero();  ///< from the lump to the tip, mm across and up
  double rho_mm = 0.0;
  double share = 0.0;
};

PressAtLump pressAt(const Lump& lump, const Vec2& moved_mm, const LumpPress& press) noexcept {
  PressAtLump at;
  at.offset = fromLump(lump, moved_mm, press.tip);
  const double reach_mm = lump.energy.reachMm();
  const double rho2 = at.offset.squaredNorm();
  if (!(rho2 < reach_mm * reach_mm) || !(press.depth_mm > 0.0)) return at;
  at.rho_mm = std::sqrt(rho2);
  at.share = facing(lump, press.normal);
  return at;
}

/// dE/dq of the fingers' energies at a lump's place, and how steep it may be.
struct Pull {
  Vec2 gradient = Vec2::Zero();
  double slope_n_per_mm = 0.0;
};

Pull computePull(const Lump& lump, const Vec2& moved_mm, std::span<const LumpPress> presses) noexcept {
  Pull pull;
  for (const LumpPress& press : presses) {
    if (!(press.share > 0.0)) continue;
    const PressAtLump at = pressAt(lump, moved_mm, press);
    if (!(at.share > 0.0)) continue;
    const tissue::LumpAnswer answer = lump.energy.at(at.rho_mm, press.depth_mm);
    const double share = press.share * at.share;
    // U depends on the tip's place minus the lump's.
    if (at.rho_mm > kOnAxisMm) pull.gradient -= (share * answer.d_rho / at.rho_mm) * at.offset;
    pull.slope_n_per_mm += share * std::max(0.0, answer.d_rho_rho);
  }
  return pull;
}

/// Where a lump goes in a tick that began at `from`.
Vec2 stepped(const Lump& lump, const Vec2& from, std::span<const LumpPress> presses, double tick_s) noexcept {
  constexpr double kLongestStepMm = 0.5;
  constexpr double kMinDrag = 10.0;  // over a tick, times the steepest slope: the step then lowers the energy
  const LumpMobility& mobility = lump.mobility;
  const Pull pull = computePull(lump, from, presses);
  const Vec2 gradient = pull.gradient + mobility.spring_n_per_mm * from;
  const double size = gradient.norm();
  if (!(size > mobility.friction_n)) return from;
  const double drag = std::max(mobility.drag_n_s_per_mm / tick_s, kMinDrag * lump.energy.steepest().rho);
  const double stiffness = mobility.spring_n_per_mm + drag + pull.slope_n_per_mm;
  const double step_mm = std::min(kLongestStepMm, (size - mobility.friction_n) / stiffness);
  Vec2 to = from - (step_mm / size) * gradient;
  const double distance = to.norm();
  if (distance > mobility.limit_mm) to *= mobility.limit_mm / distance;
  return to;
}

}  // namespace

void setPlane(Lump& lump) noexcept {
  constexpr double kAlong = 0.9;  // of the axis: a plane that looks at the head has no direction towards it
  const Vec3 head = std::abs(lump.axis.y()) < kAlong ? Vec3::UnitY() : Vec3::UnitZ();
  lump.up = (head - head.dot(lump.axis) * lump.axis).normalized();
  lump.across = lump.up.cross(lump.axis);
}

bool Lumps::anyMoves() const noexcept {
  return std::any_of(all.begin(), all.end(), [](const Lump& lump) { return lump.mobility.moves(); });
}

Vec2 fromLump(const Lump& lump, const Vec2& moved_mm, const Vec3& tip) noexcept {
  const Vec3 from_foot = tip - lump.foot;
  return Vec2(from_foot.dot(lump.across), from_foot.dot(lump.up)) - moved_mm;
}

LumpPush lumpPush(const Lumps& lumps, const LumpPlaces* places, const LumpPress& press) noexcept {
  LumpPush push;
  double nearest_mm = 0.0;
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    const Lump& lump = lumps.all[i];
    const PressAtLump at = pressAt(lump, lumpPlace(places, i), press);
    if (!(at.share > 0.0)) continue;
    const tissue::LumpSlopes slopes = lump.energy.slopesAt(at.rho_mm, press.depth_mm);
    push.normal_n += at.share * slopes.d_depth;
    if (at.rho_mm > kOnAxisMm) {
      const Vec2 lateral = (at.share * slopes.d_rho / at.rho_mm) * at.offset;
      push.lateral_n -= lateral.x() * lump.across + lateral.y() * lump.up;
    }
    if (!lump.mobility.moves() || (push.nearest_moving != kNoIndex && at.rho_mm >= nearest_mm)) continue;
    push.nearest_moving = static_cast<Index>(i);
    nearest_mm = at.rho_mm;
  }
  return push;
}

double normalPush(const Lump& lump, const Vec2& moved_mm, const LumpPress& press) noexcept {
  const PressAtLump at = pressAt(lump, moved_mm, press);
  return at.share > 0.0 ? at.share * lump.energy.forceAt(at.rho_mm, press.depth_mm) : 0.0;
}

double lumpEnergy(const Lumps& lumps, const LumpPlaces& places, std::span<const LumpPress> presses) noexcept {
  double energy = 0.0;
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    const Lump& lump = lumps.all[i];
    const Vec2& moved = places.moved_mm[i];
    energy += 0.5 * lump.mobility.spring_n_per_mm * moved.squaredNorm();
    for (const LumpPress& press : presses) {
      const PressAtLump at = pressAt(lump, moved, press);
      if (at.share > 0.0) energy += press.share * at.share * lump.energy.at(at.rho_mm, press.depth_mm).energy_n_mm;
    }
  }
  return energy;
}

void moveLumps(const Lumps& lumps, std::span<const LumpPress> presses, double tick_s, LumpPlaces& places) noexcept {
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    const Lump& lump = lumps.all[i];
    if (lump.mobility.moves()) places.moved_mm[i] = stepped(lump, places.moved_mm[i], presses, tick_s);
  }
}

}  // namespace palpate::contact
