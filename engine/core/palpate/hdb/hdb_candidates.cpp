// Queries the partition for the triangles round the proxy when it is the box's turn, and returns those near a motion.
//
// Data flow: proxy of the last tick -> refresh -> ranges of entries -> near -> records of the surface's tree for
// hdb_finger.cpp. All room is reserved and touched when the candidates are made; a tick allocates nothing.
// Based on: Ji, dissertation 2008, 3.3.3.
#include "palpate/hdb/hdb_candidates.h"

#include <string>
#include <utility>

#include "palpate/base/aligned.h"
#include "palpate/base/error.h"

namespace palpate::hdb {

namespace {

void require(bool holds, const char* what) {
  if (!holds) throw Error(std::string("hdb source: ") + what);
}

std::vector<Index> recordsOfTriangles(const contact::Surface& surface, std::size_t triangles) {
  std::vector<Index> records(triangles, kNoIndex);
  const auto& source = surface.geometry->tree.source_triangle;
  for (Index record = 0; record < source.size(); ++record) {
    require(source[record] < triangles, "the partition is not of this mesh");
    records[source[record]] = record;
  }
  return records;
}

void check(const HdbSettings& settings, const Partition& partition) {
  require(settings.edges_mm.allFinite() && settings.edges_mm.minCoeff() > 0.0, "the box needs edges above 0");
  require(settings.ticks_per_refresh >= 1, "ticks_per_refresh must be at least 1");
  if (!settings.literal) return;
  require(settings.query == HdbQuery::leaves, "a literal traversal finds leaves only");
  require(suits(*settings.literal, partition.tree), "this traversal needs the planes of a BSP tree");
}

}  // namespace

std::shared_ptr<const HdbSurface> makeHdbSurface(const contact::Surface& surface,
                                                 std::shared_ptr<const Partition> partition,
                                                 const HdbSettings& settings) {
  require(partition != nullptr, "has no partition");
  check(settings, *partition);
  std::vector<Index> records = recordsOfTriangles(surface, partition->triangle_count);
  return std::make_shared<const HdbSurface>(HdbSurface{std::move(partition), std::move(records), settings});
}

HdbCandidates::HdbCandidates(std::shared_ptr<const HdbSurface> surface) : surface_(std::move(surface)) {
  const Partition& partition = *surface_->partition;
  switch (surface_->settings.query) {
    case HdbQuery::leaves:
      leaves_.prepareFor(partition);
      reserveTouched(leaves_.leaves, partition.leaves.size());
      reserveTouched(leaf_ranges_, partition.leaves.size());
      break;
    case HdbQuery::triangles:
    case HdbQuery::coherent:
      list_.prepareFor(partition);
      break;
    case HdbQuery::linked:
      linked_.prepareFor(partition);
  }
  reserveTouched(near_, partition.triangles.size());
}

const std::vector<EntryRange>& HdbCandidates::ranges() const {
  return surface_->settings.query == HdbQuery::leaves ? leaf_ranges_ : list_.hits.ranges;
}

std::size_t HdbCandidates::size() const noexcept {
  return surface_->settings.query == HdbQuery::linked ? linked_.triangles : entriesIn(ranges());
}

std::size_t HdbCandidates::bytes() const noexcept {
  const std::size_t of_indices = leaves_.leaves.capacity() + list_.hits.triangles.capacity() +
                                 list_.hits.stamp_of_triangle.capacity() + near_.capacity() +
                                 linked_.marked.capacity() + linked_.next.capacity() + linked_.previous.capacity();
  return sizeof(Index) * of_indices + sizeof(EntryRange) * (leaf_ranges_.capacity() + list_.hits.ranges.capacity()) +
         sizeof(std::uint16_t) * linked_.marks.capacity();
}

/// Entries become records of the surface's tree; those without one are dropped.
void HdbCandidates::mapToRecords() noexcept {
  std::size_t kept = 0;
  for (const Index entry : near_) {
    const Index record = surface_->record_of_triangle[surface_->partition->triangles[entry]];
    if (record != kNoIndex) near_[kept++] = record;
  }
  near_.resize(kept);
}

void HdbCandidates::findLeaves(const Box3& box) noexcept {
  const Partition& partition = *surface_->partition;
  const auto& literal = surface_->settings.literal;
  if (literal) {
    findLeavesLiterally(partition, *literal, box, leaves_);
  } else {
    hdb::findLeaves(partition, box, leaves_);
  }
  leaf_ranges_.clear();
  for (const Index leaf : leaves_.leaves) {
    const Node& node = partition.nodes[leaf];
    leaf_ranges_.push_back({node.first_entry, node.first_entry + node.entry_count});
  }
}

void HdbCandidates::refresh(const Vec3& proxy) noexcept {
  if (ticks_left_ > 0) {
    --ticks_left_;
    return;
  }
  const HdbSettings& settings = surface_->settings;
  ticks_left_ = settings.ticks_per_refresh - 1;
  const Box3 box = hapticBox(proxy, settings.edges_mm);
  bool asked = true;
  switch (settings.query) {
    case HdbQuery::leaves:
      findLeaves(box);
      break;
    case HdbQuery::triangles:
      findTriangles(*surface_->partition, box, list_.hits);
      break;
    case HdbQuery::coherent:
      asked = follow(list_, *surface_->partition, box);
      break;
    case HdbQuery::linked:
      asked = moveTo(linked_, *surface_->partition, box);
  }
  queries_ += asked ? 1 : 0;
}

const std::vector<Index>& HdbCandidates::near(const Box3& box) noexcept {
  const Partition& partition = *surface_->partition;
  near_.clear();
  if (surface_->settings.query == HdbQuery::linked) {
    appendNear(linked_, partition, box, near_);
    mapToRecords();
    return near_;
  }
  for (const EntryRange& range : ranges()) {
    boxes_tested_ += range.size();
    for (Index entry = range.begin; entry < range.end; ++entry) {
      if (!partition.boxes[entry].intersects(box)) continue;
      const Index record = surface_->record_of_triangle[partition.triangles[entry]];
      if (record != kNoIndex) near_.push_back(record);
    }
  }
  return near_;
}

}  // namespace palpate::hdb
