// Distances along the edges of the skin from some of its vertices: the distance that a gap does not shorten.
//
// ShearLimit starts from where the skin stays behind, and from the anchor. Labels are corrected first in, first out,
// belt after belt of a few edges' width: nearly every vertex is right the first time. The result is the least sum over
// all paths and does not depend on the order of anything. Memory is taken once; a search costs what it reaches. Based
// on: Moore, "The shortest path through a maze", 1959; belts after Meyer and Sanders, "Delta-stepping", 2003.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
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
        is_beyond_(skin.blocks, 0),
        belt_mm_(kBeltEdges * meanEdge(skin)),
        queue_(std::bit_ceil(std::size_t{skin.vertices} + 1)) {
    reached_.reserve(skin.vertices);
    beyond_.reserve(skin.vertices);
  }

  /// Forgets the last search.
  void start() noexcept {
    for (const Index v : reached_) distance_[v] = kUnreached;
    reached_.clear();
    belt_end_mm_ = belt_mm_;
  }

  /// A vertex so far from where the search starts. Distances that are not numbers count as none.
  void seed(Index vertex, float mm) noexcept {
    if (!(mm < distance_[vertex])) return;
    if (distance_[vertex] == kUnreached) reached_.push_back(vertex);
    distance_[vertex] = mm;
    if (mm < belt_end_mm_) {
      enqueue(vertex);
    } else {
      postpone(vertex);
    }
  }

  /// From the seeds on along edges to vertices with isAllowed(vertex, distance), as far as `reach_mm`.
  template <class IsAllowed>
  void spread(const Skin& skin, float reach_mm, const IsAllowed& is_allowed) noexcept {
    while (head_ != tail_ || nextBelt()) {
      const Index v = queue_[head_++ & (queue_.size() - 1)];
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
  /// Width of a belt, in edges: wide enough that few vertices are put off, narrow enough that few are corrected.
  static constexpr float kBeltEdges = 4.0f;

  static float meanEdge(const Skin& skin) {
    double sum = 0.0;
    std::size_t edges = 0;
    for (const Triangle& triangle : skin.triangles) {
      const double mm = (skin.restPosition(triangle[1]) - skin.restPosition(triangle[0])).norm();
      if (!std::isfinite(mm)) continue;
      sum += mm;
      ++edges;
    }
    return edges == 0 ? 0.0f : static_cast<float>(sum / static_cast<double>(edges));
  }

  void enqueue(Index vertex) noexcept {
    is_beyond_[blockOf(vertex)] &= ~bitOf(vertex);
    if (insertNew(vertex, waits_)) queue_[tail_++ & (queue_.size() - 1)] = vertex;
  }

  void postpone(Index vertex) noexcept {
    if (insertNew(vertex, is_beyond_)) beyond_.push_back(vertex);
  }

  /// Takes up the vertices within the next belt. False if none are left.
  bool nextBelt() noexcept {
    float nearest = kUnreached;
    for (const Index v : beyond_) {
      if (isIn(v, is_beyond_)) nearest = std::min(nearest, distance_[v]);
    }
    belt_end_mm_ = nearest + belt_mm_;
    std::size_t kept = 0;
    for (const Index v : beyond_) {
      if (!isIn(v, is_beyond_)) continue;  // taken up meanwhile
      if (distance_[v] <= belt_end_mm_) {
        enqueue(v);
      } else {
        beyond_[kept++] = v;
      }
    }
    beyond_.resize(kept);
    return head_ != tail_;
  }
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  std::vector<float> distance_;
  std::vector<std::uint64_t> waits_;      // in the queue; one bit a vertex
  std::vector<std::uint64_t> is_beyond_;  // the belt; likewise
  float belt_mm_;
  float belt_end_mm_ = 0.0f;
  std::vector<Index> queue_;  // a ring with room for every vertex, its size a power of two
  std::size_t head_ = 0;
  std::size_t tail_ = 0;
  std::vector<Index> beyond_;
  std::vector<Index> reached_;
};

}  // namespace palpate::deform
