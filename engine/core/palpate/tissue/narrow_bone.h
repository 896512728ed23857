// Tissue over a narrow bone feels softer than over a wide one: it gives way beside it.
//
//   thickness, radius of the bone ─ shareOverNarrowBone ─► share of the force over a plane
//                                 ─ feltThicknesses ─► the thickness over a plane that pushes back as hard
//
// Solved in 3D once (elements/, docs/explanation/tissue.md, "Narrow bone"), by a sphere of 8 mm over a post with
// a round top.
#pragma once

#include <span>
#include <vector>

#include "palpate/tissue/layered_tissue.h"

namespace palpate::tissue {

/// mm, of bone that is flat; what is wider counts as flat.
inline constexpr double kFlatBoneMm = 1e3;

/// Under this much tissue the width of a bone cannot be felt, mm.
inline constexpr double kDeepBoneMm = 30.0;

/// The depths that were solved, mm. The share is their geometric mean, and in that mean both thicknesses push back
/// alike: thicker tissue loses more of a light press than tissue over a narrow bone, and less of a firm one.
inline constexpr double kLightDepthMm = 2.0;
inline constexpr double kFirmDepthMm = 5.0;

/// Share of the force over a plane, in (0, 1], for a thickness and a radius of the bone in mm, both > 0. Continuous.
/// Less than 9 mm of tissue and a radius of less than 3 mm were not solved: they count as those. From 20 mm, the
/// thickest that was solved, the share rises to 1 at kDeepBoneMm.
double shareOverNarrowBone(double thickness_mm, double bone_radius_mm) noexcept;

/// mm, of each place, whose thickness and radius are given; never less than the thickness itself. Load time: some
/// milliseconds for 30,000 places.
std::vector<double> feltThicknesses(const LayeredTissue& tissue, std::span<const double> thickness_mm,
                                    std::span<const float> bone_radius_mm);

}  // namespace palpate::tissue
