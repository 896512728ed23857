// The tables of the back (spine_line.cpp, ribs.cpp, scapula.cpp) as the trunk uses them.
//
// The skin of the back was fitted to another shape of the same person than the closed skin of the trunk, which is up to
// 2.3 mm deeper over the thoracic spine and narrower in front of the upper ribs. So a few lengths differ, measured
// against that skin: spinous tips at least 6 mm below it (7.8 at T1), ribs at least 6. All of it is our choice.
#include <algorithm>

#include "palpate/body/skeleton/skeleton_shapes.h"

namespace palpate::body {
namespace {

// The difference of a spinous process to that of the back (mm), T1 to L5.
constexpr std::array<double, kVertebraCount> kShorter = {0.0, 0.4, 1.0, 2.4, 1.9, 3.8, 4.0, 3.3, 2.4,
                                                         2.0, 1.3, 0.8, 0.0, 0.0, 0.0, 0.5, 1.1};

std::array<VertebraRow, kVertebraCount> spineOfTrunk() {
  std::array<VertebraRow, kVertebraCount> rows{};
  std::copy(spineRows().begin(), spineRows().end(), rows.begin());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].spinous_length -= kShorter[i];
  return rows;
}

std::array<RibRow, kRibCount> ribsOfTrunk() {
  std::array<RibRow, kRibCount> rows{};
  std::copy(ribRows().begin(), ribRows().end(), rows.begin());
  // The first rib is lower and deeper in front: the clavicle passes over it.
  rows[0].lateral_drop = 39.0, rows[0].lateral_z = -9.0;
  rows[0].anterior_x = 43.0, rows[0].anterior_drop = 51.0, rows[0].anterior_z = -35.0;
  rows[7].half_width = 136.0;
  rows[8].half_width = 134.0;
  // The lower ends point less downwards, so that their cartilages turn up in a bow and not in a kink.
  rows[7].anterior_x = 104.0, rows[7].anterior_drop = 101.0;
  rows[8].anterior_x = 110.0, rows[8].anterior_drop = 105.0;
  rows[9].anterior_x = 110.0, rows[9].anterior_drop = 105.0;
  return rows;
}

}  // namespace

std::span<const VertebraRow, kVertebraCount> trunkSpineRows() {
  static const std::array<VertebraRow, kVertebraCount> rows = spineOfTrunk();
  return rows;
}

std::span<const RibRow, kRibCount> trunkRibRows() {
  static const std::array<RibRow, kRibCount> rows = ribsOfTrunk();
  return rows;
}

ScapulaPlace trunkScapulaPlace() { return kScapulaPlaceOfBack; }

}  // namespace palpate::body
