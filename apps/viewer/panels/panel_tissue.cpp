// How hard the body is and how its skin gives way.
#include <imgui.h>

#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

void stiffnessWidgets(Session& session) {
  keyWidget(session, {"stiffness", "source", "stiffness from"});
  const auto source = session.scene.stiffness.source;
  const bool by_depth = source == scene::StiffnessSource::depth ||
                        (source == scene::StiffnessSource::automatic && session.world.has_bones);
  if (by_depth) {
    keyWidget(session, {"stiffness", "soft_n_per_mm", "far from bone", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(session, {"stiffness", "stiff_n_per_mm", "over bone", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(session, {"stiffness", "fade_mm", "fades over", 1.0, 100.0, "%.0f mm"});
  } else if (source == scene::StiffnessSource::points) {
    keyWidget(session, {"stiffness", "basic_n_per_mm", "between points", 0.05, 5.0, "%.2f N/mm"});
    keyWidget(session, {"stiffness", "effect_radius_mm", "points reach", 1.0, 500.0, "%.0f mm"});
  } else {
    keyWidget(session, {"stiffness", "constant_n_per_mm", "stiffness", 0.05, 5.0, "%.2f N/mm"});
  }
}

/// Keys of the force law and of the profile that belong to the chosen kind only are refused by the scene when they do
/// not fit; they are offered all the same, under one heading.
void lawWidgets(Session& session) {
  keyWidget(session, {"tissue", "force_law", "force law"});
  keyWidget(session, {"tissue", "exponent", "exponent", 0.5, 4.0});
  keyWidget(session, {"tissue", "knee_mm", "stiffens from", 0.5, 40.0, "%.1f mm"});
}

void capWidgets(Session& session) {
  keyWidget(session, {"deformation", "f_adj", "skin looseness", 0.2, 2.0});
  keyWidget(session, {"deformation", "normal_cap_mm", "deepest dent", 0.0, 40.0, "%.1f mm"});
  keyWidget(session, {"deformation", "tangential_cap_mm", "farthest drag", 0.0, 60.0, "%.1f mm"});
  keyWidget(session, {"deformation", "normal_radius_mm", "dent radius", 1.0, 60.0, "%.1f mm"});
  keyWidget(session, {"deformation", "normal_radius_per_depth", "grows per mm", 0.0, 5.0, "%.2f mm"});
}

void ellipseWidgets(Session& session) {
  keyWidget(session, {"ellipses", "effect_radius_mm", "key points reach", 1.0, 500.0, "%.0f mm"});
  keyWidget(session, {"ellipses", "basic_radius_mm", "reach elsewhere", 0.0, 300.0, "%.0f mm"});
}

}  // namespace

void tissuePanel(Session& session) {
  stiffnessWidgets(session);
  lawWidgets(session);
  ImGui::Separator();
  capWidgets(session);
  keyWidget(session, {"deformation", "shape", "shape of the dent"});
  keyWidget(session, {"deformation", "profile", "profile"});
  profileCurve(session);
  ImGui::Separator();
  ellipseWidgets(session);
  otherKeys(session, "deformation");
  otherKeys(session, "tissue");
}

}  // namespace palpate::viewer
