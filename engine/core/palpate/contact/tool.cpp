// A group gathers the skin round its pads' centres with a margin, and uses that until one of its pads comes near the
// end of it. Groups gather in different ticks where they can: the one that has used most of its margin goes first, one
// a tick, before it has to. In the air a group knows how far the skin is and does not look until it has gone that far.
#include "palpate/contact/tool.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "palpate/base/aligned.h"
#include "palpate/base/error.h"
#include "palpate/contact/finger_tick.h"
#include "palpate/contact/relaxation.h"

namespace palpate::contact {

namespace {

// ---- groups

/// Triangles that a group gathers on even skin, about; NearbySkin has room for thrice as many.
constexpr double kGathered = 160.0;
/// The pads' centres may spread over this share of the radius of a circle that holds that many.
constexpr double kOfPads = 0.55;
/// The first margin, as a share of the same; it is adapted to the skin that is met.
constexpr double kFirstMargin = 0.25;
constexpr double kLargestMargin = 1.0;  // of all that is gathered
double meanTriangle(const SurfaceGeometry& geometry) {
  double area2 = 0.0;
  for (const tree::TriangleRecord& record : geometry.tree.records) {
    area2 += mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]).norm();
  }
  return 0.5 * area2 / static_cast<double>(geometry.tree.records.size());
}

double gatheredRadius(const SurfaceGeometry& geometry) {
  return std::sqrt(kGathered * meanTriangle(geometry) / std::numbers::pi);
}

PadGroup makePadGroup(const ToolShape& shape, std::span<const std::size_t> pads, std::size_t first, double margin_mm) {
  PadGroup group;
  group.first = first;
  group.end = first + pads.size();
  group.part = shape.pads[pads.front()].part;
  group.margin_mm = margin_mm;
  Box3 box;
  for (const std::size_t pad : pads) box.extend(shape.pads[pad].offset);
  group.offset = box.center();
  for (const std::size_t pad : pads) {
    const Pad& one = shape.pads[pad];
    group.radius_mm = std::max(group.radius_mm, (one.offset - group.offset).norm() + one.radius_mm);
  }
  return group;
}

