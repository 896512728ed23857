// A body whose skin faces the wrong way: it is seen from its back, dark, with the finger behind the surface. Closed
// parts are turned when they are read; of open ones nobody knows it but who made them, so the window asks.
#pragma once

#include <cstdint>
#include <filesystem>

#include "palpate/mesh/repair.h"
#include "palpate/scene/scene.h"

namespace palpate::viewer {

/// What of a skin should be turned over, as far as its shape can tell: parts that may be inside out, else all of a
/// surface whose back is to the eye; none where nothing is doubtful. `to_eye`: unit. Linear.
mesh::TurnOver doubtfulSides(const mesh::TriangleMesh& skin, const Vec3& to_eye);

/// The body's file, mended and turned, as NAME_turned.ply in this folder, in mm, with the numbers of its vertices.
/// Throws Error.
std::filesystem::path writeTurned(const scene::BodySettings& body, mesh::TurnOver turn_over,
                                  const std::filesystem::path& folder);

}  // namespace palpate::viewer
