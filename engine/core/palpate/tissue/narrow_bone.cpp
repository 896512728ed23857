// The table of docs/explanation/tissue.md, of both depths the geometric mean, straight between thicknesses and
// between curvatures.
#include "palpate/tissue/narrow_bone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

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

/// How hard a tissue of any thickness pushes back at both depths, N/mm, at thicknesses that follow each other: where it
/// pushes back as hard as wanted is then found without solving, forty times as fast.
class MeanSecants {
 public:
  explicit MeanSecants(const LayeredTissue& tissue) : thinnest_mm_(tissue.thinnest()), thickest_mm_(tissue.thickest()) {
    const auto steps = static_cast<std::size_t>(std::ceil((thickest_mm_ - thinnest_mm_) / kStepMm));
    n_per_mm_.reserve(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) {
      const double thickness_mm = thinnest_mm_ + kStepMm * static_cast<double>(i);
      n_per_mm_.push_back(
          std::sqrt(tissue.secantAt(thickness_mm, kLightDepthMm) * tissue.secantAt(thickness_mm, kFirmDepthMm)));
    }
  }

  double at(double thickness_mm) const {
    const double place = (std::clamp(thickness_mm, thinnest_mm_, thickest_mm_) - thinnest_mm_) / kStepMm;
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= n_per_mm_.size()) return n_per_mm_.back();
    return n_per_mm_[below] + (place - static_cast<double>(below)) * (n_per_mm_[below + 1] - n_per_mm_[below]);
  }

  /// The thinnest that pushes back no harder; the thickest where all do.
  double thicknessOf(double wanted_n_per_mm) const {
    const auto above = std::lower_bound(n_per_mm_.begin(), n_per_mm_.end(), wanted_n_per_mm, std::greater{});
    if (above == n_per_mm_.begin()) return thinnest_mm_;
    if (above == n_per_mm_.end()) return thickest_mm_;
    const double softer = *above;
    const double harder = *std::prev(above);
    const double steps =
        static_cast<double>(above - n_per_mm_.begin()) - (wanted_n_per_mm - softer) / (harder - softer);
    return std::min(thickest_mm_, thinnest_mm_ + kStepMm * steps);
  }

 private:
  /// The stacks that were solved are whole millimetres thick, and so are among these. Forces are within 1e-6.
  static constexpr double kStepMm = 1.0 / 128;

  double thinnest_mm_, thickest_mm_;
  std::vector<double> n_per_mm_;
};

}  // namespace

double shareOverNarrowBone(double thickness_mm, double bone_radius_mm) noexcept {
  const Between<kCovers> cover(kCoverMm, thickness_mm);
  const Between<kBones> bone(kCurvature, 1.0 / bone_radius_mm);
  const double below = onRow(kShare[cover.below], bone);
  const double share = below + cover.share * (onRow(kShare[cover.below + 1], bone) - below);
  const double deep = (kDeepBoneMm - thickness_mm) / (kDeepBoneMm - kCoverMm.back());
  return 1.0 - (1.0 - share) * std::clamp(deep, 0.0, 1.0);
}

std::vector<double> feltThicknesses(const LayeredTissue& tissue, std::span<const double> thickness_mm,
                                    std::span<const float> bone_radius_mm) {
  const MeanSecants secants(tissue);
  std::vector<double> felt(thickness_mm.begin(), thickness_mm.end());
  for (std::size_t i = 0; i < felt.size(); ++i) {
    const double share = shareOverNarrowBone(felt[i], static_cast<double>(bone_radius_mm[i]));
    if (share < 1.0) felt[i] = std::max(felt[i], secants.thicknessOf(share * secants.at(felt[i])));
  }
  return felt;
}

}  // namespace palpate::tissue
