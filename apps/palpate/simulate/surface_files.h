// The deformed skin as PLY files: what it looked like at a moment of the run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::app {

/// All fingers in one tick.
using Frame = std::vector<trace::Sample>;

/// Writes the skin deformed by these fingers: positions, displacement and its parts, strain, stiffness, and the strain
/// as colours. Throws Error.
void writeSurface(const std::filesystem::path& file, const scene::World& world, const Frame& frame);

}  // namespace palpate::app
