// Places that are stiffer or softer than they should be: the list, and the editor's switch.
#include <fmt/format.h>
#include <imgui.h>

#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

void slider(const DysfunctionEdit& edit, double& value, const NumberWidget& widget, const std::string& words) {
  if (!numberWidget(value, widget)) return;
  edit.asks.changed |= kMapChange;
  edit.asks.step = words;
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

void historyButtons(const DysfunctionPanel& panel) {
  Asks& asks = panel.edit.asks;
  ImGui::BeginDisabled(panel.undo_words.empty());
  if (buttonWidget("dysfunctions/undo", "Undo", panel.undo_words.c_str())) asks.act(window::Action::undo);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(panel.redo_words.empty());
  if (buttonWidget("dysfunctions/redo", "Redo", panel.redo_words.c_str())) asks.act(window::Action::redo);
  ImGui::EndDisabled();
}

}  // namespace

void dysfunctionPanel(const DysfunctionPanel& panel) {
  const DysfunctionEdit& edit = panel.edit;
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
  historyButtons(panel);
}

}  // namespace palpate::viewer
