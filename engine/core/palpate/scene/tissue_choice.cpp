// Asked once a build, before the stiffness map, which is the layers' own where there are layers.
#include "palpate/scene/tissue_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "palpate/scene/errata.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

using LawKind = tissue::ForceLaw::Kind;

/// Printed forms of the curves and regions that layers have of their own. The others of the deformation (E14, E19, E23)
/// act on any curve and region, layered ones too.
constexpr Erratum kOfTheHalfGaussian[] = {Erratum::E15_aspect, Erratum::E18_profile_rim, Erratum::E21_press_region};

void addPrintedForms(const Fidelity& fidelity, std::vector<std::string>& keys) {
  if (fidelity == literalFidelity()) {
    keys.emplace_back("fidelity = \"literal\"");
    return;
  }
  for (const Erratum erratum : kOfTheHalfGaussian) {
    if (fidelity.literal(erratum)) keys.push_back(fmt::format("fidelity.{} = \"literal\"", nameOf(erratum)));
  }
}

/// `prefix`: "" or "tangential_".
void addProfile(const tissue::ProfileSettings& profile, std::string_view prefix, std::vector<std::string>& keys) {
  const tissue::ProfileSettings usual;
  if (profile.kind != usual.kind) {
    keys.push_back(fmt::format("deformation.{}profile = \"{}\"", prefix, wordFor(profile.kind)));
  } else if (profile.rim != usual.rim) {
    keys.push_back(fmt::format("deformation.{}profile_rim = \"{}\"", prefix, wordFor(profile.rim)));
  }
}

void addNumber(std::string_view key, double value, double usual, std::vector<std::string>& keys) {
  if (value != usual) keys.push_back(fmt::format("deformation.{} = {}", key, value));
}

/// The keys that ask for something else than layers.
std::vector<std::string> otherThanLayers(const deform::FormSettings& forms) {
  const deform::TissueSettings usual;
  std::vector<std::string> keys;
  addPrintedForms(forms.fidelity, keys);
  addProfile(forms.normal_profile, "", keys);
  addProfile(forms.tangential_profile, "tangential_", keys);
  addNumber("radial_share", forms.radial.share, 0.0, keys);
  if (forms.region != deform::NormalRegion::linear) {
    keys.push_back(fmt::format("deformation.region = \"{}\"", wordFor(forms.region)));
  }
  const deform::TissueSettings& dent = forms.common.tissue;
  addNumber("normal_radius_mm", dent.normal_radius_mm, usual.normal_radius_mm, keys);
  addNumber("normal_radius_per_depth", dent.normal_radius_per_depth, usual.normal_radius_per_depth, keys);
  return keys;
}

TissueModel withoutLayers(const Fidelity& fidelity) {
  const bool printed = fidelity.literal(Erratum::E18_profile_rim) && fidelity.literal(Erratum::E21_press_region);
  return printed ? TissueModel::literal : TissueModel::gaussian;
}

// In the order of TissueModel and of ForceLaw::Kind.
constexpr std::array<std::string_view, 3> kTissueNames = {"layered tissue", "half-Gaussian tissue",
                                                          "half-Gaussian tissue as printed"};
constexpr std::array<std::string_view, 5> kLawNames = {"force F = k d", "force by a power of the depth",
                                                       "force of a stiffness that grows with depth", "force by a table",
                                                       "force by its layers"};
static_assert(kTissueNames.size() == WordsOf<TissueModel>::kAll.size() &&
              kLawNames.size() == WordsOf<LawKind>::kAll.size());

}  // namespace

TissueChoice tissueChoice(const Scene& scene, const deform::FormSettings& forms, bool has_bones) {
  TissueChoice choice{.model = scene.deformation.tissue, .law = scene.tissue.force_law.kind, .has_bones = has_bones};
  if (choice.model == TissueModel::layered) {
    choice.instead_of_layers = otherThanLayers(forms);
    if (!has_bones) choice.instead_of_layers.emplace_back("a body without bones");
    if (choice.instead_of_layers.empty()) return choice;
  }
  choice.model = withoutLayers(forms.fidelity);
  if (choice.law == LawKind::layered) choice.law = LawKind::linear;
  return choice;
}

std::string describe(const TissueChoice& choice) {
  return fmt::format("{}, {}", kTissueNames[static_cast<std::size_t>(choice.model)],
                     kLawNames[static_cast<std::size_t>(choice.law)]);
}

std::string tissueNote(const Scene& scene, const TissueChoice& choice, const std::vector<double>& stiffness_n_per_mm) {
  const bool other_tissue = !choice.instead_of_layers.empty();
  const bool other_law = choice.law != scene.tissue.force_law.kind;
  if ((!other_tissue && !other_law) || !choice.has_bones) return {};
  const std::string why = other_tissue ? fmt::format("{}", fmt::join(choice.instead_of_layers, ", "))
                                       : fmt::format("deformation.tissue = \"{}\"", wordFor(choice.model));
  const auto [soft, stiff] = std::minmax_element(stiffness_n_per_mm.begin(), stiffness_n_per_mm.end());
  return fmt::format(
      "no layers because of {}: {}, stiffness {:.2f} to {:.2f} N/mm (docs/reference/scene-files.md, tissue)", why,
      describe(choice), *soft, *stiff);
}

}  // namespace palpate::scene
