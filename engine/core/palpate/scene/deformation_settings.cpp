// Reads the files that forms name and adds what other tables say of them: fidelity and the kind of strain.
// Data flow: Scene -> here, first of all in scene::build, so that a missing file is told at once -> World.
#include "palpate/scene/deformation_settings.h"

#include "palpate/maps/contour_map.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/user_profile.h"

namespace palpate::scene {

namespace {

void readKnots(const std::filesystem::path& file, tissue::ProfileSettings& profile) {
  if (profile.kind == tissue::ProfileKind::user && !file.empty()) profile.knots = tissue::readProfileKnots(file);
}

}  // namespace

deform::FormSettings formsOf(const Scene& scene) {
  deform::FormSettings forms = scene.deformation.forms;
  readKnots(scene.deformation.profile_file, forms.normal_profile);
  readKnots(scene.deformation.tangential_profile_file, forms.tangential_profile);
  forms.strain_kind = scene.strain.kind;
  forms.fidelity = scene.fidelity;
  if (scene.deformation.tissue == TissueModel::literal) {
    forms.fidelity.setLiteral(Erratum::E18_profile_rim);
    forms.fidelity.setLiteral(Erratum::E21_press_region);
  }
  return forms;
}

std::optional<maps::PolarContourMap> contoursOf(const Scene& scene, const maps::EllipseMapSettings& settings) {
  const std::filesystem::path& file = scene.deformation.contours;
  if (scene.deformation.forms.shape != deform::Shape::contour || file.empty()) return std::nullopt;
  return maps::PolarContourMap(maps::readContourPoints(file), settings);
}

}  // namespace palpate::scene
