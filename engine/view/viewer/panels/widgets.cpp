#include "view/viewer/panels/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/key_table.h"
#include "palpate/scene/scene_edit.h"

namespace palpate::viewer {

namespace {

constexpr float kTooltipWidth = 320.0f;
constexpr float kControlShare = 0.56f;  ///< share of the panel's width; the rest is the label

void tooltip(const std::string& text, bool label_hovered = false) {
  constexpr auto kAlso = ImGuiHoveredFlags_AllowWhenDisabled;  // the reason of a disabled one is worth knowing
  if (text.empty() || (!label_hovered && !ImGui::IsItemHovered(kAlso))) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth);
  ImGui::TextUnformatted(tr(text.c_str()));
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void beginControl() { ImGui::SetNextItemWidth(kControlShare * ImGui::GetContentRegionAvail().x); }

/// Returns true when the user requested the default.
bool resetMenu(const std::string& fallback) {
  bool reset = false;
  if (ImGui::BeginPopupContextItem(nullptr)) {
    reset = ImGui::MenuItem(trf("Back to {}", fallback).c_str());
    ImGui::EndPopup();
  }
  return reset;
}

struct SliderLook {
  const char* label;
  const char* format;
  double low;
  double high;
};
struct SliderResult {
  bool changed = false;
  bool label_hovered = false;
};

/// The label of the item drawn last, without becoming an item: that one stays the last. True while the mouse is over
/// it.
bool drawLabel(const char* label) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 low(ImGui::GetItemRectMax().x + style.ItemInnerSpacing.x,
                   ImGui::GetItemRectMin().y + style.FramePadding.y);
  const ImVec2 size = ImGui::CalcTextSize(label);
  ImGui::GetWindowDrawList()->AddText(low, ImGui::GetColorU32(ImGuiCol_Text), label);
  return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, {low.x + size.x, low.y + size.y});
}

/// Numbers in finished text, "0.46 N", with the language's decimal sign.
std::string withDecimalSign(std::string words) {
  const auto digit = [&](std::size_t at) { return at < words.size() && words[at] >= '0' && words[at] <= '9'; };
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == '.' && digit(i - 1) && digit(i + 1)) words[i] = language().decimal_sign;
  }
  return words;
}

std::string formatNumber(double value, const char* format) {
  std::array<char, 64> text{};
  ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), ImGuiDataType_Double, &value, format);
  return withDecimalSign(text.data());
}

/// The number is before the track, where no grab can cover it. Ctrl and click types it, in place of the track.
SliderResult slider(double& value, const SliderLook& look) {
  constexpr float kNumber = 62.0f;  // room for most of them, so that tracks begin below each other
  constexpr float kMinTrack = 40.0f;
  const std::string words = formatNumber(value, look.format);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float column = std::max({kNumber, ImGui::CalcTextSize(formatNumber(look.low, look.format).c_str()).x,
                                 ImGui::CalcTextSize(formatNumber(look.high, look.format).c_str()).x});
  const float track = std::max(kMinTrack, ImGui::CalcItemWidth() - column - gap);
  const float left = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  ImGui::SetCursorPosX(left + column - ImGui::CalcTextSize(words.c_str()).x);
  ImGui::TextUnformatted(words.c_str());
  ImGui::SameLine(left + column + gap);
  ImGui::SetNextItemWidth(track);
  // The format stays, because values are rounded by it; only the number that it would write on the track is hidden.
  const bool typed = ImGui::TempInputIsActive(ImGui::GetID("##slider"));
  if (!typed) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_BLACK_TRANS);
  SliderResult slid;
  slid.changed = ImGui::SliderScalar("##slider", ImGuiDataType_Double, &value, &look.low, &look.high, look.format);
  if (!typed) ImGui::PopStyleColor();
  slid.label_hovered = drawLabel(look.label);
  return slid;
}

using scene::KeyForm;
using scene::KeyRow;

