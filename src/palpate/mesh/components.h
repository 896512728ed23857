// Parts of a mesh that share no vertex.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

// Which elements belong together, learnt pair by pair.
//
// Based on: Tarjan, van Leeuwen, "Worst-case analysis of set union algorithms", 1984 (path halving). The root of a set
// is its lowest element, so that results do not depend on the order of the pairs.

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  /// The lowest element of the set.
  Index root(Index element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  /// True when they were in two sets before.
  bool unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    return true;
  }

 private:
  std::vector<Index> parent_;
};

struct Components {
  std::vector<Index> of_triangle;  ///< numbered by their lowest triangle
  Index count = 0;
};

/// Indices must be within range.
Components findComponents(const TriangleMesh& mesh);

}  // namespace palpate::mesh
