// A partition as coloured PLY files: each leaf in a colour of its own, and what a box finds.
#pragma once

#include <filesystem>
#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::app {

/// Every entry - with the cut every piece - in the colour of its leaf; neighbours in the tree differ clearly. Throws
/// Error.
void writeLeafColours(const std::filesystem::path& file, const mesh::TriangleMesh& mesh,
                      const hdb::Partition& partition);

/// The mesh in grey, the triangles of the leaves in green (as Figures 3.8 and 3.9 have them), those that really meet
/// the box in orange; `exact` is ascending. Throws Error.
void writeSelection(const std::filesystem::path& file, const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                    const std::vector<Index>& leaves, const std::vector<Index>& exact);

}  // namespace palpate::app
