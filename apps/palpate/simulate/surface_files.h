// The deformed skin as PLY files: what it looked like at a moment of the run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/deform/any_deformer.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::app {

/// All fingers in one tick.
using Frame = std::vector<trace::Sample>;

/// The contacts of the fingers that touch in this frame.
std::vector<deform::Contact> contactsOf(const scene::World& world, const Frame& frame);

/// The scene's forms, with strain and room for so many fingers.
deform::FormSettings formsForDisplay(const scene::World& world, std::size_t fingers);

/// Writes the skin deformed by these fingers: positions, displacement and its parts, strain, stiffness, and the strain
/// as colours. Throws Error.
void writeSurface(const std::filesystem::path& file, const scene::World& world, const Frame& frame);

}  // namespace palpate::app
