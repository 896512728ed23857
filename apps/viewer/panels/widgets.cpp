#include "apps/viewer/panels/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/scene/key_table.h"
#include "palpate/scene/scene_edit.h"

namespace palpate::viewer {

namespace {

constexpr float kTooltipWidth = 320.0f;
constexpr float kControlShare = 0.56f;  ///< of the panel's width; the rest is the label

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void beginControl() { ImGui::SetNextItemWidth(kControlShare * ImGui::GetContentRegionAvail().x); }

/// True when the user asked for the default.
bool resetMenu(const std::string& fallback) {
  bool reset = false;
  if (ImGui::BeginPopupContextItem(nullptr)) {
    reset = ImGui::MenuItem(fmt::format("Back to {}", fallback).c_str());
    ImGui::EndPopup();
  }
  return reset;
}

using scene::KeyForm;
using scene::KeyRow;

/// Everything about a key, for the tooltip.
std::string wordsOf(const KeyRow& row, const KeyWidget& widget) {
  const std::string fallback = scene::defaultOf(widget.table, widget.key);
  return fmt::format("{}\n\n{}{}\n[{}] {}", row.meaning, row.takes, fallback.empty() ? "" : "; default " + fallback,
                     widget.table, row.key);
}

/// Each draws one form and returns the new value as text, or nothing.
std::string editNumber(const KeyRow& row, const KeyWidget& widget) {
  double value = parseNumber(row.fallback).value_or(0.0);
  const bool own = widget.low == widget.high;
  const double low = own ? row.form.low : widget.low;
  const double high = own ? row.form.high : widget.high;
  const bool changed = std::isfinite(low) && std::isfinite(high)
                           ? ImGui::SliderScalar(widget.label, ImGuiDataType_Double, &value, &low, &high, widget.format)
                           : ImGui::InputDouble(widget.label, &value, 0.0, 0.0, widget.format);
  return changed ? scene::showNumber(value) : std::string();
}

std::string editWhole(const KeyRow& row, const KeyWidget& widget) {
  int value = static_cast<int>(parseNumber(row.fallback).value_or(0.0));
  if (!ImGui::InputInt(widget.label, &value, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue)) return {};
  return std::to_string(value);
}

std::string editFlag(const KeyRow& row, const KeyWidget& widget) {
  bool value = row.fallback == "true";
  if (!ImGui::Checkbox(widget.label, &value)) return {};
  return value ? "true" : "false";
}

std::string editChoice(const KeyRow& row, const KeyWidget& widget) {
  std::string chosen;
  const std::string now = row.fallback.size() >= 2 ? row.fallback.substr(1, row.fallback.size() - 2) : std::string();
  if (!ImGui::BeginCombo(widget.label, now.c_str())) return {};
  for (const std::string& choice : row.form.choices) {
    if (ImGui::Selectable(choice.c_str(), choice == now)) chosen = scene::inQuotes(choice);
  }
  ImGui::EndCombo();
  return chosen;
}

std::string editText(const KeyRow& row, const KeyWidget& widget) {
  std::string value = row.fallback.size() >= 2 ? row.fallback.substr(1, row.fallback.size() - 2) : std::string();
  if (!ImGui::InputText(widget.label, &value, ImGuiInputTextFlags_EnterReturnsTrue)) return {};
  return scene::inQuotes(value);
}

std::string edit(const KeyRow& row, const KeyWidget& widget) {
  switch (row.form.kind) {
    case KeyForm::Kind::number:
      return editNumber(row, widget);
    case KeyForm::Kind::whole:
      return editWhole(row, widget);
    case KeyForm::Kind::flag:
      return editFlag(row, widget);
    case KeyForm::Kind::choice:
      return editChoice(row, widget);
    case KeyForm::Kind::text:
    case KeyForm::Kind::file:
      return editText(row, widget);
    default:
      return {};
  }
}

bool setTo(const SceneKeys& keys, const KeyWidget& widget, const std::string& value) {
  try {
    scene::setKey(keys.scene, widget.table, widget.key, value);
  } catch (const Error& error) {
    keys.asks.tell(Severity::warning, error.what());
    return false;
  }
  keys.asks.changed |= consequenceOf(widget.table);
  return true;
}

}  // namespace

std::uint32_t consequenceOf(std::string_view table) {
  if (table == "body") return kBodyChange;
  if (table == "friction") return kFingerChange;
  if (table == "contact") return kFingerChange | kMapChange;  // the source of the contact is built with the maps
  if (table == "output" || table == "safety") return kNothing;
  return kMapChange;
}

WidgetPlaces& widgetPlaces() {
  static WidgetPlaces places;  // of the display's thread, like ImGui's own state
  return places;
}

void notePlace(const std::string& path) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  widgetPlaces()[path] = {low.x, low.y, high.x, high.y};
}

