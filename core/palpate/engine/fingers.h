// The fingers that a program brings to a world: their settings, and whether they and the world suit each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

/// Settings of so many fingers on a scene: its own in their order, then points with the scene's friction.
std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene, std::size_t fingers);

/// Settings of the scene's own fingers, or of one where it has none.
std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene);

/// Throws Error for settings that make no sense or are out of the range of the scene file's keys. `number`: of the
/// finger, for the message.
void checkFinger(const contact::FingerSettings& settings, std::size_t number = 0);

/// The same of all, and for a ball where the world knows points only (the detecting box).
void checkFingers(const scene::World& world, std::span<const contact::FingerSettings> fingers);

/// True if both have the same triangles at the same places, so that a finger may go on touching. Compares them all.
bool sameBody(const scene::World& one, const scene::World& other);

}  // namespace palpate::engine