/// Cuts pads of one part across their longest side until each group is small.
void addGroups(const ToolShape& shape, std::span<std::size_t> pads, std::size_t first, double circle_mm,
               ToolState& state) {
  Box3 box;
  for (const std::size_t pad : pads) box.extend(shape.pads[pad].offset);
  if (pads.size() == 1 || 0.5 * box.diagonal().norm() <= kOfPads * circle_mm) {
    state.groups.push_back(makePadGroup(shape, pads, first, kFirstMargin * circle_mm));
    return;
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  std::sort(pads.begin(), pads.end(), [&](std::size_t l, std::size_t r) {
    const double at_l = shape.pads[l].offset[axis], at_r = shape.pads[r].offset[axis];
    return at_l != at_r ? at_l < at_r : l < r;
  });
  const std::size_t half = pads.size() / 2;
  addGroups(shape, pads.first(half), first, circle_mm, state);
  addGroups(shape, pads.subspan(half), first + half, circle_mm, state);
}

// ---- a tick

/// Constant during a tick.
struct ToolTask {
  const Surface& surface;
  const ToolShape& shape;
  std::span<const ToolPose> poses;
  const LumpPlaces* lumps;
};

Vec3 placeIn(const ToolPose& pose, const Vec3& offset) noexcept { return pose.position + pose.rotation * offset; }

Vec3 padTip(const ToolTask& task, const Pad& pad) noexcept { return placeIn(task.poses[pad.part], pad.offset); }

/// A pad in the air whose next free tick changes nothing but its tip.
bool isIdle(const FingerState& pad, const FingerOutput& felt) noexcept {
  return pad.knows_tip && !pad.touching && pad.felt == Vec3::Zero() && !remembers(pad.memory) && felt.status == 0;
}

/// How far the skin is, asked only from where the answer cannot hide a broken device.
void lookForSkin(const Surface& surface, const Vec3& middle, PadGroup& group) noexcept {
  const tree::TriangleTree& tree = surface.geometry->tree;
  constexpr double kFarthest = 1e5;  // diagonals, far below usableTip()
  group.clear_mm = 0.0;
  if (!((middle - tree.center).norm() < kFarthest * tree.diagonal)) return;
  const tree::NearestPoint nearest = nearestPoint(tree, middle, 2.0 * kFarthest * tree.diagonal);
  if (nearest.triangle == kNoIndex) return;
  group.clear_at = middle;
  group.clear_mm = std::sqrt(nearest.closest.squared_distance);
}

/// Whether the group is in free air on the whole way of this tick.
bool isClear(const PadGroup& group, const Vec3& middle) noexcept {
  constexpr double kRounding = 1.0 - 1e-9;
  const double room = kRounding * group.clear_mm - group.radius_mm;
  const auto within = [&](const Vec3& place) { return (place - group.clear_at).squaredNorm() < room * room; };
  return room > 0.0 && within(middle) && within(group.middle);
}

/// A tick in which no pad of the group can touch anything, as the tick before was.
void moveThroughAir(const ToolTask& task, const PadGroup& group, ToolState& state) noexcept {
  for (std::size_t i = group.first; i < group.end; ++i) {
    const std::size_t pad = state.order[i];
    const Vec3 tip = padTip(task, task.shape.pads[pad]);
    FingerOutput& felt = state.felt[pad];
    felt.tip = felt.proxy = felt.anchor = felt.hold = tip;
    state.pads[pad].tip = tip;
  }
}

/// Where a pad's sphere will be, about: its centre goes with its tip.
Vec3 predictCentre(const FingerState& pad, const Vec3& tip) noexcept {
  return pad.touching ? Vec3(pad.centre + (tip - pad.tip)) : tip;
}

/// A group's knowledge of one surface means nothing on another.
void forgetSkin(PadGroup& group) noexcept {
  group.idle = false;
  group.clear_mm = 0.0;
  group.gather = true;
}

/// Gathers the skin for a group's next ticks. `slack_mm`: how far a centre may go in a tick beside its tip.
void gatherFor(const ToolTask& task, double slack_mm, PadGroup& group, NearbySkin& skin,
               const ToolState& state) noexcept {
  skin.planes = nullptr;
  if (task.surface.geometry != state.planes->geometry) return;
  if (group.rest_ticks > 0) {
    --group.rest_ticks;
    return;
  }
  Box3 box;
  for (std::size_t i = group.first; i < group.end; ++i) {
    box.extend(predictCentre(state.pads[state.order[i]], padTip(task, task.shape.pads[state.order[i]])));
  }
  Vec3 middle = box.center();
  double reach = 0.0;
  for (std::size_t i = group.first; i < group.end; ++i) {
    const Pad& pad = task.shape.pads[state.order[i]];
    const Vec3 place = predictCentre(state.pads[state.order[i]], padTip(task, pad));
    reach = std::max(reach, (place - middle).norm() + pad.radius_mm);
  }
  if (!middle.allFinite() || !std::isfinite(reach)) return;
  const bool has_moved = state.pads[state.order[group.first]].knows_tip;
  const Vec3 motion = has_moved ? Vec3(placeIn(task.poses[group.part], group.offset) - group.middle) : Vec3::Zero();
  group.margin_mm = std::max(group.margin_mm, profitableMargin(group.end - group.first, motion.norm() + slack_mm));
  group.margin_mm = std::min(group.margin_mm, kLargestMargin * reach);
  middle += gatheredAhead(motion, group.margin_mm);
  group.gather = false;
  if (group.idle) lookForSkin(task.surface, placeIn(task.poses[group.part], group.offset), group);
  if (gatherSkin(*state.planes, middle, reach + group.margin_mm, skin)) {
    group.margin_mm = adaptedMargin(skin, group.margin_mm);
    return;
  }
  // Too much skin, as under a large pad on a fine mesh: the tree is asked for a while.
  group.margin_mm *= 0.5;
  group.gather = true;
  group.rest_ticks = kTicksOfRest;
}

/// The result of moving a group's pads.
struct GroupTick {
  bool idle = true;
  double used = 0.0;  ///< of its margin, the most of all pads; 1: all of it
};

void stepPad(const ToolTask& task, FingerSettings& settings, const NearbySkin* nearby, std::size_t index,
             ToolState& state) noexcept {
  const Pad& pad = task.shape.pads[index];
  FingerState& finger = state.pads[index];
  settings.radius_mm = pad.radius_mm;
  const Vec3 tip = padTip(task, pad);
  // In place: what a pad felt is 350 bytes, which an assignment would copy.
  ::new (&state.felt[index]) FingerOutput(tickBy(task.surface, settings, finger, tip, task.lumps, [&] {
    return pressSphere(task.surface, settings, pad.radius_mm, finger, tip, nearby);
  }));
}

template <class Item>
void prefetchLines(const Item& item) noexcept {
  const auto* bytes = reinterpret_cast<const std::byte*>(&item);
  for (std::size_t i = 0; i < sizeof(Item); i += kCacheLineBytes) hwy::Prefetch(bytes + i);
}

/// Asks for what the next pad's tick reads.
void prefetchPad(const ToolTask& task, std::size_t index, const ToolState& state) noexcept {
  const FingerState& pad = state.pads[index];
  prefetchLines(pad);
  prefetchLines(state.felt[index]);
  if (!pad.touching) return;
  prefetchLines(task.surface.geometry->tree.records[pad.proxy.triangle]);
  const std::size_t block = pad.proxy.triangle / kSkinLanes;
  if (block < state.planes->blocks.size()) prefetchLines(state.planes->blocks[block]);
  prefetchLines(task.surface.geometry->tree.records[pad.anchor.triangle]);
}

GroupTick stepGroup(const ToolTask& task, FingerSettings& settings, const PadGroup& group, const NearbySkin& skin,
                    ToolState& state) noexcept {
  // A pad needs twice as much more as its centre may go in a tick: the list must hold for the next one too.
  GroupTick tick;
  for (std::size_t i = group.first; i < group.end; ++i) {
    const std::size_t index = state.order[i];
    if (i + 1 < state.order.size()) prefetchPad(task, state.order[i + 1], state);
    FingerState& pad = state.pads[index];
    const Vec3 before = pad.tip;
    stepPad(task, settings, &skin, index, state);
    tick.idle = tick.idle && isIdle(pad, state.felt[index]);
    const double step = (pad.tip - before).norm() + settings.catch_up_mm_per_s * settings.tick_s;
    const Vec3& place = pad.touching ? pad.centre : pad.tip;
    const double needs = (place - skin.middle).norm() + task.shape.pads[index].radius_mm + 2.0 * step;
    tick.used = std::max(tick.used, 1.0 - (skin.reach - needs) / group.margin_mm);
  }
  if (skin.planes == nullptr) tick.used = 1.0;
  return tick;
}

/// Moves a group's pads, by way of the air where there is nothing else.
GroupTick moveGroup(const ToolTask& task, FingerSettings& settings, PadGroup& group, NearbySkin& skin,
                    ToolState& state) noexcept {
  const Vec3 middle = placeIn(task.poses[group.part], group.offset);
  GroupTick tick;
  bool in_air = group.idle && isClear(group, middle);
  if (!in_air) {
    if (group.idle && !covers(skin, middle, group.radius_mm)) group.gather = true;
    if (group.gather) gatherFor(task, settings.catch_up_mm_per_s * settings.tick_s, group, skin, state);
    in_air = group.idle && isClear(group, middle);
  }
  if (in_air) {
    moveThroughAir(task, group, state);
  } else {
    tick = stepGroup(task, settings, group, skin, state);
  }
  group.middle = middle;
  group.idle = tick.idle;
  group.gather = group.gather || !(tick.used < 1.0);
  return tick;
}

void addPads(const ToolShape& shape, std::span<const ToolPose> poses, ToolState& state) noexcept {
  for (std::size_t part = 0; part < state.of_part.size(); ++part) state.of_part[part] = {poses[part].position};
  for (std::size_t i = 0; i < shape.pads.size(); ++i) {
    if (state.felt[i].touch == Touch::free) continue;
    const Pad& pad = shape.pads[i];
    Wrench& wrench = state.of_part[pad.part];
    const Vec3 force = pad.share * state.felt[i].force;
    wrench.force_n += force;
    wrench.moment_n_mm += (state.felt[i].tip - wrench.point).cross(force);
    ++state.touching;
  }
}

void require(bool holds, const std::string& what) {
  if (!holds) throw Error("tool: " + what);
}

}  // namespace

