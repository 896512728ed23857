// Which triangles a finger of the HDB source may touch in this tick: those that the haptic detecting box found around
// its proxy, and no others.
//
// Data flow: proxy of the last tick -> detecting box -> ranges of the partition's entries -> the few near the place
// that is moved (hdb_finger.cpp).
// Based on: Ji, dissertation 2008, 3.3.3; 6.2 (4) for the coherent list.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "palpate/contact/hdb_settings.h"
#include "palpate/contact/surface.h"
#include "palpate/partition/coherent_list.h"
#include "palpate/partition/partition.h"

namespace palpate::contact {

/// What fingers of this source share. Immutable once made; a rebuilt partition makes another.
struct HdbSurface {
  std::shared_ptr<const partition::Partition> partition;
  std::vector<Index> record_of_triangle;  ///< triangle of the mesh -> record of the surface's tree; kNoIndex: none
  HdbSettings settings;
};

/// `partition` must be built from the mesh of `surface`. Throws Error for another mesh, for edges that are not
/// positive, and for a literal traversal that does not suit the tree or the query.
std::shared_ptr<const HdbSurface> makeHdbSurface(const Surface& surface,
                                                 std::shared_ptr<const partition::Partition> partition,
                                                 const HdbSettings& settings);

/// The memory of one finger's box; every finger has its own. Made for one HdbSurface, after which nothing allocates.
class HdbCandidates {
 public:
  explicit HdbCandidates(std::shared_ptr<const HdbSurface> surface);
  HdbCandidates(HdbCandidates&&) = default;
  HdbCandidates& operator=(HdbCandidates&&) = default;
  HdbCandidates(const HdbCandidates&) = delete;  // a copied vector has no room to spare: the copy would allocate
  HdbCandidates& operator=(const HdbCandidates&) = delete;

  /// Starts a tick: puts the box round the proxy, when it is its turn.
  void refresh(const Vec3& proxy) noexcept;

  /// The candidates whose box meets `box`, as records of the surface's tree. Valid until the next call.
  const std::vector<Index>& near(const partition::Box3& box) noexcept;

  /// Triangles in the list: an upper bound where the partition repeats them.
  std::size_t size() const noexcept { return partition::entriesIn(ranges()); }
  /// Times that the partition was asked.
  std::uint64_t queries() const { return queries_; }

 private:
  const std::vector<partition::EntryRange>& ranges() const;
  void findLeaves(const partition::Box3& box) noexcept;

  std::shared_ptr<const HdbSurface> surface_;
  partition::LeafHits leaves_;
  std::vector<partition::EntryRange> leaf_ranges_;
  partition::CoherentList list_;  ///< also of HdbQuery::triangles: its hits alone
  std::vector<Index> near_;
  std::uint32_t ticks_left_ = 0;
  std::uint64_t queries_ = 0;
};

}  // namespace palpate::contact
