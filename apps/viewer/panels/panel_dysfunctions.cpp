// Places that are stiffer or softer than they should be: the list, and the editor's switch.
#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/editing/dysfunction_editor.h"
#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

/// A slider is one gesture from when it is taken to when it is let go.
void slider(const DysfunctionEdit& edit, double& value, const NumberWidget& widget, const std::string& words) {
  const std::vector<maps::Dysfunction> before = edit.items;
  const bool changed = numberWidget(value, widget);
  if (ImGui::IsItemActivated()) edit.editor.history.begin(before);
  if (changed) {
    edit.editor.history.begin(before);  // a reset by the menu activates nothing
    edit.asks.changed |= kMapChange;
  }
  if (ImGui::IsItemDeactivated() || (changed && !ImGui::IsItemActive())) commitEdit(edit, words);
}

void listOf(const DysfunctionEdit& edit) {
  const auto& items = edit.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string line = fmt::format("{}   {:+.0f} % at ({:.0f}, {:.0f}) mm##{}", i + 1, items[i].change_percent,
                                         items[i].x_mm, items[i].y_mm, i);
    const bool chosen = edit.editor.selected == static_cast<int>(i);
    if (ImGui::Selectable(line.c_str(), chosen)) edit.editor.selected = static_cast<int>(i);
    notePlace(fmt::format("dysfunctions/{}", i + 1));
  }
  if (items.empty()) remark("None: every place is as it should be.");
}

void fieldsOf(const DysfunctionEdit& edit, maps::Dysfunction& item, const std::string& name) {
  slider(edit, item.change_percent,
         {"dysfunctions/change", "change", "%+.0f %%", -100.0, 300.0, 50.0, "Of the stiffness at the centre."},
         "change " + name);
  slider(edit, item.radius_mm,
         {"dysfunctions/radius", "radius", "%.1f mm", 2.0, 100.0, 15.0, "Outside nothing changes."}, "resize " + name);
  slider(edit, item.edge_softness,
         {"dysfunctions/edge", "soft edge", "%.2f", 0.0, 1.0, 0.5,
          "Share of the radius over which the change fades out; 0 is a hard edge."},
         "soften " + name);
  slider(edit, item.x_mm,
         {"dysfunctions/x", "x", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; to the patient's right."},
         "move " + name);
  slider(edit, item.y_mm, {"dysfunctions/y", "y", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; towards the head."},
         "move " + name);
}

void historyButtons(const DysfunctionEdit& edit) {
  auto& history = edit.editor.history;
  ImGui::BeginDisabled(!history.canUndo());
  if (buttonWidget("dysfunctions/undo", "Undo", history.undoWords().c_str())) undo(edit);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!history.canRedo());
  if (buttonWidget("dysfunctions/redo", "Redo", history.redoWords().c_str())) redo(edit);
  ImGui::EndDisabled();
}

}  // namespace

void dysfunctionPanel(const DysfunctionEdit& edit) {
  Editor& editor = edit.editor;
  if (buttonWidget("dysfunctions/edit", editor.active ? "Leave the editor (Esc)" : "Edit on the body",
                   "Click the skin to place one, drag to move it, wheel for its size, Shift and wheel for its "
                   "strength, Delete to remove it.")) {
    if (editor.active) {
      stopEditing(edit);
    } else {
      editor.active = true;
    }
  }
  listOf(edit);
  const auto selected = static_cast<std::size_t>(editor.selected);
  if (editor.selected >= 0 && selected < edit.items.size()) {
    fieldsOf(edit, edit.items[selected], fmt::format("dysfunction {}", selected + 1));
    if (buttonWidget("dysfunctions/delete", "Delete")) deleteSelected(edit);
    ImGui::SameLine();
  }
  historyButtons(edit);
}

}  // namespace palpate::viewer
