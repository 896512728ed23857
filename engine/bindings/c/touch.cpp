// Once a tick for each finger: the caller's structure is filled in place, not by way of a copy.
#include "touch.h"

#include <cmath>

#include "structs.h"

namespace palpate::c_api {

namespace {

static_assert(static_cast<int>(contact::Touch::free) == PALPATE_FREE);
static_assert(static_cast<int>(contact::Touch::stick) == PALPATE_STICK);
static_assert(static_cast<int>(contact::Touch::slip) == PALPATE_SLIP);
static_assert(contact::kTipLost == PALPATE_TIP_LOST && contact::kCatchingUp == PALPATE_CATCHING_UP);
static_assert(contact::kTooDeep == PALPATE_TOO_DEEP && contact::kLettingGo == PALPATE_LETTING_GO);
static_assert(contact::kAtBorder == PALPATE_AT_BORDER && contact::kStartedInside == PALPATE_STARTED_INSIDE);
static_assert(contact::kUnsettled == PALPATE_UNSETTLED && contact::kShadingFailed == PALPATE_SHADING_FAILED);

template <class Vector>
void put(const Vector& vector, double* target) noexcept {
  for (Eigen::Index axis = 0; axis < vector.size(); ++axis) target[axis] = vector[axis];
}

Vec3 toVec3(const double* numbers) noexcept { return {numbers[0], numbers[1], numbers[2]}; }

/// Everything but the size.
void fill(const contact::FingerOutput& felt, std::uint64_t tick, palpate_touch& touch) noexcept {
  put(felt.force, touch.force_n);
  touch.depth_mm = felt.depth_mm;
  touch.touch = static_cast<int32_t>(felt.touch);
  touch.status = felt.status;
  put(felt.normal, touch.normal);
  put(felt.tip, touch.tip_mm);
  put(felt.proxy, touch.proxy_mm);
  put(felt.anchor, touch.anchor_mm);
  put(felt.hold, touch.hold_mm);
  touch.triangle = felt.triangle;
  touch.anchor_triangle = felt.anchor_triangle;
  touch.tissue_mm = felt.tissue_mm;
  touch.rest_mm = felt.rest_mm;
  put(felt.dent.place, touch.dent_mm);
  touch.dent_rest_mm = felt.dent.rest_mm;
  touch.dent_triangle = felt.dent.triangle;
  touch.reserved = 0;
  touch.tick = tick;
  put(felt.lump_force, touch.lump_force_n);
  touch.lump_share = felt.lump_share;
  put(felt.lump_moved_mm, touch.lump_moved_mm);
  touch.lump = felt.lump;
  touch.reserved_2 = 0;
}

bool isFinite(const palpate_touch& touch) noexcept {
  // 0 times a number is not 0 where it is not finite.
  double sum = 0.0 * (touch.depth_mm + touch.tissue_mm + touch.rest_mm + touch.dent_rest_mm + touch.lump_share +
                      touch.lump_moved_mm[0] + touch.lump_moved_mm[1]);
  for (const auto& vector : {touch.force_n, touch.normal, touch.tip_mm, touch.proxy_mm, touch.anchor_mm, touch.hold_mm,
                             touch.dent_mm, touch.lump_force_n}) {
    for (int axis = 0; axis < 3; ++axis) sum += 0.0 * vector[axis];
  }
  return sum == 0.0;
}

}  // namespace

void putTouch(const contact::FingerOutput& felt, std::uint64_t tick, palpate_touch* touch, std::size_t size) noexcept {
  if (size >= sizeof(palpate_touch)) {
    fill(felt, tick, *touch);
    touch->size = size;
    return;
  }
  palpate_touch whole = {};
  fill(felt, tick, whole);
  toCaller(whole, touch, size);
}

bool feltFrom(const palpate_touch& touch, std::size_t triangles, contact::FingerOutput& felt) noexcept {
  const auto is_triangle = [&](std::uint32_t index) { return index < triangles || index == kNoIndex; };
  if (touch.touch < PALPATE_FREE || touch.touch > PALPATE_SLIP || !isFinite(touch)) return false;
  if (!is_triangle(touch.triangle) || !is_triangle(touch.anchor_triangle) || !is_triangle(touch.dent_triangle)) {
    return false;
  }
  felt.force = toVec3(touch.force_n);
  felt.depth_mm = touch.depth_mm;
  felt.touch = static_cast<contact::Touch>(touch.touch);
  felt.status = touch.status;
  felt.normal = toVec3(touch.normal);
  felt.tip = toVec3(touch.tip_mm);
  felt.proxy = toVec3(touch.proxy_mm);
  felt.anchor = toVec3(touch.anchor_mm);
  felt.hold = toVec3(touch.hold_mm);
  felt.triangle = touch.triangle;
  felt.anchor_triangle = touch.anchor_triangle;
  felt.tissue_mm = touch.tissue_mm;
  felt.rest_mm = touch.rest_mm;
  felt.dent = {toVec3(touch.dent_mm), touch.dent_rest_mm, touch.dent_triangle};
  felt.lump_force = toVec3(touch.lump_force_n);
  felt.lump_share = touch.lump_share;
  felt.lump_moved_mm = {touch.lump_moved_mm[0], touch.lump_moved_mm[1]};
  felt.lump = touch.lump;
  return true;
}

}  // namespace palpate::c_api
