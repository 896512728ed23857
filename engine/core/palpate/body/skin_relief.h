// Relief of the bones through the skin: a layer of detail on top of the smooth surface.
//
// For each group of bones, a bump that decays with the distance from the skin to the nearest of them, blurred as soft
// tissue blurs it, less most of a wider blur so that the mean surface stays where it was measured. Computed once on a
// coarse grid over the whole skin; the result is a spline, so the triangles drawn later may be of any density.
#pragma once

#include <array>
#include <span>

#include "palpate/body/bicubic_spline.h"
#include "palpate/body/bones.h"
#include "palpate/body/skin_surface.h"

namespace palpate::body {

/// Strength of a group of bones at four parts of the back, blended between them: T1-T2, T3-T9, T10-L2, L3-L5.
using LevelWeights = std::array<double, 4>;

/// Factors: 0 is none, 1 a lean standing man, 2 an emaciated one.
struct ReliefSettings {
  double spine = 1;     ///< spinous processes
  double ribs = 1;      ///< ribs
  double scapulae = 1;  ///< shoulder blades
  /// Real backs show the spine at the neck and at the thoracolumbar junction more than between the shoulder blades.
  LevelWeights spine_level = {1.2, 0.7, 1.0, 0.7};
  LevelWeights rib_level = {1, 1, 1, 1};
  LevelWeights scapula_level = {1, 1, 1, 1};

  bool any() const { return spine != 0 || ribs != 0 || scapulae != 0; }
};

/// Triangles of bones that are good enough for their relief: more change it by 0.15 mm at most; with half as many a
/// spinous process may lose its tip.
inline constexpr std::size_t kReliefBoneTriangles = 8000;

/// No relief at all: the fitted surface alone.
ReliefSettings noRelief();

/// The addition to the radius of the skin, mm of a man of 1750 mm: relief of `bones` (that man's, not warped) and the
/// uneven muscles along the spine times `muscle_asymmetry`.
BicubicSpline skinDetail(std::span<const Bone> bones, const ReliefSettings& settings, double muscle_asymmetry);

}  // namespace palpate::body
