// The plates of a triangle tree's nodes (wide_node.h): how the surface in each child faces, how thick it is across that
// direction and how far its normals spread.
#pragma once

#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

/// Fills them from the tree's records; the last step of buildTriangleTree. About 0.1 us a triangle.
void fillPlates(TriangleTree& tree);

}  // namespace palpate::tree