void check(const ToolShape& shape) {
  require(!shape.pads.empty(), "it must have at least one pad");
  for (std::size_t i = 0; i < shape.pads.size(); ++i) {
    const Pad& pad = shape.pads[i];
    const std::string name = "pad " + std::to_string(i);
    require(pad.offset.allFinite(), name + ": its offset must be finite");
    require(std::isfinite(pad.radius_mm) && pad.radius_mm > 0.0, name + ": its radius must be > 0");
    require(std::isfinite(pad.share) && pad.share >= 0.0, name + ": its share must be >= 0");
    require(pad.part < shape.rest.size(), name + ": its part does not exist");
  }
}

void posesAtRest(const ToolShape& shape, const ToolPose& pose, std::span<ToolPose> poses) noexcept {
  for (std::size_t part = 0; part < shape.rest.size(); ++part) {
    poses[part] = {placeIn(pose, shape.rest[part]), pose.rotation};
  }
}

Wrench about(const Wrench& wrench, const Vec3& point) noexcept {
  return {point, wrench.force_n, wrench.moment_n_mm + (wrench.point - point).cross(wrench.force_n)};
}

ToolState makeToolState(const ToolShape& shape, const Surface& surface, std::shared_ptr<const SkinPlanes> planes) {
  check(shape);
  require(!planes || planes->geometry == surface.geometry, "its planes are those of another surface");
  ToolState state;
  state.planes = planes ? std::move(planes) : surface.planes ? surface.planes : planesOf(surface.geometry);
  const std::size_t pads = shape.pads.size();
  state.pads.resize(pads);
  state.felt.resize(pads);
  state.of_part.resize(shape.rest.size());
  for (std::size_t i = 0; i < pads; ++i) state.order.push_back(i);
  std::stable_sort(state.order.begin(), state.order.end(),
                   [&](std::size_t l, std::size_t r) { return shape.pads[l].part < shape.pads[r].part; });
  const double circle_mm = gatheredRadius(*surface.geometry);
  for (std::size_t first = 0; first < pads;) {
    std::size_t end = first;
    while (end < pads && shape.pads[state.order[end]].part == shape.pads[state.order[first]].part) ++end;
    addGroups(shape, std::span(state.order).subspan(first, end - first), first, circle_mm, state);
    first = end;
  }
  state.nearby.resize(state.groups.size());
  return state;
}

