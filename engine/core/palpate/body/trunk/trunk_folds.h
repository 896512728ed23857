// Details for which the fitted skin is too smooth: gluteal and axillary folds, the navel and the belly, collar bones
// and the lines of neck and shoulder.
//
// trunk_field.h -> here -> trunk.cpp. Strokes along lines on the fitted skin move its vertices and leave the triangles
// unchanged; away from a stroke nothing moves by a bit. So the back that is palpated, from the neck to the sacrum
// between the armpits, is the fitted one. Amounts are ours, by eye, a man of 1750 mm.
#pragma once

#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/body/skin_surface.h"
#include "palpate/body/trunk/trunk_field.h"

namespace palpate::body {

/// The shares of each fold that posture and build leave, 0 to 1.
struct FoldAmounts {
  double gluteal = 1;  ///< bent hips stretch it
  double belly = 1;    ///< its roundness: fat makes one of its own, and a thin belly is flat
};

class TrunkFolds {
 public:
  TrunkFolds(const TrunkField& field, const FoldAmounts& amounts);

  /// Displacement of a point of the fitted skin, mm; exactly zero away from all folds.
  Vec3 at(const SkinPoint& fitted) const;

 private:
  /// A line on the skin and what it does to skin within `reach_mm` of it.
  struct Stroke {
    std::vector<Vec3> line;        // on the right side; both sides have it
    std::vector<double> strength;  // one per point of the line: it fades out towards free ends
    Eigen::AlignedBox3d box;       // nothing outside of it moves
    double reach_mm;
    double out_mm;    // along the normal
    Vec3 shift_mm;    // the same everywhere along it
    double gathered;  // share of the way to the line, so that the mesh is finer in a crease
  };
  static void move(const Stroke& stroke, const SkinPoint& right, Vec3& moved);

  std::vector<Stroke> strokes_;
};

}  // namespace palpate::body
