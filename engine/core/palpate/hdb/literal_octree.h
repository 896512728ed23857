// The octree with the assignment as printed in 3.4: a triangle belongs to the octant that holds at least two of its
// vertices. A triangle with vertices in three octants belongs to none and is lost (E6). For comparison only.
//
// The tree is that of the majority rule, node by node, less the triangles lost on their way down: the two can be
// compared directly. (Where fewer triangles are left to divide, the printed pseudocode would stop a little earlier.)
#pragma once

#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::hdb {

struct LiteralOctree {
  Partition partition;
  std::vector<Index> lost;  ///< triangles of the mesh that are in no leaf, ascending
};

/// `settings.tree` and `settings.assignment` are taken as octree and majority. Throws Error as buildPartition does.
LiteralOctree buildLiteralOctree(const mesh::TriangleMesh& mesh, const BuildSettings& settings,
                                 const Progress& progress = {});

}  // namespace palpate::hdb
