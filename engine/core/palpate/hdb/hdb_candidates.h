// The triangles that a finger of the HDB source may touch in this tick: those that the haptic detecting box found
// around its proxy, and no others.
//
// Data flow: proxy of the last tick -> detecting box -> ranges of the partition's entries -> the few near the place
// that is moved (hdb_finger.cpp).
// Based on: Ji, dissertation 2008, 3.3.3; 6.2 (4) for the coherent list.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/contact/surface.h"
#include "palpate/hdb/coherent_list.h"
#include "palpate/hdb/linked_triangles.h"
#include "palpate/hdb/literal_traversal.h"
#include "palpate/hdb/partition.h"

namespace palpate::hdb {

/// Triangles that the detecting box yields.
enum class HdbQuery : std::uint8_t {
  leaves,     ///< all triangles of the leaves that it meets: the dissertation's haptic process
  triangles,  ///< the triangles that it meets
  coherent,   ///< those and some from a margin, listed again only when the box leaves the margin (future work 4)
  linked      ///< those that it meets, in a hybrid of tree and linked list that follows the box (future work 4)
};

struct HdbSettings {
  Vec3 edges_mm = Vec3::Zero();  ///< edges of the detecting box
  HdbQuery query = HdbQuery::leaves;
  std::optional<LiteralTraversal> literal;  ///< for HdbQuery::leaves only
  /// Ticks that the box stays where it is before it follows the proxy; the dissertation's box moved once a frame of the
  /// haptic scene, some 20 to 100 ticks.
  std::uint32_t ticks_per_refresh = 1;
};

/// Data shared by the fingers of this source. Immutable once made; a rebuilt partition makes another.
struct HdbSurface {
  std::shared_ptr<const Partition> partition;
  std::vector<Index> record_of_triangle;  ///< triangle of the mesh -> record of the surface's tree; kNoIndex: none
  HdbSettings settings;
};

/// `partition` must be built from the mesh of `surface`. Throws Error for another mesh, for edges that are not
/// positive, and for a literal traversal that does not suit the tree or the query.
std::shared_ptr<const HdbSurface> makeHdbSurface(const contact::Surface& surface,
                                                 std::shared_ptr<const Partition> partition,
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
  const std::vector<Index>& near(const Box3& box) noexcept;

  /// Triangles in the list: an upper bound where the partition repeats them.
  std::size_t size() const noexcept;
  /// Times that the partition was asked.
  std::uint64_t queries() const { return queries_; }
  /// Boxes of triangles, with HdbQuery::linked of nodes too, that near() has tested.
  std::uint64_t boxesTested() const { return boxes_tested_ + linked_.boxes_found; }
  /// Boxes of nodes and of triangles tested to make the linked list follow; 0 with the other queries.
  std::uint64_t boxesMoved() const { return linked_.boxes_moved; }
  /// Memory of this finger's list.
  std::size_t bytes() const noexcept;

 private:
  const std::vector<EntryRange>& ranges() const;
  void mapToRecords() noexcept;
  void findLeaves(const Box3& box) noexcept;

  std::shared_ptr<const HdbSurface> surface_;
  LeafHits leaves_;
  std::vector<EntryRange> leaf_ranges_;
  CoherentList list_;  ///< also of HdbQuery::triangles: its hits alone
  LinkedTriangles linked_;
  std::vector<Index> near_;
  std::uint32_t ticks_left_ = 0;
  std::uint64_t queries_ = 0;
  std::uint64_t boxes_tested_ = 0;
};

}  // namespace palpate::hdb
