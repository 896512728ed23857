// Places that are stiffer or softer than normal: the list, and the editor's switch.
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/place_widgets.h"

namespace palpate::viewer {

namespace {

void drawDysfunctionList(const DysfunctionEdit& edit) {
  const auto& items = edit.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string line =
        fmt::format("{}   {}##{}", i + 1, trf("{:+.0f} % at {}", items[i].change_percent, placeOf(items[i])), i);
    const bool chosen = edit.editor.selected == static_cast<int>(i);
    if (ImGui::Selectable(line.c_str(), chosen)) edit.editor.selected = static_cast<int>(i);
    notePlace(fmt::format("dysfunctions/{}", i + 1),
              "Select this place; then the wheel sizes it and Delete removes it.");
  }
  if (items.empty()) remark("None: every place has its normal stiffness.");
}

void drawFields(const DysfunctionEdit& edit, maps::Dysfunction& item, const std::string& name) {
  slider(edit, item.change_percent,
         {"dysfunctions/change", "change", "%+.0f %%", -100.0, 300.0, 50.0, "Change of stiffness at the centre."},
         trf("change {}", name));
  placeField("dysfunctions", edit, item, name);
  slider(edit, item.radius_mm,
         {"dysfunctions/radius", "radius", "%.1f mm", 2.0, 100.0, 15.0, "Nothing changes outside this radius."},
         trf("resize {}", name));
  slider(edit, item.edge_softness,
         {"dysfunctions/edge", "soft edge", "%.2f", 0.0, 1.0, 0.5,
          "Fraction of the radius over which the change fades out; 0 is a hard edge."},
         trf("soften {}", name));
  placeNumbers("dysfunctions/x", "dysfunctions/y", edit, item, name);
}

}  // namespace

void historyButtons(const std::string& panel, const HistoryWords& words, UiOutput& output) {
  ImGui::BeginDisabled(words.undo.empty());
  if (buttonWidget((panel + "/undo").c_str(), "Undo", words.undo.c_str())) output.act(window::Action::undo);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(words.redo.empty());
  if (buttonWidget((panel + "/redo").c_str(), "Redo", words.redo.c_str())) output.act(window::Action::redo);
  ImGui::EndDisabled();
}

void dysfunctionPanel(const DysfunctionPanel& panel) {
  const DysfunctionEdit& edit = panel.edit;
  editorSwitch("dysfunctions/edit", edit,
               toTranslate("Click the skin to place one, drag to move it, wheel for its size, Shift and wheel for its "
                           "strength, Delete to remove it."));
  drawDysfunctionList(edit);
  newField("dysfunctions", edit,
           trf("Where: {}, or a distance in mm from it. Enter places one, +50 %.", examplePlaces(edit.landmarks)));
  if (maps::Dysfunction* item = selectedItem(edit)) {
    drawFields(edit, *item, nameOfSelected(edit));
    if (buttonWidget("dysfunctions/delete", "Delete")) deleteSelected(edit);
    ImGui::SameLine();
  }
  historyButtons("dysfunctions", {panel.undo_words, panel.redo_words}, edit.output);
}

}  // namespace palpate::viewer
