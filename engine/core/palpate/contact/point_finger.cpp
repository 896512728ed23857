// One tick of a point finger: exact entry, bounded walk to the local minimum, border, exact release.
//
// The tip is free until its path crosses the skin from front to back, exactly (tree/exact_predicates.h). From then
// on the proxy walks on the skin towards the tip, no further in a tick than the path bound, and the tip is released
// when it is in front of the proxy's tangent plane by more than rounding. Nothing here has an absolute length except
// the settings.
//
// Based on: Zilles and Salisbury, "A constraint-based god-object method for haptic display" (1995); Ho et al. (1999)
// for the walk. The walk's proof of not falling through: the proxy never leaves the surface, so only a wrong release
// could free a tip inside; release asks an exact normal and then the segment from proxy to tip. A proxy that is held in
// a pocket, or by the near side of a limb that the tip has passed, needs no rescue: it stays, the depth that is felt
// stays at its most, and the tip is released when it is both too deep for its proxy and out of the body (sides.h).
#include "palpate/contact/press.h"

#include <algorithm>
#include <optional>

#include "palpate/contact/border.h"
#include "palpate/contact/narrow_cracks.h"
#include "palpate/contact/sides.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// Sheets that one tick can land on one after the other, each left at once. Beyond it the last contact is kept: safe.
constexpr int kMaxSheets = 8;

/// Whether a point at `offset` from a place on a face or an edge lies behind the planes of its triangles, and so behind
/// every normal between theirs: what nearly every tick asks, without a root. False also where that is not known.
bool isBehindTriangles(const Surface& surface, const SurfacePoint& place, const Vec3& offset) {
  if (tree::isCorner(place.feature)) return false;
  const auto& records = surface.geometry->tree.records;
  const auto is_behind = [&](Index triangle) {
    const auto& corners = records[triangle].corners;
    return offset.dot(mesh::areaVector2(corners[0], corners[1], corners[2])) <= 0.0;
  };
  if (!is_behind(place.triangle)) return false;
  if (!tree::isEdge(place.feature)) return true;
  const Index across = records[place.triangle].neighbours[tree::indexOf(place.feature)];
  return across == kNoIndex || is_behind(across);
}

/// Walks on one sheet, and over cracks from bank to bank.
WalkResult walkOverCracks(const Surface& surface, const SurfacePoint& from, const Vec3& tip, double path_mm) {
  constexpr int kMaxCracks = 8;  // of one tick
  WalkResult walk = walkOnOneSheet(surface, from, tip, path_mm);
  if (surface.geometry->cracked.empty()) return walk;
  for (int crack = 0; crack < kMaxCracks && walk.finished; ++crack) {
    if (!walk.at_crack && !onBorder(surface, walk.at)) break;
    const std::optional<SurfacePoint> bank = otherBank(surface, walk.at, tip);
    if (!bank) break;
    walk = walkOnOneSheet(surface, *bank, tip, path_mm);
  }
  return walk;
}

/// True when the tip has left the skin at the proxy. While the proxy is still on its way, the tip must have left the
/// skin at the end of the walk, too; only then does the proxy go there. `bank`: at the rim of a crack, its bankNormal.
bool released(const Surface& surface, const WalkResult& walk, const Vec3& bank, const Vec3& tip, FingerState& state) {
  const Vec3 offset = tip - walk.at.position;
  const bool over_crack = walk.at_crack && offset.norm() > crackWidth(*surface.geometry);
  if (!(over_crack ? offset.dot(bank) > releaseSlack(surface) : inFrontOf(surface, walk.at, tip))) return false;
  if (walk.finished) return true;
  const WalkResult end = walkOnOneSheet(surface, walk.at, tip, kUnbounded);
  if (!end.finished || !inFrontOf(surface, end.at, tip)) return false;
  state.proxy = end.at;
  return true;
}

Press pressAt(const Surface& surface, const FingerSettings& settings, const SurfacePoint& proxy, const Vec3& tip) {
  const double beyond = beyondBorder(surface, proxy, tip);
  if (!(beyond > 0.0)) return pressTowards(surface, settings, proxy.position, proxy, tip);
  const Vec3 normal = normalAt(surface, proxy);
  Press press;
  press.touching = true;
  press.proxy = proxy.position;
  press.normal = normal;
  press.depth_mm = std::max(0.0, (proxy.position - tip).dot(normal));
  press.felt_depth_mm = std::min(depthAtBorder(proxy.position, normal, tip, 0.0, beyond), settings.max_depth_mm);
  press.status = kAtBorder;
  return press;
}

/// Replaces what is felt by the smooth stand-in, if there is one. The proxy of the walk stays the state.
void shade(const Surface& surface, const FingerSettings& settings, const SurfacePoint& proxy, const Vec3& tip,
           Press& press) {
  if (!settings.force_shading || press.depth_mm <= 0.0 || (press.status & (kAtBorder | kTooDeep)) != 0) return;
  const std::optional<ShadedProxy> shaded = shadedProxy(surface, proxy, tip);
  if (!shaded) {
    press.status |= kShadingFailed;
    return;
  }
  press.proxy = shaded->position;
  press.normal = shaded->normal;
  press.depth_mm = shaded->depth_mm;
  press.felt_depth_mm = std::min(shaded->depth_mm, settings.max_depth_mm);
}

