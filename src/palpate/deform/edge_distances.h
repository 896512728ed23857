// How far it is along the edges of the skin from some of its vertices: the distance that a gap does not shorten.
//
// shear_limit.h asks from where the skin stays behind, and from the anchor. Labels are corrected first in, first out:
// on a mesh nearly every vertex is right after two or three turns. The result is the least sum over all paths and does
// not depend on the order of anything. Memory is taken once; a search costs what it reaches.
// Based on: Moore, "The shortest path through a maze", 1959.
#pragma once

#include <bit>
#include <limits>
#include <span>
#include <vector>

#include "palpate/deform/skin.h"

namespace palpate::deform {

class EdgeDistances {
 public:
  explicit EdgeDistances(const Skin& skin)
      : distance_(skin.vertices, kUnreached),
        waits_(skin.blocks, 0),
        queue_(std::bit_ceil(std::size_t{skin.vertices} + 1)) {
    reached_.reserve(skin.vertices);
  }

  /// Forgets the last search.
  void start() noexcept {
    for (const Index v : reached_) distance_[v] = kUnreached;
    reached_.clear();
  }

  /// A vertex so far from where the search starts. Distances that are not numbers count as none.
  void seed(Index vertex, float mm) noexcept {
    if (!(mm < distance_[vertex])) return;
    if (distance_[vertex] == kUnreached) reached_.push_back(vertex);
    distance_[vertex] = mm;
    if ((waits_[blockOf(vertex)] & bitOf(vertex)) != 0) return;
    waits_[blockOf(vertex)] |= bitOf(vertex);
    queue_[tail_++ & (queue_.size() - 1)] = vertex;
  }

  /// From the seeds on along edges to vertices with isAllowed(vertex, distance), as far as `reach_mm`.
  template <class IsAllowed>
  void spread(const Skin& skin, float reach_mm, const IsAllowed& is_allowed) noexcept {
    for (; head_ != tail_; ++head_) {
      const Index v = queue_[head_ & (queue_.size() - 1)];
      waits_[blockOf(v)] &= ~bitOf(v);
      const Vec3f here = skin.restPosition(v);
      for (const Index w : skin.neighbours[v]) {
        const float mm = distance_[v] + (skin.restPosition(w) - here).norm();
        if (mm < reach_mm && is_allowed(w, mm)) seed(w, mm);
      }
    }
  }

  /// Infinite where the search did not come.
  float at(Index vertex) const noexcept { return distance_[vertex]; }
  /// All vertices that have a distance.
  std::span<const Index> reached() const noexcept { return reached_; }

 private:
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  std::vector<float> distance_;
  std::vector<std::uint64_t> waits_;  // in the queue; one bit a vertex
  std::vector<Index> queue_;          // a ring with room for every vertex, its size a power of two
  std::size_t head_ = 0;
  std::size_t tail_ = 0;
  std::vector<Index> reached_;
};

}  // namespace palpate::deform