/// Everything about a key, for the tooltip.
std::string wordsOf(const KeyRow& row, const KeyWidget& widget) {
  const std::string fallback = scene::defaultOf(widget.table, widget.key);
  const std::string otherwise = fallback.empty() ? std::string() : trf("; default {}", fallback);
  return fmt::format("{}\n\n{}{}\n[{}] {}", tr(row.meaning.c_str()), row.takes, otherwise, widget.table, row.key);
}

/// Each draws one form and returns the new value as text, or empty.
std::string editNumber(const KeyRow& row, const KeyWidget& widget, bool& label_hovered) {
  double value = parseNumber(row.fallback).value_or(0.0);
  const bool own = widget.low == widget.high;
  const double low = own ? row.form.low : widget.low;
  const double high = own ? row.form.high : widget.high;
  SliderResult slid;
  if (std::isfinite(low) && std::isfinite(high)) {
    slid = slider(value, {tr(widget.label), widget.format, low, high});
  } else {
    slid.changed = ImGui::InputDouble(tr(widget.label), &value, 0.0, 0.0, widget.format);
  }
  label_hovered = slid.label_hovered;
  return slid.changed ? scene::showNumber(value) : std::string();
}

std::string editWhole(const KeyRow& row, const KeyWidget& widget) {
  int value = static_cast<int>(parseNumber(row.fallback).value_or(0.0));
  if (!ImGui::InputInt(tr(widget.label), &value, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue)) return {};
  return std::to_string(value);
}

std::string editFlag(const KeyRow& row, const KeyWidget& widget) {
  bool value = row.fallback == "true";
  if (!ImGui::Checkbox(tr(widget.label), &value)) return {};
  return value ? "true" : "false";
}

std::string editChoice(const KeyRow& row, const KeyWidget& widget) {
  std::string chosen;
  const std::string now = row.fallback.size() >= 2 ? row.fallback.substr(1, row.fallback.size() - 2) : std::string();
  if (!ImGui::BeginCombo(tr(widget.label), tr(now.c_str()))) return {};
  for (const std::string& choice : row.form.choices) {
    if (ImGui::Selectable(tr(choice.c_str()), choice == now)) chosen = scene::inQuotes(choice);
  }
  ImGui::EndCombo();
  return chosen;
}

std::string editText(const KeyRow& row, const KeyWidget& widget) {
  std::string value = row.fallback.size() >= 2 ? row.fallback.substr(1, row.fallback.size() - 2) : std::string();
  if (!ImGui::InputText(tr(widget.label), &value, ImGuiInputTextFlags_EnterReturnsTrue)) return {};
  return scene::inQuotes(value);
}

std::string edit(const KeyRow& row, const KeyWidget& widget, bool& label_hovered) {
  switch (row.form.kind) {
    case KeyForm::Kind::number:
      return editNumber(row, widget, label_hovered);
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
    keys.output.report(Severity::warning, error.what());
    return false;
  }
  keys.output.changed |= tableConsequences(widget.table);
  return true;
}

}  // namespace

WidgetPlaces& widgetPlaces() {
  static WidgetPlaces places;  // used on the display's thread, like ImGui's own state
  return places;
}

void notePlace(const std::string& path, std::string_view words) {
  notePlaceOnly(path);
  tooltip(std::string(words.empty() ? controlTooltip(path) : words));
}

void notePlaceOnly(const std::string& path) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  widgetPlaces()[path] = {low.x, low.y, high.x, high.y};
}

void notePlaceOfWindow(const std::string& path) {
  const ImVec2 low = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  widgetPlaces()[path] = {low.x, low.y, low.x + size.x, low.y + size.y};
}

