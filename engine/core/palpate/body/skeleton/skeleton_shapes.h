// The shapes of the trunk's further bones, one at a time and before they are reduced; those of the back come from
// body/bone_shapes.h.
//
// makeSkeleton (skeleton.h) calls them, reduces, mirrors and places the results. Only right sides are drawn: a bone in
// the midline is its right half, open in the plane x = 0. Millimetres of a man of 1750 mm, body
// frame unless said otherwise.
#pragma once

#include <array>
#include <span>

#include "palpate/body/bone_shapes.h"

namespace palpate::body {

// Rows of the back's tables as the closed skin of the trunk wants them (trunk_rows.cpp).

/// T1 to L5: those of the back with spinous processes shortened by up to 4 mm.
std::span<const VertebraRow, kVertebraCount> trunkSpineRows();
/// Ribs 1 to 12: those of the back, narrower or deeper by a little where the chest is near.
std::span<const RibRow, kRibCount> trunkRibRows();
/// Place of the scapula: that of the back moved so that the acromion stays under the skin.
ScapulaPlace trunkScapulaPlace();

/// Rounds of relaxOnSurface before the reduction.
inline constexpr int kSkeletonRelaxRounds = 3;

// C5, C6, C7 (cervical.cpp).

inline constexpr int kCervicalCount = 3;
std::span<const VertebraRow, kCervicalCount> cervicalRows();
/// The right half in the vertebra's own frame.
mesh::TriangleMesh makeCervicalHalf(const VertebraRow& row, double cell_mm);
/// The dorsal end of the spinous process in the midline, own frame; of a bifid one the middle between its two ends.
Vec3 cervicalSpinousTip(const VertebraRow& row);

// Sacrum with coccyx (sacrum.cpp).

mesh::TriangleMesh makeSacrumHalf(double cell_mm);
/// Signed distance to it, about exact near the surface: the hip bone keeps clear of it.
double sacrumDistance(const Vec3& p);
struct SacrumPoints {
  std::array<Vec3, 3> median_crest;  ///< spinous tubercles of S1, S2, S3
  Vec3 promontory, coccyx_tip;
};
SacrumPoints sacrumPoints();

// Hip bone (hip_bone.cpp).

mesh::TriangleMesh makeRightHip(double cell_mm);
struct HipPoints {
  Vec3 anterior_superior_spine, posterior_superior_spine, crest_top, ischial_tuberosity, pubic_tubercle;
};
HipPoints rightHipPoints();

// Sternum (sternum.cpp) and costal cartilages (cartilages.cpp).

mesh::TriangleMesh makeSternumHalf(double cell_mm);
/// The notch where the right cartilage `number` in 1..7 meets the edge of the sternum.
Vec3 sternalNotch(int number);
struct SternumPoints {
  Vec3 jugular_notch, sternal_angle, xiphoid_tip;  ///< on the front; the notch is its lowest upper edge
};
SternumPoints sternumPoints();

inline constexpr int kCartilageCount = 10;
/// The right cartilage of rib `number` in 1..10: from the rib's end to the sternum, of 8 to 10 to the cartilage above.
mesh::TriangleMesh makeRightCartilage(int number, double edge_mm);
/// The rib's outer face where its cartilage begins.
Vec3 rightCostochondralPoint(int number);
/// End of ribs 1 to 10 of the trunk where their cartilage begins, radius of the edge.
inline constexpr SweptEnd kCostochondralEnd{1.2};

// The shoulder (clavicle.cpp, humerus.cpp).

/// The most lateral point of the acromion's upper face.
Vec3 rightAcromionTip();

mesh::TriangleMesh makeRightClavicle(double edge_mm);
/// A ball around the clavicle's sternal end that the manubrium leaves free.
struct Ball {
  Vec3 centre;
  double radius;
};
Ball sternoclavicularSocket();
struct ClaviclePoints {
  Vec3 sternal_end, acromial_end;  ///< on the upper face
};
ClaviclePoints rightClaviclePoints();

/// Centre of the humeral head, at the scapula's socket.
Vec3 rightHumeralHead();
mesh::TriangleMesh makeRightHumerus(double cell_mm);
/// The most lateral point of the greater tubercle.
Vec3 rightGreaterTubercle();

}  // namespace palpate::body
