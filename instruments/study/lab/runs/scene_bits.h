// The bits of a scene's results, as three numbers: the same from every compiler, processor and system.
//
// Uses the core alone: tests/platforms/bits.cpp prints them for every platform, `palpate study credibility` compares
// them with the ones that are kept. docs/explanation/credibility.md
#pragma once

#include <cstdint>

#include "palpate/scene/world.h"

namespace palpate::bench {

/// `world` and `forces` are the numbers that `palpate simulate` and recordings call hash.
struct SceneBits {
  // 64 bits each, FNV-1a (base/hash.h): equal ones mean that not a bit changed.
  std::uint64_t world = 0;   ///< places, triangles and stiffness of the skin
  std::uint64_t forces = 0;  ///< forces of every finger in every tick
  std::uint64_t skin = 0;    ///< places, normals and strain as drawn, where the fingers together are deepest
  friend bool operator==(const SceneBits&, const SceneBits&) = default;
};

/// Along the scene's paths to their end (`ticks` 0), or again and again for `ticks` ticks. Any thread; the time of a
/// world's ticks, and a skin that is deformed once.
SceneBits bitsOf(const scene::World& world, std::uint64_t ticks = 0);

}  // namespace palpate::bench
