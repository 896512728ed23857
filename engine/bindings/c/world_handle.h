// The implementation of palpate_world: a built world, counted, and where its vertices came from.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "palpate.h"
#include "palpate/engine/arrays.h"

struct palpate_world {
  std::atomic<std::uint32_t> users = 1;
  palpate::engine::WorldFromArrays built = {};  ///< without maps where it was not made from arrays

  const palpate::scene::World& world() const noexcept { return *built.world; }
};

namespace palpate::c_api {

/// Fills a new handle. Throws ArgumentError for no world.
palpate_world* makeHandle(engine::WorldFromArrays built);
inline palpate_world* makeHandle(std::shared_ptr<const scene::World> world) {
  return makeHandle(engine::WorldFromArrays{std::move(world), {}, {}, {}, {}});
}

}  // namespace palpate::c_api
