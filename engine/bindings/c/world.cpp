// Makes worlds from files, texts, nothing and arrays. Queries are in world_queries.cpp.
#include <limits>

#include "answers.h"
#include "palpate/base/path_text.h"
#include "palpate/engine/arrays.h"
#include "palpate/scene/scene_file.h"
#include "structs.h"
#include "world_handle.h"

namespace palpate::c_api {

palpate_world* makeHandle(engine::WorldFromArrays built) {
  auto handle = std::make_unique<palpate_world>();
  handle->built = std::move(built);
  return handle.release();
}

namespace {

scene::Scene parseScene(const char* toml, const char* name) {
  return scene::parse(toml, name == nullptr ? "scene" : name);
}

/// That many, three each, fit into memory's numbers.
void checkCount(std::size_t count) {
  require(count < std::numeric_limits<Index>::max(), "arrays: too many vertices or triangles for 32-bit indices");
}

template <class Real, class Integer>
engine::WorldFromArrays built(const Real* positions, const Integer* corners, const palpate_arrays& arrays) {
  const mesh::TriangleMesh mesh =
      engine::meshFromArrays(std::span(positions, 3 * arrays.vertices), std::span(corners, 3 * arrays.triangles));
  std::span<const double> stiffness;
  if (arrays.stiffness_n_per_mm != nullptr) stiffness = {arrays.stiffness_n_per_mm, arrays.vertices};
  const scene::Scene scene = arrays.scene_toml == nullptr ? scene::Scene() : parseScene(arrays.scene_toml, "arrays");
  return engine::worldFromMesh(mesh, stiffness, scene);
}

template <class Real>
engine::WorldFromArrays built(const Real* positions, const palpate_arrays& arrays) {
  return arrays.corners != nullptr ? built(positions, arrays.corners, arrays)
                                   : built(positions, arrays.corners_i64, arrays);
}

palpate_world* worldFrom(const palpate_arrays& arrays) {
  require((arrays.positions_mm == nullptr) != (arrays.positions_mm_f32 == nullptr),
          "arrays: exactly one of positions_mm and positions_mm_f32 must be given");
  require((arrays.corners == nullptr) != (arrays.corners_i64 == nullptr),
          "arrays: exactly one of corners and corners_i64 must be given");
  checkCount(arrays.vertices);
  checkCount(arrays.triangles);
  return makeHandle(arrays.positions_mm != nullptr ? built(arrays.positions_mm, arrays)
                                                 : built(arrays.positions_mm_f32, arrays));
}

}  // namespace

}  // namespace palpate::c_api

using namespace palpate;
using c_api::answeredWith;
using c_api::require;

int32_t palpate_world_load(const char* utf8_path, palpate_world** out, palpate_error* error) noexcept {
  return answeredWith(out, error, [&] {
    require(utf8_path != nullptr, "the path is null");
    return c_api::makeHandle(scene::build(scene::load(pathOf(utf8_path))));
  });
}

int32_t palpate_world_parse(const char* utf8_toml, const char* name, palpate_world** out,
                            palpate_error* error) noexcept {
  return answeredWith(out, error, [&] {
    require(utf8_toml != nullptr, "the text is null");
    return c_api::makeHandle(scene::build(c_api::parseScene(utf8_toml, name)));
  });
}

int32_t palpate_world_torso(size_t triangles, palpate_world** out, palpate_error* error) noexcept {
  return answeredWith(out, error, [&] {
    scene::Scene scene;
    scene.body.kind = scene::BodyKind::torso;
    scene.body.triangles = triangles;
    return c_api::makeHandle(scene::build(scene));
  });
}

int32_t palpate_world_from_arrays(const palpate_arrays* arrays, palpate_world** out, palpate_error* error) noexcept {
  return answeredWith(out, error, [&] {
    require(c_api::isUsable(arrays), "arrays is null, or its size is not set");
    return c_api::worldFrom(c_api::fromCaller(arrays));
  });
}

int32_t palpate_world_rebuilt(const palpate_world* world, const char* utf8_toml, const char* name, palpate_world** out,
                              palpate_error* error) noexcept {
  return answeredWith(out, error, [&] {
    require(world != nullptr && utf8_toml != nullptr, "the world or the text is null");
    engine::WorldFromArrays built = world->built;  // the same vertices, so the same maps
    built.world = scene::rebuilt(world->world(), c_api::parseScene(utf8_toml, name));
    return c_api::makeHandle(std::move(built));
  });
}

void palpate_world_retain(palpate_world* world) noexcept {
  if (world != nullptr) world->users.fetch_add(1, std::memory_order_relaxed);
}

void palpate_world_release(palpate_world* world) noexcept {
  if (world != nullptr && world->users.fetch_sub(1, std::memory_order_acq_rel) == 1) delete world;
}
