// Places that are stiffer or softer than they should be: the list, and the editor's switch.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/body/places.h"
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

std::string placeOf(const maps::Dysfunction& item) {
  return item.at.empty() ? fmt::format("({:.0f}, {:.0f}) mm", item.x_mm, item.y_mm) : item.at;
}

/// Typed in words; Enter puts it there.
void placeField(const DysfunctionEdit& edit, maps::Dysfunction& item, const std::string& name) {
  if (edit.landmarks.empty()) return;
  static std::string typed;
  static const maps::Dysfunction* of = nullptr;
  if (of != &item || !ImGui::IsAnyItemActive()) typed = item.at;
  of = &item;
  const bool entered = ImGui::InputText(tr("place"), &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace("dysfunctions/place");
  if (!entered) return;
  try {
    const body::NamedPlace place = body::placeNamed(edit.landmarks, typed);
    item.at = place.name;
    item.x_mm = place.point.x();
    item.y_mm = place.point.y();
    edit.asks.changed |= kMapChange;
    edit.asks.step = trf("move {}", name);
  } catch (const Error& error) {
    edit.asks.tell(Severity::warning, error.what());
  }
}

void listOf(const DysfunctionEdit& edit) {
  const auto& items = edit.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string line =
        fmt::format("{}   {}##{}", i + 1, trf("{:+.0f} % at {}", items[i].change_percent, placeOf(items[i])), i);
    const bool chosen = edit.editor.selected == static_cast<int>(i);
    if (ImGui::Selectable(line.c_str(), chosen)) edit.editor.selected = static_cast<int>(i);
    notePlace(fmt::format("dysfunctions/{}", i + 1), "Select this place: the wheel then sizes it, Delete removes it.");
  }
  if (items.empty()) remark("None: every place is as it should be.");
}

/// Typed in words, a new one is there: the short way to "T9 left".
void newField(const DysfunctionEdit& edit) {
  if (edit.landmarks.empty()) return;
  static std::string typed;
  const bool entered =
      ImGui::InputTextWithHint(tr("new"), "T9 left 51 mm", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace("dysfunctions/new");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", tr("Where: T9 left 51 mm, left PSIS, right site 4. Enter places one, +50 %."));
  if (!entered || typed.empty()) return;
  try {
    placeAt(edit, body::placeNamed(edit.landmarks, typed));
    typed.clear();
  } catch (const Error& error) {
    edit.asks.tell(Severity::warning, error.what());
  }
}

void fieldsOf(const DysfunctionEdit& edit, maps::Dysfunction& item, const std::string& name) {
  slider(edit, item.change_percent,
         {"dysfunctions/change", "change", "%+.0f %%", -100.0, 300.0, 50.0, "Of the stiffness at the centre."},
         trf("change {}", name));
  placeField(edit, item, name);
  slider(edit, item.radius_mm,
         {"dysfunctions/radius", "radius", "%.1f mm", 2.0, 100.0, 15.0, "Outside nothing changes."},
         trf("resize {}", name));
  slider(edit, item.edge_softness,
         {"dysfunctions/edge", "soft edge", "%.2f", 0.0, 1.0, 0.5,
          "Share of the radius over which the change fades out; 0 is a hard edge."},
         trf("soften {}", name));
  const Vec2 before(item.x_mm, item.y_mm);
  slider(edit, item.x_mm,
         {"dysfunctions/x", "x", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; to the patient's right."},
         trf("move {}", name));
  slider(edit, item.y_mm, {"dysfunctions/y", "y", "%.1f mm", -400.0, 400.0, 0.0, "Of the centre; towards the head."},
         trf("move {}", name));
  if (before != Vec2(item.x_mm, item.y_mm)) item.at.clear();  // words would put it back
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
  newField(edit);
  const auto selected = static_cast<std::size_t>(editor.selected);
  if (editor.selected >= 0 && selected < edit.items.size()) {
    fieldsOf(edit, edit.items[selected], trf("dysfunction {}", selected + 1));
    if (buttonWidget("dysfunctions/delete", "Delete")) deleteSelected(edit);
    ImGui::SameLine();
  }
  historyButtons(panel);
}

}  // namespace palpate::viewer
