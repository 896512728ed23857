// Shared by the panels of things on the body: the editor's switch, a slider that makes a step, a typed place, undo and
// redo. Paths begin with the panel's own word: "dysfunctions/place".
#pragma once

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <string>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/body/places.h"
#include "palpate/view/overlays/place_words.h"
#include "view/viewer/editing/place_editor.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

/// `words`: the step's name in undo.
template <class Item>
bool slider(const PlaceEdit<Item>& edit, double& value, const NumberWidget& widget, const std::string& words) {
  if (!numberWidget(value, widget)) return false;
  edit.output.changed |= kMapChange;
  edit.output.step = words;
  return true;
}

template <class Item>
void editorSwitch(const char* path, const PlaceEdit<Item>& edit, const char* meaning) {
  if (!buttonWidget(path, edit.editor.active ? "Leave the editor (Esc)" : "Edit on the body", meaning)) return;
  if (edit.editor.active) return stopEditing(edit);
  edit.editor.active = true;
}

template <class Item>
std::string placeOf(const Item& item) {
  return item.at.empty() ? fmt::format("({:.0f}, {:.0f}) mm", item.x_mm, item.y_mm) : view::placeInLanguage(item.at);
}

/// A typed place; Enter puts the item there.
template <class Item>
void placeField(const std::string& panel, const PlaceEdit<Item>& edit, Item& item, const std::string& name) {
  if (edit.landmarks.empty()) return;
  static std::string typed;
  static const Item* of = nullptr;
  if (of != &item || !ImGui::IsAnyItemActive()) typed = view::placeInLanguage(item.at);
  of = &item;
  const bool entered = ImGui::InputText(tr("place"), &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace(panel + "/place");
  if (!entered) return;
  try {
    const body::NamedPlace place = body::placeNamed(edit.landmarks, view::placeInEnglish(edit.landmarks, typed));
    item.at = place.name;
    item.x_mm = place.point.x();
    item.y_mm = place.point.y();
    edit.output.changed |= kMapChange;
    edit.output.step = trf("move {}", name);
  } catch (const Error& error) {
    edit.output.report(Severity::warning, error.what());
  }
}

/// A typed place makes a new item there: the short way to "T9 left".
template <class Item>
void newField(const std::string& panel, const PlaceEdit<Item>& edit, const std::string& meaning) {
  if (edit.landmarks.empty()) return;
  static std::string typed;
  const std::string example = view::placeInLanguage(firstExample(edit.landmarks) + " left 20 mm");
  const bool entered =
      ImGui::InputTextWithHint(tr("new"), example.c_str(), &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace(panel + "/new");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", meaning.c_str());
  if (!entered || typed.empty()) return;
  try {
    placeAt(edit, body::placeNamed(edit.landmarks, view::placeInEnglish(edit.landmarks, typed)));
    typed.clear();
  } catch (const Error& error) {
    edit.output.report(Severity::warning, error.what());
  }
}

/// The place in numbers; a name would put it back.
template <class Item>
void placeNumbers(const char* x_path, const char* y_path, const PlaceEdit<Item>& edit, Item& item,
                  const std::string& name) {
  const std::string words = trf("move {}", name);
  bool moved = slider(edit, item.x_mm,
                      {x_path, "x", "%.1f mm", -400.0, 400.0, 0.0, "The centre, towards the patient's right."}, words);
  moved |=
      slider(edit, item.y_mm, {y_path, "y", "%.1f mm", -400.0, 400.0, 0.0, "The centre, towards the head."}, words);
  if (moved) item.at.clear();
}

/// The next steps to undo and redo in this window; empty: none.
struct HistoryWords {
  const std::string& undo;
  const std::string& redo;
};
void historyButtons(const std::string& panel, const HistoryWords& words, UiOutput& output);

}  // namespace palpate::viewer
