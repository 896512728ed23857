// Parts of the pictures of chapter 3: what of a partition is shown on a surface.
#pragma once

#include <array>
#include <vector>

#include "figures/mesh_view.h"
#include "palpate/partition/haptic_box.h"

namespace palpate::study {

/// Case C, as the dissertation chose.
partition::Partition grownTree(const mesh::TriangleMesh& mesh, partition::TreeKind kind, Index threshold);

/// The splitting planes of the inner nodes above a level: x green, y red, z yellow, as printed.
std::vector<figures::Sheet> splittingSheets(const partition::Partition& tree, int levels);

/// The edges of the leaves' cells.
std::vector<std::array<Vec3, 2>> leafBoxes(const partition::Partition& tree);

/// Green for the triangles in the found leaves, the skin's colour for the others.
std::vector<figures::Colour> hapticColours(const partition::Partition& tree, const partition::LeafHits& hits);

inline constexpr figures::Colour kHapticGreen{0.25, 0.70, 0.35};

}  // namespace palpate::study
