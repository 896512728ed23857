// The deformed skin as PLY files: what it looked like at a moment of the run.
#pragma once

#include <filesystem>

#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::app {

/// Writes the skin deformed by these fingers: positions, displacement and its parts, strain, stiffness, and the strain
/// as colours. Throws Error.
void writeSurface(const std::filesystem::path& file, const scene::World& world, const servo::TickSamples& frame);

}  // namespace palpate::app
