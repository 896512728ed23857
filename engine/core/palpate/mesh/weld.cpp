// Equal places through a hash table of positions, near ones through a hash table of cells, in the order of the
// vertices, so that which one stays does not depend on the table.
//
// Based on: Knuth, "The Art of Computer Programming" 3, section 6.4 (open addressing, Fibonacci hashing); Teschner and
// others, "Optimized spatial hashing for collision detection of deformable objects" (2003), cells by their hash.
#include "palpate/mesh/weld.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::mesh {

namespace {

std::uint64_t mixed(std::uint64_t hash, double coordinate) {
  // + 0.0 turns -0 into 0. The multiplier is 2^64 / golden ratio (Fibonacci hashing); the shift brings high bits down.
  hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9e3779b97f4a7c15ull;
  return hash ^ (hash >> 29);
}

std::uint64_t hashOf(const Vec3& p) { return mixed(mixed(mixed(0, p.x()), p.y()), p.z()); }

/// Vertices in cubic cells as wide as the distance: neighbours are in the cell or one of its 26 neighbours.
class CellLists {
 public:
  CellLists(const std::vector<Vec3>& positions, double distance_mm)
      : positions_(positions), distance_(distance_mm), next_(positions.size(), kNoIndex) {}

  void add(Index v) {
    auto [entry, is_new] = first_.try_emplace(hashOf(cellAt(positions_[v])), v);
    if (!is_new) next_[v] = std::exchange(entry->second, v);
  }

  Index earliestNear(const Vec3& position) const {
    Index earliest = kNoIndex;
    for (int i = 0; i < 27; ++i) {
      const Vec3 cell = cellAt(position) + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
      const auto entry = first_.find(hashOf(cell));
      for (Index v = entry == first_.end() ? kNoIndex : entry->second; v != kNoIndex; v = next_[v]) {
        if ((positions_[v] - position).norm() < distance_) earliest = std::min(earliest, v);
      }
    }
    return earliest;
  }

 private:
  Vec3 cellAt(const Vec3& p) const { return (p / distance_).array().floor(); }

  const std::vector<Vec3>& positions_;
  double distance_;
  std::unordered_map<std::uint64_t, Index> first_;  // only looked up, never walked: its order does not matter
  std::vector<Index> next_;
};

}  // namespace

ExactWelder::ExactWelder(std::size_t expected_vertices) {
  positions_.reserve(expected_vertices);
  slots_.assign(std::bit_ceil(2 * expected_vertices + 16), kNoIndex);
}

Index ExactWelder::add(const Vec3& position) {
  if (2 * positions_.size() >= slots_.size()) grow();
  const auto next = static_cast<Index>(positions_.size());
  if (next == kNoIndex) throw Error("too many vertices for 32-bit indices");
  if (position.allFinite()) {
    const std::size_t slot = slotOf(position);
    if (slots_[slot] != kNoIndex) return slots_[slot];
    slots_[slot] = next;
  }
  positions_.push_back(position);
  return next;
}

void ExactWelder::prepare(const Vec3& position) const noexcept {
  hwy::Prefetch(slots_.data() + (hashOf(position) & (slots_.size() - 1)));
}

void ExactWelder::grow() {
  slots_.assign(2 * slots_.size(), kNoIndex);
  for (Index v = 0; v < positions_.size(); ++v) {
    if (positions_[v].allFinite()) slots_[slotOf(positions_[v])] = v;
  }
}

/// The slot of this finite position, or the free slot for it.
std::size_t ExactWelder::slotOf(const Vec3& position) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hashOf(position) & mask;
  while (slots_[slot] != kNoIndex && positions_[slots_[slot]] != position) slot = (slot + 1) & mask;
  return slot;
}

std::vector<Index> equalVertices(const std::vector<Vec3>& positions) {
  ExactWelder welder(positions.size());
  std::vector<Index> first_of_place;
  std::vector<Index> same_as(positions.size());
  for (Index v = 0; v < positions.size(); ++v) {
    if (v + ExactWelder::kAhead < positions.size()) welder.prepare(positions[v + ExactWelder::kAhead]);
    const Index place = welder.add(positions[v]);
    if (place == first_of_place.size()) first_of_place.push_back(v);
    same_as[v] = first_of_place[place];
  }
  return same_as;
}

std::vector<Index> nearVertices(const std::vector<Vec3>& positions, double distance_mm) {
  CellLists kept(positions, distance_mm);
  std::vector<Index> same_as(positions.size());
  for (Index v = 0; v < positions.size(); ++v) {
    same_as[v] = v;
    if (!positions[v].allFinite()) continue;
    if (const Index near = kept.earliestNear(positions[v]); near != kNoIndex) {
      same_as[v] = near;
    } else {
      kept.add(v);
    }
  }
  return same_as;
}

std::vector<Index> mergeVertices(TriangleMesh& mesh, const std::vector<Index>& same_as) {
  for (Triangle& triangle : mesh.triangles) {
    for (Index& v : triangle) v = v < same_as.size() ? same_as[v] : v;
  }
  return removeUnusedVertices(mesh);
}

std::vector<Index> removeUnusedVertices(TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  std::vector<Index> new_index(count, kNoIndex);
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) {
      if (v < count) new_index[v] = 0;
    }
  }
  std::vector<Index> source;
  for (Index v = 0; v < count; ++v) {
    if (new_index[v] == kNoIndex) continue;
    new_index[v] = static_cast<Index>(source.size());
    mesh.positions[source.size()] = mesh.positions[v];
    source.push_back(v);
  }
  mesh.positions.resize(source.size());
  for (Triangle& triangle : mesh.triangles) {
    // An index that was out of range before must not come to name a vertex now, nor one that is gone.
    for (Index& v : triangle) v = v < count ? new_index[v] : kNoIndex;
  }
  return source;
}

}  // namespace palpate::mesh