Wrench stepTool(const Surface& surface, const ToolShape& shape, const FingerSettings& settings, ToolState& state,
                std::span<const ToolPose> poses, const LumpPlaces* lumps) noexcept {
  constexpr double kNearlyUsed = 0.8;
  const ToolTask task{surface, shape, poses, lumps};
  FingerSettings of_pad = settings;
  const bool of_others = surface.geometry != state.planes->geometry;
  std::size_t next = state.groups.size();  // the group that gathers in the next tick, before it has to
  double most_used = kNearlyUsed;
  for (std::size_t g = 0; g < state.groups.size(); ++g) {
    PadGroup& group = state.groups[g];
    NearbySkin& skin = state.nearby[g];
    if (of_others) forgetSkin(group);
    const GroupTick tick = moveGroup(task, of_pad, group, skin, state);
    if (group.gather || !(tick.used > most_used)) continue;
    most_used = tick.used;
    next = g;
  }
  if (next < state.groups.size()) state.groups[next].gather = true;
  state.touching = 0;
  addPads(shape, poses, state);
  Wrench all{poses.front().position};
  for (const Wrench& part : state.of_part) {
    const Wrench moved = about(part, all.point);
    all.force_n += moved.force_n;
    all.moment_n_mm += moved.moment_n_mm;
  }
  return all;
}

void lift(ToolState& state) noexcept {
  for (FingerState& pad : state.pads) pad = {};
  for (FingerOutput& felt : state.felt) felt = {};
  for (PadGroup& group : state.groups) group.idle = false;
  for (Wrench& wrench : state.of_part) wrench = {};
  state.touching = 0;
}

}  // namespace palpate::contact
