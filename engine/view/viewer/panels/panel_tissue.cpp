// Stiffness of the body and deformation of its skin.
#include <imgui.h>

#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

/// In layered tissue the depth of the bone gives the stiffness by the layers themselves.
void stiffnessWidgets(const SceneKeys& keys, bool has_bones, bool is_layered) {
  if (has_bones) keyWidget(keys, {"deformation", "tissue", "over the bones"});
  if (is_layered) keyWidget(keys, {"tissue", "fat_mm", "fat (0: by weight)", 0.0, 40.0, "%.1f mm"});
  keyWidget(keys, {"stiffness", "source", "stiffness from"});
  const auto source = keys.scene.stiffness.source;
  const bool by_depth =
      source == scene::StiffnessSource::depth || (source == scene::StiffnessSource::automatic && has_bones);
  if (by_depth && is_layered) return;
  if (by_depth) {
    keyWidget(keys, {"stiffness", "soft_n_per_mm", "far from bone", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(keys, {"stiffness", "stiff_n_per_mm", "over bone", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(keys, {"stiffness", "fade_mm", "fades over", 1.0, 100.0, "%.0f mm"});
  } else if (source == scene::StiffnessSource::points) {
    keyWidget(keys, {"stiffness", "basic_n_per_mm", "between points", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(keys, {"stiffness", "effect_radius_mm", "points reach", 1.0, 500.0, "%.0f mm"});
  } else {
    keyWidget(keys, {"stiffness", "constant_n_per_mm", "stiffness", 0.05, 5.0, "%.2f N/mm"});
  }
}

/// Keys of the force law and of the profile that belong to the chosen kind only are refused by the scene when they do
/// not fit; they are shown all the same.
void lawWidgets(const SceneKeys& keys) {
  keyWidget(keys, {"tissue", "force_law", "force law"});
  keyWidget(keys, {"tissue", "exponent", "exponent", 1.0, 3.0});
}

/// Layers determine the radius of a dent.
void capWidgets(const SceneKeys& keys, bool is_layered) {
  keyWidget(keys, {"deformation", "f_adj", "skin looseness", 0.2, 2.0});
  keyWidget(keys, {"deformation", "normal_cap_mm", "deepest dent", 0.0, 40.0, "%.1f mm"});
  keyWidget(keys, {"deformation", "tangential_cap_mm", "farthest drag", 0.0, 60.0, "%.1f mm"});
  if (is_layered) return;
  keyWidget(keys, {"deformation", "normal_radius_mm", "dent radius", 1.0, 60.0, "%.1f mm"});
  keyWidget(keys, {"deformation", "normal_radius_per_depth", "grows per mm", 0.0, 5.0, "%.2f mm"});
}

void ellipseWidgets(const SceneKeys& keys) {
  keyWidget(keys, {"ellipses", "effect_radius_mm", "key points reach", 1.0, 500.0, "%.0f mm"});
  keyWidget(keys, {"ellipses", "basic_radius_mm", "reach elsewhere", 0.0, 300.0, "%.0f mm"});
}

}  // namespace

void tissuePanel(const TissuePanel& panel, UiOutput& output) {
  const SceneKeys keys{panel.scene, output};
  const bool is_layered = panel.has_bones && panel.scene.deformation.tissue == scene::TissueModel::layered;
  stiffnessWidgets(keys, panel.has_bones, is_layered);
  lawWidgets(keys);
  ImGui::Separator();
  capWidgets(keys, is_layered);
  keyWidget(keys, {"deformation", "shape", "shape of the dent"});
  keyWidget(keys, {"deformation", "profile", "profile"});
  profileCurve(panel.scene.deformation.forms.normal_profile, panel.profile, output);
  ImGui::Separator();
  ellipseWidgets(keys);
  otherKeys(keys, "deformation");
  otherKeys(keys, "tissue");
}

}  // namespace palpate::viewer
