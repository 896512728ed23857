// Asks the partition for the triangles round the proxy when it is the box's turn, and gives out those near a motion.
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
  const auto& source = surface.tree.source_triangle;
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
  leaves_.prepareFor(partition);
  reserveTouched(leaves_.leaves, partition.leaves.size());
  reserveTouched(leaf_ranges_, partition.leaves.size());
  list_.prepareFor(partition);
  reserveTouched(near_, partition.triangles.size());
}

const std::vector<EntryRange>& HdbCandidates::ranges() const {
  return surface_->settings.query == HdbQuery::leaves ? leaf_ranges_ : list_.hits.ranges;
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
  }
  queries_ += asked ? 1 : 0;
}

const std::vector<Index>& HdbCandidates::near(const Box3& box) noexcept {
  const Partition& partition = *surface_->partition;
  near_.clear();
  for (const EntryRange& range : ranges()) {
    for (Index entry = range.begin; entry < range.end; ++entry) {
      if (!partition.boxes[entry].intersects(box)) continue;
      const Index record = surface_->record_of_triangle[partition.triangles[entry]];
      if (record != kNoIndex) near_.push_back(record);
    }
  }
  return near_;
}

}  // namespace palpate::hdb
