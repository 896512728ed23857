// Dynamic programme over sub-runs i..j: the best triangle (i, k, j) plus the best fillings of i..k and k..j.
//
// Based on: Barequet, Sharir, "Filling gaps in the boundary of a polyhedron", 1995 (minimum area, cubic time); Liepa,
// "Filling holes in meshes", 2003 (the same programme, diagonals that are edges already are forbidden).
#include "palpate/mesh/holes.h"

#include <limits>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

namespace {

/// Area is all but nothing in a crack, and equal for every filling of a flat hole: then short diagonals decide, which
/// lead straight across. This much of (length of the run * length of the diagonal) counts as area; too little to matter
/// anywhere else.
constexpr double kDiagonalWeight = 1e-6;

class Programme {
 public:
  Programme(std::span<const Vec3> loop, const std::function<bool(Index, Index)>& allowed)
      : loop_(loop), n_(static_cast<Index>(loop.size())), best_(loop.size() * loop.size(), 0.0), split_(best_.size()) {
    double length = 0.0;
    for (Index i = 0; i < n_; ++i) length += (loop[(i + 1) % n_] - loop[i]).norm();
    for (Index span = 2; span < n_; ++span) {
      for (Index i = 0; i + span < n_; ++i) {
        const Index j = i + span;
        const bool is_side = span == n_ - 1;
        if (is_side || allowed(i, j)) {
          solve(i, j, is_side ? 0.0 : kDiagonalWeight * length * (loop[j] - loop[i]).norm());
        } else {
          best_[at(i, j)] = kImpossible;
        }
      }
    }
  }

  std::optional<LoopTriangulation> result() const {
    if (!(best_[at(0, n_ - 1)] < kImpossible)) return std::nullopt;
    LoopTriangulation filling;
    std::vector<std::pair<Index, Index>> open = {{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const Index k = split_[at(i, j)];
      filling.triangles.push_back({i, k, j});
      filling.area += areaOf(i, k, j);
      open.emplace_back(k, j);
      open.emplace_back(i, k);
    }
    return filling;
  }

 private:
  static constexpr double kImpossible = std::numeric_limits<double>::infinity();

  std::size_t at(Index i, Index j) const { return std::size_t{i} * n_ + j; }
  double areaOf(Index i, Index k, Index j) const { return 0.5 * areaVector2(loop_[i], loop_[k], loop_[j]).norm(); }

  void solve(Index i, Index j, double own_cost) {
    double best = kImpossible;
    for (Index k = i + 1; k < j; ++k) {
      const double parts = best_[at(i, k)] + best_[at(k, j)];
      if (parts >= best) continue;
      const double cost = parts + areaOf(i, k, j);
      if (cost >= best) continue;
      best = cost;
      split_[at(i, j)] = k;
    }
    best_[at(i, j)] = best + own_cost;
  }

  std::span<const Vec3> loop_;
  Index n_;
  std::vector<double> best_;  // best of the sub-run i..j
  std::vector<Index> split_;  // the third corner of the triangle at i, j
};

}  // namespace

std::optional<LoopTriangulation> triangulateLoop(std::span<const Vec3> loop,
                                                 const std::function<bool(Index, Index)>& allowed) {
  if (loop.size() < 3) return std::nullopt;
  return Programme(loop, allowed).result();
}

}  // namespace palpate::mesh
