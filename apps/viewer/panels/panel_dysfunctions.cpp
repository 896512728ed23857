// Places that are stiffer or softer than they should be: the list, and the editor's switch.
#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/editing/dysfunction_editor.h"
#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

/// A slider is one gesture from when it is taken to when it is let go.
void slider(Session& session, double& value, const NumberWidget& widget, const std::string& words) {
  const DysfunctionList before = dysfunctionsOf(session);
  const bool changed = numberWidget(value, widget);
  if (ImGui::IsItemActivated()) session.editor.history.begin(before);
  if (changed) {
    session.editor.history.begin(before);  // a reset by the menu activates nothing
    session.changed |= kMapChange;
  }
  if (ImGui::IsItemDeactivated() || (changed && !ImGui::IsItemActive())) commitEdit(session, words);
}

void listOf(Session& session) {
  const auto& items = session.scene.dysfunctions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string line = fmt::format("{}   {:+.0f} % at ({:.0f}, {:.0f}) mm##{}", i + 1, items[i].change_percent,
                                         items[i].x_mm, items[i].y_mm, i);
    const bool chosen = session.editor.selected == static_cast<int>(i);
    if (ImGui::Selectable(line.c_str(), chosen)) session.editor.selected = static_cast<int>(i);
    notePlace(fmt::format("dysfunctions/{}", i + 1));
  }
  if (items.empty()) remark("None: every place is as it should be.");
}

void fieldsOf(Session& session, maps::Dysfunction& item, const std::string& name) {
  slider(session, item.change_percent,
         {"dysfunctions/change", "change", "%+.0f %%", -100.0, 300.0, 50.0, "Of the stiffness at the centre."},
         "change " + name);
  slider(session, item.radius_mm,
         {"dysfunctions/radius", "radius", "%.1f mm", 2.0, 100.0, 15.0, "Outside nothing changes."}, "resize " + name);
  slider(session, item.edge_softness,
         {"dysfunctions/edge", "soft edge", "%.2f", 0.0, 1.0, 0.5,
          "Share of the radius over which the change fades out; 0 is a hard edge."},
         "soften " + name);
  slider(session, item.x_mm,
         {"dysfunctions/x", "x", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; to the patient's right."},
         "move " + name);
  slider(session, item.y_mm, {"dysfunctions/y", "y", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; towards the head."},
         "move " + name);
}

void historyButtons(Session& session) {
  auto& history = session.editor.history;
  ImGui::BeginDisabled(!history.canUndo());
  if (buttonWidget("dysfunctions/undo", "Undo", history.undoWords().c_str())) undo(session);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!history.canRedo());
  if (buttonWidget("dysfunctions/redo", "Redo", history.redoWords().c_str())) redo(session);
  ImGui::EndDisabled();
}

}  // namespace

void dysfunctionPanel(Session& session) {
  Editor& editor = session.editor;
  if (buttonWidget("dysfunctions/edit", editor.active ? "Leave the editor (Esc)" : "Edit on the body",
                   "Click the skin to place one, drag to move it, wheel for its size, Shift and wheel for its "
                   "strength, Delete to remove it.")) {
    editor.active ? stopEditing(session) : startEditing(session);
  }
  listOf(session);
  const auto selected = static_cast<std::size_t>(editor.selected);
  if (editor.selected >= 0 && selected < session.scene.dysfunctions.size()) {
    fieldsOf(session, session.scene.dysfunctions[selected], fmt::format("dysfunction {}", selected + 1));
    if (buttonWidget("dysfunctions/delete", "Delete")) deleteSelected(session);
    ImGui::SameLine();
  }
  historyButtons(session);
}

}  // namespace palpate::viewer
