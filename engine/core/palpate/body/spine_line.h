// The spine of a man of 1750 mm: the dimensions of T1 to L5 and where each vertebra is.
//
// One row per vertebra; everything downstream (vertebra shapes, rib heads, landmarks) reads these rows. All millimetre
// and degrees for stature 1750; makeBones scales the finished meshes.
#pragma once

#include <array>
#include <span>

#include "palpate/base/vec.h"

namespace palpate::body {

/// mm, of the person whom the tables of this folder describe. Skin and bones are built at this stature and scaled as a
/// whole to the requested one.
inline constexpr double kTableStatureMm = 1750.0;

inline constexpr int kThoracicCount = 12;
inline constexpr int kVertebraCount = 17;

struct VertebraRow {
  const char* name;
  // Body: posterior height, mean width and mean depth of both endplates.
  double height, width, depth;
  // Canal and pedicles.
  double canal_width, canal_depth, pedicle_width, pedicle_height;
  // Spinous process: free length from the lamina, angle below the local horizontal, height and thickness of its tip.
  double spinous_length, spinous_down_deg, spinous_height, spinous_thickness;
  // Transverse processes: span over both tips, angle backwards, radius of the tip.
  double transverse_span, transverse_back_deg, transverse_radius;
  // Height of the disc below.
  double disc;
  // Placement in the plane x = 0: centre of the body and forward pitch of its upper side.
  double centre_y, centre_z, pitch_deg;

  bool thoracic() const { return name[0] == 'T'; }
};

/// T1 to T12, then L1 to L5.
std::span<const VertebraRow, kVertebraCount> spineRows();

/// From a vertebra's own frame (origin at the body's centre, x right, y up, z dorsal) to the body frame.
Eigen::Isometry3d vertebraFrame(const VertebraRow& row);

}  // namespace palpate::body
