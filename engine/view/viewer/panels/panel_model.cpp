// The body, the active formulae of the dissertation, and the spatial sorting of its triangles.
#include <fmt/format.h>
#include <imgui.h>

#include <array>

#include "palpate/base/language.h"
#include "palpate/scene/errata.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

void drawWorldFacts(const WorldFacts& world) {
  ImGui::TextWrapped("%s", world.name.c_str());
  valueLine("triangles of the skin", fmt::format("{}", world.triangles));
  valueLine("size", fmt::format("{:.0f} x {:.0f} x {:.0f} mm", world.width_mm, world.height_mm, world.depth_mm));
  valueLine("stiffness", trf("{:.2f} to {:.2f} N/mm", world.softest_n_per_mm, world.stiffest_n_per_mm));
  if (!world.tissue.empty()) ImGui::TextWrapped("%s", world.tissue.c_str());
  for (const std::string& note : world.notes) remark(note);
}

void buildWidgets(const SceneKeys& keys) {
  keyWidget(keys, {"body", "posture", "posture"});
  keyWidget(keys, {"body", "body_mass_index", "body mass", 16.0, 45.0, "%.1f kg/m2"});
  keyWidget(keys, {"body", "muscle", "muscle", 0.0, 2.0});
  keyWidget(keys, {"body", "girth", "girth", 0.8, 1.3});
  keyWidget(keys, {"body", "kyphosis_deg", "kyphosis", 15.0, 65.0, "%.0f deg"});
  keyWidget(keys, {"body", "lordosis_deg", "lordosis", 0.0, 50.0, "%.0f deg"});
}

void breathingWidgets(const SceneKeys& keys) {
  keyWidget(keys, {"breathing", "on", "breathes"});
  if (!keys.scene.breathing.on) return;
  keyWidget(keys, {"breathing", "depth_mm", "breath", 0.0, 5.0, "%.1f mm"});
  keyWidget(keys, {"breathing", "per_minute", "breaths per minute", 4.0, 30.0, "%.0f"});
}

void bodyWidgets(const SceneKeys& keys) {
  const scene::BodyKind kind = keys.scene.body.kind;
  if (kind != scene::BodyKind::mesh) {
    keyWidget(keys, {"body", "kind", "body"});
    keyWidget(keys, {"body", "triangles", "triangles"});
    keyWidget(keys, {"body", "stature_mm", "stature", 500.0, 2500.0, "%.0f mm"});
    if (kind == scene::BodyKind::trunk) buildWidgets(keys);
    keyWidget(keys, {"body", "spine_relief", "spine shows", 0.0, 3.0});
    keyWidget(keys, {"body", "rib_relief", "ribs show", 0.0, 3.0});
    keyWidget(keys, {"body", "scapula_relief", "scapulae show", 0.0, 3.0});
    keyWidget(keys, {"body", "asymmetry", "asymmetry", 0.0, 3.0});
    breathingWidgets(keys);
  } else {
    keyWidget(keys, {"body", "unit", "unit of the file"});
    keyWidget(keys, {"body", "scale", "scale"});
    keyWidget(keys, {"body", "repair", "mend the mesh"});
    if (!keys.scene.body.fit.empty()) breathingWidgets(keys);
  }
}

void partitionWidgets(const SceneKeys& keys) {
  keyWidget(keys, {"partition", "tree", "tree"});
  keyWidget(keys, {"partition", "assign", "cut triangles"});
  keyWidget(keys, {"partition", "threshold", "triangles per leaf"});
  keyWidget(keys, {"partition", "hdb_fraction", "detecting box", 0.01, 1.0});
  keyWidget(keys, {"partition", "hdb_edge_mm", "its edge", 0.0, 400.0, "%.0f mm"});
  keyWidget(keys, {"partition", "query", "asks for"});
  otherKeys(keys, "partition");
}

/// One erratum, with the printed and the engine's form.
bool erratumWidget(const scene::ErratumText& text, Fidelity& fidelity) {
  bool literal = fidelity.literal(text.erratum);
  const std::string name = scene::nameOf(text.erratum);
  const std::string meaning =
      fmt::format("{}\n{}\n\n[fidelity] {}", trf("printed: {}", text.printed), trf("corrected: {}", text.ours), name);
  if (!flagWidget(("fidelity/" + name).c_str(), name.c_str(), literal, meaning.c_str())) return false;
  fidelity.setLiteral(text.erratum, literal);
  return true;
}

/// The dissertation's formulae: corrected, as printed, or erratum by erratum.
void fidelityWidgets(const SceneKeys& keys) {
  static constexpr std::array<std::string_view, 3> kReadings = {toTranslate("corrected"), toTranslate("as printed"),
                                                                toTranslate("some as printed")};
  Fidelity& fidelity = keys.scene.fidelity;
  Fidelity all;
  all.setAll(true);
  const auto now = static_cast<std::size_t>(fidelity == all ? 1 : fidelity == Fidelity() ? 0 : 2);
  std::size_t chosen = now;
  const bool whole = choiceWidget("fidelity/all", "formulae", chosen, std::span(kReadings).first(now == 2 ? 3 : 2),
                                  "The dissertation's formulae with their errata corrected, or as printed; the scene "
                                  "file's fidelity.");
  bool changed = whole && chosen != now && chosen < 2;
  if (changed) fidelity.setAll(chosen == 1);
  const bool open = ImGui::TreeNode("errata", "%s", tr("one by one"));
  notePlace("fidelity/errata", "Each erratum that can be read as printed.");
  if (open) {
    for (const scene::ErratumText& text : scene::errata()) {
      if (text.form == scene::LiteralForm::switchable) changed |= erratumWidget(text, fidelity);
    }
    ImGui::TreePop();
  }
  if (changed) keys.output.changed |= tableConsequences("fidelity");
}

}  // namespace

void modelPanel(const ModelPanel& panel, UiOutput& output) {
  const SceneKeys keys{panel.scene, output};
  drawWorldFacts(panel.world);
  if (buttonWidget("model/open", "Open ...", "Open a scene or a mesh, or drop a file on the window.")) {
    panel.open_dialog = true;
  }
  ImGui::SameLine();
  if (buttonWidget("model/default", "Built-in body")) output.request(OpenPreset{"trunk"});
  ImGui::Separator();
  bodyWidgets(keys);
  ImGui::Separator();
  fidelityWidgets(keys);
  ImGui::Separator();
  partitionWidgets(keys);
}

}  // namespace palpate::viewer