/// Starts the contact of a free tip that passes the skin, or the mouth of a crack. False when it stays free.
bool landsFromAir(const Surface& surface, const Vec3& tip, FingerState& state) {
  const tree::Crossing entry = tree::firstFrontCrossing(surface.geometry->tree, state.tip, tip);
  const bool cracked = !surface.geometry->cracked.empty();
  const std::optional<SurfacePoint> rim = cracked ? findCrossedRim(surface, state.tip, tip, entry) : std::nullopt;
  if (!rim && entry.triangle == kNoIndex) return false;
  land(rim ? *rim : placeOf(entry), state);
  return true;
}

/// Leaves the proxy's place: lands on the next sheet between it and the tip, or is free. True when it landed.
bool landOnNextSheet(const Surface& surface, const Vec3& tip, FingerState& state) {
  const SurfacePoint left = state.proxy;
  const auto next = firstFrontCrossingIf(surface.geometry->tree, left.position, tip,
                                         [&](Index triangle) { return !hasFeatureAt(surface, triangle, left); });
  state.touching = next.triangle != kNoIndex;
  if (state.touching) land(placeOf(next), state);
  return state.touching;
}

/// In a crease a proxy may be off the edge by rounding only, and the crossing to the other sheet then begins behind it.
/// The tip is inside all the same: it is held by what is nearest.
void holdInside(const Surface& surface, const Vec3& tip, double path_mm, FingerState& state) {
  state.touching = true;
  const tree::NearestPoint nearest = nearestPoint(surface.geometry->tree, tip, path_mm);
  if (nearest.triangle != kNoIndex) state.proxy = {nearest.closest.point, nearest.triangle, nearest.closest.feature};
}

}  // namespace

bool inFrontOf(const Surface& surface, const SurfacePoint& place, const Vec3& tip) noexcept {
  const Vec3 offset = tip - place.position;
  if (isBehindTriangles(surface, place, offset)) return false;
  return offset.dot(normalAt(surface, place)) > releaseSlack(surface);
}

Press pressTowards(const Surface& surface, const FingerSettings& settings, const Vec3& proxy, const SurfacePoint& skin,
                   const Vec3& tip) noexcept {
  Press press;
  press.touching = true;
  press.proxy = proxy;
  const Vec3 out = proxy - tip;
  const double depth = out.norm();
  if (depth > directionlessDepth(surface)) {
    press.normal = out / depth;
    press.depth_mm = depth;
  } else {
    press.normal = normalAt(surface, skin);
  }
  press.felt_depth_mm = std::min(press.depth_mm, settings.max_depth_mm);
  return press;
}

Press pressPoint(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip) noexcept {
  if (!state.touching) {
    if (!landsFromAir(surface, tip, state)) return {};
    noteWhereItComesFrom(surface, state);
  }
  const double path = pathBound(settings, (tip - state.tip).norm());
  const Vec3 held = state.proxy.position;
  Press press;
  for (int sheet = 0; sheet < kMaxSheets; ++sheet) {
    const WalkResult walk = walkOverCracks(surface, state.proxy, tip, path);
    state.proxy = walk.at;
    state.guarded = walk.stopped;
    std::uint32_t status = walk.finished ? 0u : kCatchingUp;
    const Vec3 bank = walk.at_crack ? bankNormal(surface, walk.at) : Vec3(Vec3::Zero());
    bool leaves = released(surface, walk, bank, tip, state);
    const double lag = (walk.at.position - tip).norm();
    if (!leaves && lag > settings.max_depth_mm) {
      status |= kTooDeep;
      if (isOutside(surface, tip, lag)) {
        state.touching = false;
        return {};
      }
    }
    const SurfacePoint& proxy = state.proxy;
    if (!leaves && boundsTwoSectors(surface, proxy) && isInAir(surface, proxy.position, tip, lag, proxy)) {
      state.touching = false;
      return {};
    }
    if (!leaves) {
      press = pressAt(surface, settings, state.proxy, tip);
      press.status |= status;
      press.bank = bank;
      shade(surface, settings, state.proxy, tip, press);
      if (!(press.status & kAtBorder) || press.felt_depth_mm > 0.0) return press;
    }
    if (landOnNextSheet(surface, tip, state)) continue;
    // As far from `held` as the tip can have been in this tick.
    const double reach = (held - state.tip).norm() + (tip - state.tip).norm();
    if (!isInside(surface, state, held, tip, reach)) return {};
    holdInside(surface, tip, path, state);
    return pressAt(surface, settings, state.proxy, tip);
  }
  return press;
}

}  // namespace palpate::contact
