// The table of docs/explanation/tissue.md, of both depths the geometric mean, straight between thicknesses and
// between curvatures.
#include "palpate/tissue/narrow_bone.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::tissue {

namespace {

constexpr std::size_t kCovers = 5;
constexpr std::size_t kBones = 7;

constexpr std::array<double, kCovers> kCoverMm = {9.0, 11.0, 13.0, 16.0, 20.0};
/// 1 / radius, from flat to 3 mm.
constexpr std::array<double, kBones> kCurvature = {1.0 / kFlatBoneMm, 1.0 / 40, 1.0 / 20, 1.0 / 12,
                                                   1.0 / 8,           1.0 / 5,  1.0 / 3};
/// `palpate tissue solve ... --bone-radius-mm R --depths 2,5 --no-drag --fineness 2`
constexpr std::array<std::array<double, kBones>, kCovers> kShare = {{{1.0, 0.900, 0.840, 0.782, 0.728, 0.667, 0.615},
                                                                     {1.0, 0.920, 0.872, 0.826, 0.782, 0.739, 0.700},
                                                                     {1.0, 0.935, 0.894, 0.856, 0.823, 0.790, 0.762},
                                                                     {1.0, 0.944, 0.911, 0.881, 0.858, 0.832, 0.811},
                                                                     {1.0, 0.952, 0.927, 0.904, 0.886, 0.869, 0.856}}};

/// Where a value lies in rising rows; at the ends the first or last counts.
template <std::size_t N>
struct Between {
  std::size_t below = 0;
  double share = 0.0;

  Between(const std::array<double, N>& rows, double value) {
    const double kept = std::clamp(value, rows.front(), rows.back());
    while (below + 2 < N && kept > rows[below + 1]) ++below;
    share = (kept - rows[below]) / (rows[below + 1] - rows[below]);
  }
};

double onRow(const std::array<double, kBones>& row, const Between<kBones>& at) {
  return row[at.below] + at.share * (row[at.below + 1] - row[at.below]);
}

/// Of the secants at both depths, N/mm.
double meanSecant(const LayeredTissue& tissue, double thickness_mm) {
  return std::sqrt(tissue.secantAt(thickness_mm, kLightDepthMm) * tissue.secantAt(thickness_mm, kFirmDepthMm));
}

}  // namespace

double shareOverNarrowBone(double thickness_mm, double bone_radius_mm) noexcept {
  const Between<kCovers> cover(kCoverMm, thickness_mm);
  const Between<kBones> bone(kCurvature, 1.0 / bone_radius_mm);
  const double below = onRow(kShare[cover.below], bone);
  const double share = below + cover.share * (onRow(kShare[cover.below + 1], bone) - below);
  const double deep = (kDeepBoneMm - thickness_mm) / (kDeepBoneMm - kCoverMm.back());
  return 1.0 - (1.0 - share) * std::clamp(deep, 0.0, 1.0);
}

double feltThickness(const LayeredTissue& tissue, double thickness_mm, double bone_radius_mm) noexcept {
  const double share = shareOverNarrowBone(thickness_mm, bone_radius_mm);
  if (!(share < 1.0)) return thickness_mm;
  const double wanted = share * meanSecant(tissue, thickness_mm);
  double low = thickness_mm;
  double high = std::max(thickness_mm, tissue.thickest());
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (meanSecant(tissue, middle) > wanted ? low : high) = middle;
  }
  return low;
}

}  // namespace palpate::tissue