bool keyWidget(const SceneKeys& keys, const KeyWidget& widget) {
  const auto row = scene::keyOf(keys.scene, widget.table, widget.key);
  if (!row) return false;
  ImGui::PushID(widget.key.data());
  beginControl();
  std::string value = edit(*row, widget);
  notePlace(fmt::format("{}/{}", widget.table, widget.key));
  const std::string fallback = scene::defaultOf(widget.table, widget.key);
  if (!fallback.empty() && resetMenu(fallback)) value = fallback;
  tooltip(wordsOf(*row, widget));
  ImGui::PopID();
  return !value.empty() && setTo(keys, widget, value);
}

void otherKeys(const SceneKeys& keys, const char* table) {
  std::vector<KeyRow> rest;
  for (const KeyRow& row : scene::keysOf(keys.scene, table)) {
    const bool editable = row.form.kind != KeyForm::Kind::other;
    if (editable && !widgetPlaces().contains(fmt::format("{}/{}", table, row.key))) rest.push_back(row);
  }
  if (rest.empty()) return;
  ImGui::PushID(table);
  if (ImGui::TreeNode("more", "more of [%s]", table)) {
    for (const KeyRow& row : rest) keyWidget(keys, {table, row.key, row.key.c_str()});
    // They are to be found here again in the next frame.
    for (const KeyRow& row : rest) widgetPlaces().erase(fmt::format("{}/{}", table, row.key));
    ImGui::TreePop();
  }
  ImGui::PopID();
}

bool numberWidget(double& value, const NumberWidget& widget) {
  ImGui::PushID(widget.path);
  beginControl();
  bool changed =
      ImGui::SliderScalar(widget.label, ImGuiDataType_Double, &value, &widget.low, &widget.high, widget.format);
  notePlace(widget.path);
  if (resetMenu(fmt::format("{:g}", widget.fallback))) {
    value = widget.fallback;
    changed = true;
  }
  tooltip(fmt::format("{}\n\n{:g} to {:g}; default {:g}", widget.meaning, widget.low, widget.high, widget.fallback));
  ImGui::PopID();
  if (changed) value = std::clamp(value, widget.low, widget.high);  // typed values are not held by the slider
  return changed;
}

bool flagWidget(const char* path, const char* label, bool& value, const char* meaning) {
  ImGui::PushID(path);
  const bool changed = ImGui::Checkbox(label, &value);
  notePlace(path);
  tooltip(meaning);
  ImGui::PopID();
  return changed;
}

bool choiceWidget(const char* path, const char* label, std::size_t& value, std::span<const std::string_view> names,
                  const char* meaning) {
  bool changed = false;
  ImGui::PushID(path);
  beginControl();
  const bool open = ImGui::BeginCombo(label, std::string(names[std::min(value, names.size() - 1)]).c_str());
  notePlace(path);
  if (open) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (ImGui::Selectable(std::string(names[i]).c_str(), i == value)) {
        changed = i != value;
        value = i;
      }
    }
    ImGui::EndCombo();
  }
  tooltip(meaning);
  ImGui::PopID();
  return changed;
}

bool buttonWidget(const char* path, const char* label, const char* meaning) {
  ImGui::PushID(path);
  const bool clicked = ImGui::Button(label);
  notePlace(path);
  tooltip(meaning);
  ImGui::PopID();
  return clicked;
}

void valueLine(const char* label, const std::string& value) {
  ImGui::TextUnformatted(label);
  const float right = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(std::max(0.0f, ImGui::GetCursorPosX() + right));
  ImGui::TextUnformatted(value.c_str());
}

void remark(const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", words.c_str());
  ImGui::PopStyleColor();
}

}  // namespace palpate::viewer
