// A body whose skin faces the wrong way: it is seen from its back, dark, with the finger behind the surface. Closed
// parts are turned on reading; for open ones only their maker knows, so the window asks.
#pragma once

#include <cstdint>
#include <filesystem>

#include "palpate/mesh/repair.h"
#include "palpate/scene/scene.h"

namespace palpate::viewer {

/// The parts of a skin that should be turned over, judging by its shape: parts that may be inside out, else all of a
/// surface whose back is to the eye; none without doubt. `to_eye`: unit. Linear.
mesh::TurnOver doubtfulSides(const mesh::TriangleMesh& skin, const Vec3& to_eye);

/// Writes the body's file, mended and turned, as NAME_turned.ply in this folder, in mm, with the numbers of its
/// vertices. Throws Error.
std::filesystem::path writeTurned(const scene::BodySettings& body, mesh::TurnOver turn_over,
                                  const std::filesystem::path& folder);

}  // namespace palpate::viewer