bool keyWidget(const SceneKeys& keys, const KeyWidget& widget) {
  const auto row = scene::keyOf(keys.scene, widget.table, widget.key);
  if (!row) return false;
  ImGui::PushID(widget.key.data());
  beginControl();
  bool label_hovered = false;
  std::string value = edit(*row, widget, label_hovered);
  notePlaceOnly(fmt::format("{}/{}", widget.table, widget.key));
  const std::string fallback = scene::defaultOf(widget.table, widget.key);
  if (!fallback.empty() && resetMenu(fallback)) value = fallback;
  tooltip(wordsOf(*row, widget), label_hovered);
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
  const bool open = ImGui::TreeNode("more", "%s", trf("more of [{}]", table).c_str());
  notePlace(fmt::format("{}/more", table), "Every other key of this table of the scene file.");
  if (open) {
    for (const KeyRow& row : rest) keyWidget(keys, {table, row.key, row.key.c_str()});
    // The next frame must find them here.
    for (const KeyRow& row : rest) widgetPlaces().erase(fmt::format("{}/{}", table, row.key));
    ImGui::TreePop();
  }
  ImGui::PopID();
}

bool numberWidget(double& value, const NumberWidget& widget) {
  ImGui::PushID(widget.path);
  beginControl();
  const SliderResult slid = slider(value, {tr(widget.label), widget.format, widget.low, widget.high});
  bool changed = slid.changed;
  notePlaceOnly(widget.path);
  if (resetMenu(fmt::format("{:g}", WrittenNumber{widget.fallback}))) {
    value = widget.fallback;
    changed = true;
  }
  tooltip(trf("{}\n\n{:g} to {:g}; default {:g}", tr(widget.meaning), widget.low, widget.high, widget.fallback),
          slid.label_hovered);
  ImGui::PopID();
  if (changed) value = std::clamp(value, widget.low, widget.high);  // the slider does not clamp typed values
  return changed;
}

bool flagWidget(const char* path, const char* label, bool& value, const char* meaning) {
  ImGui::PushID(path);
  const bool changed = ImGui::Checkbox(tr(label), &value);
  notePlace(path, meaning);
  ImGui::PopID();
  return changed;
}

bool choiceWidget(const char* path, const char* label, std::size_t& value, std::span<const std::string_view> names,
                  const char* meaning) {
  bool changed = false;
  ImGui::PushID(path);
  beginControl();
  const bool open = ImGui::BeginCombo(tr(label), tr(std::string(names[std::min(value, names.size() - 1)]).c_str()));
  notePlaceOnly(path);
  if (open) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (ImGui::Selectable(tr(std::string(names[i]).c_str()), i == value)) {
        changed = i != value;
        value = i;
      }
      tooltip(meaning);
    }
    ImGui::EndCombo();
  }
  tooltip(meaning);
  ImGui::PopID();
  return changed;
}

bool buttonWidget(const char* path, const char* label, const char* meaning) {
  ImGui::PushID(path);
  const bool clicked = ImGui::Button(tr(label));
  notePlace(path, meaning);
  ImGui::PopID();
  return clicked;
}

bool stopButton(const char* path, const char* label, bool wide, const char* meaning) {
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(190, 20, 16, 255));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(222, 40, 34, 255));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, IM_COL32(140, 12, 10, 255));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);
  ImGui::PushID(path);
  const bool clicked =
      ImGui::Button(tr(label), wide ? ImVec2(-1.0f, 2.0f * ImGui::GetFrameHeight()) : ImVec2(0.0f, 0.0f));
  ImGui::PopID();
  ImGui::PopStyleColor(4);
  notePlace(path, meaning);
  return clicked;
}

bool isLightTheme() { return ImGui::GetStyleColorVec4(ImGuiCol_Text).y < 0.5f; }

void valueLine(const char* label, const std::string& value) {
  const std::string written = withDecimalSign(value);
  ImGui::TextUnformatted(tr(label));
  const float right = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(written.c_str()).x;
  ImGui::SameLine(std::max(0.0f, ImGui::GetCursorPosX() + right));
  ImGui::TextUnformatted(written.c_str());
}

void remark(const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", tr(words.c_str()));
  ImGui::PopStyleColor();
}

}  // namespace palpate::viewer
