// A deformed skin behind its handle. Touches are checked all before the first of them is applied.
#include <memory>
#include <vector>

#include "answers.h"
#include "palpate/engine/living_skin.h"
#include "structs.h"
#include "touch.h"
#include "world_handle.h"

struct palpate_skin {
  palpate_skin(std::shared_ptr<const palpate::scene::World> of, std::size_t fingers, bool strain)
      : world(std::move(of)), living(*world, {.strain = strain, .fingers = fingers}), felt(fingers) {}

  std::shared_ptr<const palpate::scene::World> world;
  palpate::engine::LivingSkin living;
  std::vector<palpate::contact::FingerOutput> felt;  ///< one for each finger that there is room for
};

namespace palpate::c_api {

namespace {

constexpr std::size_t kMaxFingers = 4096;

/// Tells of a skin's array along one axis; null for another axis.
const float* along(const palpate_skin* skin, int32_t axis,
                   std::span<const float> (deform::DeformedSurface::*array)(int) const) noexcept {
  if (skin == nullptr || axis < 0 || axis > 2) return nullptr;
  return (skin->living.surface().*array)(axis).data();
}

bool readAll(const palpate_skin& skin, const palpate_touch* touches, std::size_t count, std::size_t stride,
             std::span<contact::FingerOutput> felt, std::uint64_t& tick) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const palpate_touch* given = at(touches, i, stride);
    if (!isSize<palpate_touch>(given->size)) return false;
    palpate_touch none = {};
    none.triangle = none.anchor_triangle = none.dent_triangle = none.lump = PALPATE_NONE;
    const palpate_touch touch = fromCaller(given, none);
    if (!feltFrom(touch, skin.world->body->skin.triangles.size(), felt[i])) return false;
    if (i == 0) tick = touch.tick;
  }
  return true;
}

}  // namespace

}  // namespace palpate::c_api

using namespace palpate;

int32_t palpate_skin_create(palpate_world* world, size_t fingers, int32_t strain, palpate_skin** out,
                            palpate_error* error) noexcept {
  return c_api::answeredWith(out, error, [&] {
    c_api::require(world != nullptr, "the world is null");
    c_api::require(fingers >= 1 && fingers <= c_api::kMaxFingers, "fingers is out of range: 1 to 4,096");
    return std::make_unique<palpate_skin>(world->built.world, fingers, strain != 0).release();
  });
}

int32_t palpate_skin_apply(palpate_skin* skin, const palpate_touch* touches, size_t count, size_t stride) noexcept {
  if (skin == nullptr || count > skin->felt.size()) return PALPATE_ARGUMENT;
  if (count > 0 && (touches == nullptr || !c_api::isSize<palpate_touch>(stride))) return PALPATE_ARGUMENT;
  std::uint64_t tick = 0;
  const std::span felt = std::span(skin->felt).first(count);
  if (!c_api::readAll(*skin, touches, count, stride, felt, tick)) return PALPATE_ARGUMENT;
  skin->living.follow(std::span<const contact::FingerOutput>(felt), tick);
  return PALPATE_OK;
}

size_t palpate_skin_vertices(const palpate_skin* skin) noexcept {
  return skin == nullptr ? 0 : skin->living.surface().vertices();
}

const float* palpate_skin_positions(const palpate_skin* skin, int32_t axis) noexcept {
  return c_api::along(skin, axis, &deform::DeformedSurface::position);
}

const float* palpate_skin_normals(const palpate_skin* skin, int32_t axis) noexcept {
  return c_api::along(skin, axis, &deform::DeformedSurface::normal);
}

const float* palpate_skin_displacements(const palpate_skin* skin, int32_t axis) noexcept {
  return c_api::along(skin, axis, &deform::DeformedSurface::displacement);
}

const float* palpate_skin_strain(const palpate_skin* skin) noexcept {
  return skin == nullptr ? nullptr : skin->living.surface().strain().data();
}

const uint32_t* palpate_skin_changed(const palpate_skin* skin, size_t* count) noexcept {
  static_assert(sizeof(deform::VertexRange) == 2 * sizeof(std::uint32_t));
  const std::span<const deform::VertexRange> changed =
      skin == nullptr ? std::span<const deform::VertexRange>() : skin->living.surface().changed();
  if (count != nullptr) *count = changed.size();
  return changed.empty() ? nullptr : &changed.front().first;
}

double palpate_skin_lift_mm(const palpate_skin* skin) noexcept { return skin == nullptr ? 0.0 : skin->living.lift(); }

const double* palpate_skin_origin_mm(const palpate_skin* skin) noexcept {
  return skin == nullptr ? nullptr : skin->living.surface().origin().data();
}

void palpate_skin_release(palpate_skin* skin) noexcept { delete skin; }
