// What is touched, and how its triangles are sorted in space.
#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

void factsOf(const WorldFacts& world) {
  ImGui::TextWrapped("%s", world.name.c_str());
  valueLine("triangles of the skin", fmt::format("{}", world.triangles));
  valueLine("size", fmt::format("{:.0f} x {:.0f} x {:.0f} mm", world.width_mm, world.height_mm, world.depth_mm));
  valueLine("stiffness", fmt::format("{:.2f} to {:.2f} N/mm", world.softest_n_per_mm, world.stiffest_n_per_mm));
  for (const std::string& note : world.notes) remark(note);
}

void bodyWidgets(Session& session) {
  if (session.scene.body.kind == scene::BodyKind::torso) {
    keyWidget(session, {"body", "triangles", "triangles"});
    keyWidget(session, {"body", "stature_mm", "stature", 500.0, 2500.0, "%.0f mm"});
    keyWidget(session, {"body", "spine_relief", "spine shows", 0.0, 3.0});
    keyWidget(session, {"body", "rib_relief", "ribs show", 0.0, 3.0});
    keyWidget(session, {"body", "scapula_relief", "scapulae show", 0.0, 3.0});
    keyWidget(session, {"body", "asymmetry", "asymmetry", 0.0, 3.0});
  } else {
    keyWidget(session, {"body", "unit", "unit of the file"});
    keyWidget(session, {"body", "scale", "scale"});
    keyWidget(session, {"body", "repair", "mend the mesh"});
  }
}

void partitionWidgets(Session& session) {
  keyWidget(session, {"partition", "tree", "tree"});
  keyWidget(session, {"partition", "assign", "cut triangles"});
  keyWidget(session, {"partition", "threshold", "triangles a leaf"});
  keyWidget(session, {"partition", "hdb_fraction", "detecting box", 0.01, 1.0});
  keyWidget(session, {"partition", "hdb_edge_mm", "its edge", 0.0, 400.0, "%.0f mm"});
  keyWidget(session, {"partition", "query", "asks for"});
  otherKeys(session, "partition");
}

}  // namespace

void modelPanel(Session& session) {
  factsOf(session.world);
  if (buttonWidget("model/open", "Open ...", "A scene or a mesh; or drop a file on the window.")) {
    session.state.shown.open_dialog = true;
  }
  ImGui::SameLine();
  if (buttonWidget("model/default", "Built-in torso")) session.wish(Wish::Kind::default_scene);
  ImGui::Separator();
  bodyWidgets(session);
  ImGui::Separator();
  partitionWidgets(session);
}

}  // namespace palpate::viewer
