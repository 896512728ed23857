// The table of docs/explanation/tissue-solver.md at 5 mm, straight between thicknesses and between curvatures.
#include "palpate/tissue/narrow_bone.h"

#include <algorithm>
#include <array>

namespace palpate::tissue {

namespace {

constexpr std::size_t kCovers = 5;
constexpr std::size_t kBones = 7;

constexpr std::array<double, kCovers> kCoverMm = {9.0, 11.0, 13.0, 16.0, 20.0};
/// 1 / radius, from flat to 3 mm.
constexpr std::array<double, kBones> kCurvature = {1.0 / kFlatBoneMm, 1.0 / 40, 1.0 / 20, 1.0 / 12,
                                                   1.0 / 8,           1.0 / 5,  1.0 / 3};
/// `palpate tissue solve ... --bone-radius-mm R --depths 2,5 --no-drag`
constexpr std::array<std::array<double, kBones>, kCovers> kShare = {{{1.0, 0.87, 0.80, 0.73, 0.66, 0.59, 0.53},
                                                                     {1.0, 0.90, 0.83, 0.77, 0.73, 0.67, 0.63},
                                                                     {1.0, 0.92, 0.86, 0.81, 0.77, 0.73, 0.70},
                                                                     {1.0, 0.93, 0.88, 0.84, 0.82, 0.79, 0.76},
                                                                     {1.0, 0.94, 0.90, 0.87, 0.85, 0.83, 0.81}}};

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
  const double wanted = share * tissue.secantAt(thickness_mm, kSharedDepthMm);
  double low = thickness_mm;
  double high = std::max(thickness_mm, tissue.thickest());
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (tissue.secantAt(middle, kSharedDepthMm) > wanted ? low : high) = middle;
  }
  return low;
}

}  // namespace palpate::tissue
