// The skeleton of the trunk: neck from C5, spine, sacrum and pelvis, rib cage with cartilages and sternum, shoulders.
//
// The bones of the back (bones.h) are a part of it, from the same shapes; here are those around them. At 1750 mm,
// symmetric and upright: what a trunk does about stature, build and posture it does to skin and bones alike.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/body/bones.h"

namespace palpate::body {

inline constexpr std::size_t kSkeletonBoneCount = 74;

struct SkeletonSettings {
  std::size_t triangles = 24000;  ///< all bones together, exact; even; at least kFewestSkeletonTriangles
  double cell_mm = 0.0;           ///< grid of the mesher before the reduction; 0: fits the triangles
};

/// Fewest triangles of all bones together that still read as bones.
inline constexpr std::size_t kFewestSkeletonTriangles = 6000;

/// The 74 bones, always in the same order: C5..C7, T1..T12, L1..L5, sacrum (with the coccyx), hip_right, hip_left,
/// rib_1_right..rib_12_right, the same left, cartilage_1_right..cartilage_10_right, the same left, sternum,
/// clavicle_right, clavicle_left, scapula_right, scapula_left, humerus_right, humerus_left.
///
/// Right and left are exact mirror images, those of the midline are exactly symmetric. Throws Error on wrong settings.
/// About a second; works on two threads where there are two.
std::vector<Bone> makeSkeleton(const SkeletonSettings& settings = {});

/// Shares a total out over the 74 bones in order, as shareTriangles does.
std::vector<std::size_t> shareSkeletonTriangles(std::size_t total);

/// The names of boneLandmarks, at the trunk's scapula, and:
/// spinous_C5..C7; sacrum_S1..S3 (median crest), coccyx_tip; costochondral_1_right..10_left; of each side
/// psis, asis, iliac_crest_top, ischial_tuberosity, pubic_tubercle, acromion, greater_tubercle (psis_right ...) and
/// clavicle_right_sternal_end, clavicle_right_acromial_end; jugular_notch, sternal_angle, xiphoid_tip.
std::vector<Landmark> skeletonLandmarks();

}  // namespace palpate::body
