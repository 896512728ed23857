// Keeps the list while the detecting box stays inside the queried box, and queries again when it leaves.
//
// Data flow: detecting box of a tick -> here -> haptic_box.h now and then -> ranges of entries -> hdb_candidates.
// Based on: Ji, dissertation 2008, 6.2 (4).
#include "palpate/hdb/coherent_list.h"

namespace palpate::hdb {

void CoherentList::prepareFor(const Partition& partition) {
  hits.prepareFor(partition);
  hits.ranges.clear();
  covered.setEmpty();
}

bool follow(CoherentList& list, const Partition& partition, const Box3& box, double margin) noexcept {
  if (list.covered.contains(box)) return false;
  const Vec3 reach = margin * box.sizes();
  list.covered = Box3(box.min() - reach, box.max() + reach);
  findTriangles(partition, list.covered, list.hits);
  ++list.refreshes;
  return true;
}

}  // namespace palpate::hdb
