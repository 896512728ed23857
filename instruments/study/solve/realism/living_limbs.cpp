// Stacks of a few covers, shares of fat and skins are solved where a test needs them; between them the logarithm of the
// stiffness is linear in the logarithm of the cover, in the share and in the skin.
#include "solve/realism/living_limbs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "palpate/base/order_statistics.h"
#include "palpate/elements/probe_solver.h"
#include "palpate/tissue/published.h"

namespace palpate::lab {

namespace {

constexpr std::array kCoversMm = {8.0, 12.0, 18.0, 27.0, 40.0, 60.0, 100.0};
constexpr std::array kFatShares = {0.04, 0.15, 0.4, 0.7};
constexpr std::array kSkinsMm = {1.0, 2.0};
constexpr double kBodySkinMm = 2.0;

struct Bracket {
  std::size_t low = 0;
  double share = 0.0;  ///< weight of the upper one
};

template <std::size_t N>
Bracket bracketIn(const std::array<double, N>& ladder, double value, double (*scale)(double)) {
  value = std::clamp(value, ladder.front(), ladder.back());
  const auto above = std::upper_bound(ladder.begin() + 1, ladder.end() - 1, value);
  const auto low = static_cast<std::size_t>(above - ladder.begin()) - 1;
  return {low, (scale(value) - scale(ladder[low])) / (scale(ladder[low + 1]) - scale(ladder[low]))};
}

double identity(double value) { return value; }
double logarithm(double value) { return std::log(value); }

/// The solved stacks of one site, as far as needed.
class SolvedLimb {
 public:
  SolvedLimb(double bone_radius_mm, double muscle_kpa) : bone_radius_mm_(bone_radius_mm), muscle_kpa_(muscle_kpa) {}

  double stiffness(double cover_mm, double skin_mm, double fat_mm) {
    const Bracket cover = bracketIn(kCoversMm, cover_mm, logarithm);
    const Bracket fat = bracketIn(kFatShares, fat_mm / (cover_mm - skin_mm), identity);
    const Bracket skin = bracketIn(kSkinsMm, skin_mm, identity);
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const auto weight = [&](const Bracket& bracket, bool upper) {
        return upper ? bracket.share : 1.0 - bracket.share;
      };
      const std::array<bool, 3> upper = {(corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0};
      const double share = weight(cover, upper[0]) * weight(fat, upper[1]) * weight(skin, upper[2]);
      if (share == 0.0) continue;
      sum += share * std::log(solved(cover.low + (upper[0] ? 1 : 0), fat.low + (upper[1] ? 1 : 0),
                                     skin.low + (upper[2] ? 1 : 0)));
    }
    return std::exp(sum);
  }

 private:
  double solved(std::size_t cover, std::size_t fat, std::size_t skin) {
    const auto [found, fresh] = solved_.try_emplace({cover, fat, skin}, 0.0);
    if (fresh) {
      const double under_skin = kCoversMm[cover] - kSkinsMm[skin];
      const tissue::LayerStack stack{{{"skin", kSkinsMm[skin], tissue::defaultModulus("skin")},
                                      {"fat", kFatShares[fat] * under_skin, tissue::defaultModulus("fat")},
                                      {"muscle", (1.0 - kFatShares[fat]) * under_skin, muscle_kpa_}}};
      elements::ProbeSettings probe;
      probe.length_mm = kProbeLengthMm;
      probe.width_mm = kProbeAreaMm2 / kProbeLengthMm;
      probe.bone_radius_mm = bone_radius_mm_;
      probe.fineness = 0.7;  // 3 % too stiff against a mesh half as wide again; a tenth of what people differ by
      found->second = elements::probeStiffness(stack, probe);
    }
    return found->second;
  }

  double bone_radius_mm_;
  double muscle_kpa_;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, double> solved_;
};

double medianError(const std::vector<double>& ratios, double factor) {
  std::vector<double> errors;
  errors.reserve(ratios.size());
  for (const double ratio : ratios) errors.push_back(std::abs(factor * ratio - 1.0));
  return medianOf(std::move(errors));
}

}  // namespace

LivingFigures livingFigures(std::span<const LivingTest> tests, std::span<const double> n_per_mm) {
  LivingFigures figures;
  figures.tests = tests.size();
  std::vector<double> ratios;
  std::array<std::vector<double>, kCoverLimitsMm.size() - 1> by_cover;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    ratios.push_back(n_per_mm[i] / tests[i].n_per_mm);
    for (std::size_t c = 0; c < by_cover.size(); ++c) {
      const bool inside = tests[i].cover_mm >= kCoverLimitsMm[c] && tests[i].cover_mm < kCoverLimitsMm[c + 1];
      if (inside) by_cover[c].push_back(ratios.back());
    }
  }
  if (ratios.empty()) return figures;
  const double ratio = medianOf(ratios);
  figures.median_error = medianError(ratios, 1.0);
  figures.bias = ratio - 1.0;
  figures.spread_error = medianError(ratios, 1.0 / ratio);
  for (std::size_t c = 0; c < by_cover.size(); ++c) {
    figures.covers[c] = {.ratio = medianOf(by_cover[c]), .tests = by_cover[c].size()};
  }
  return figures;
}

std::vector<double> probeStiffnesses(std::span<const LivingTest> tests, LimbModel model, const Progress& progress) {
  const double default_muscle = tissue::defaultModulus("muscle");
  std::map<std::tuple<double, double>, SolvedLimb> limbs;
  std::vector<double> result;
  for (const LivingTest& test : tests) {
    report(progress, "pressing the probe", static_cast<double>(result.size()) / static_cast<double>(tests.size()));
    const LimbSite& site = *siteNamed(test.site);
    const double radius = model == LimbModel::body ? 0.0 : site.bone_radius_mm;
    const double muscle = model == LimbModel::relaxed_limb ? site.muscle_kpa : default_muscle;
    SolvedLimb& limb = limbs.try_emplace({radius, muscle}, radius, muscle).first->second;
    const double skin = model == LimbModel::body ? kBodySkinMm : test.skin_mm;
    result.push_back(limb.stiffness(test.cover_mm, skin, test.fat_mm));
  }
  return result;
}

}  // namespace palpate::lab
