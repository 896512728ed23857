// Which tissue and which force law a scene comes to, and what stands in the way of layers where it asks for them.
//
// Layers have curves, regions and a law of their own. A scene that writes a profile, a region or a printed form of
// either cannot have both: it gets the half Gaussian and, with the law "layered", Hooke's. Reports and panels name what
// acts (describe), World::notes say why (tissueNote).
#pragma once

#include <string>
#include <vector>

#include "palpate/deform/forms.h"
#include "palpate/scene/deformation_settings.h"
#include "palpate/tissue/force_law.h"

namespace palpate::scene {

struct Scene;

struct TissueChoice {
  TissueModel model = TissueModel::layered;                      ///< that acts
  tissue::ForceLaw::Kind law = tissue::ForceLaw::Kind::layered;  ///< likewise
  /// The keys of the scene that rule out the layers it asks for, or that the body has no bones. Empty if the tissue is
  /// the one that the scene asks for.
  std::vector<std::string> instead_of_layers = {};
  bool has_bones = true;
};

/// `forms`: formsOf(scene).
TissueChoice tissueChoice(const Scene& scene, const deform::FormSettings& forms, bool has_bones);

/// "layered tissue, force by its layers", "half-Gaussian tissue, force F = k d"
std::string describe(const TissueChoice& choice);

/// A line for World::notes: what the scene does not get that it asks for, why, and how stiff the body is now; empty
/// where it gets what it asks for, and for a mesh without bones, which never has layers.
std::string tissueNote(const Scene& scene, const TissueChoice& choice, const std::vector<double>& stiffness_n_per_mm);

}  // namespace palpate::scene
