// Controls of the panels: each is labelled in plain words, explains itself under the mouse (unit, range, default, the
// scene file's name for it), returns to its default by a right click, and is known to tests by a path.
//
// Labels, meanings and text are passed in English and translated here; tools/check-translations knows which arguments
// of which functions they are (WIDGETS).
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "palpate/scene/scene.h"
#include "view/viewer/state/requests.h"

namespace palpate::viewer {

/// Places of the controls in this frame, points: "touch/depth" -> left, top, right, below. For tests and input
/// scripts, which should not know pixels.
using WidgetPlaces = std::map<std::string, std::array<float, 4>>;
WidgetPlaces& widgetPlaces();

/// Notes the control that was drawn last, with this explanation or that of its row of controlTooltip (below).
void notePlace(const std::string& path, std::string_view words = {});
/// Notes its place only.
void notePlaceOnly(const std::string& path);
/// The tooltip of a control without a text of its own: menus, buttons, fields. A number shows its range itself, a key
/// of the scene file the text of the file's reference, an item of the table of keys its sentence. By the control's
/// path; empty without a row (control_words.cpp).
std::string_view controlTooltip(std::string_view path);
/// Notes the current window.
void notePlaceOfWindow(const std::string& path);

/// The scene that controls change, and where they report changes.
struct SceneKeys {
  scene::Scene& scene;
  UiOutput& output;
};

/// A control for one key of the scene file.
struct KeyWidget {
  std::string_view table;
  std::string_view key;
  const char* label;
  double low = 0.0;  ///< ends of the slider; low = high: those of the key, or no slider where it has none
  double high = 0.0;
  const char* format = "%.2f";
};
/// Draws it and changes the scene; nothing where the scene file has no such key. Returns true after a change.
bool keyWidget(const SceneKeys& keys, const KeyWidget& widget);

/// All keys of a table that no keyWidget of this frame has shown, under a heading "more": keys of scene files without a
/// control.
void otherKeys(const SceneKeys& keys, const char* table);

struct NumberWidget {
  const char* path;  ///< "touch/depth"
  const char* label;
  const char* format;
  double low;
  double high;
  double fallback;
  const char* meaning;
};
bool numberWidget(double& value, const NumberWidget& widget);

bool flagWidget(const char* path, const char* label, bool& value, const char* meaning);
/// The index chosen among the names.
bool choiceWidget(const char* path, const char* label, std::size_t& value, std::span<const std::string_view> names,
                  const char* meaning);
/// The same for an enum whose values are the names' places.
template <class E>
requires std::is_enum_v<E>
bool choiceWidget(const char* path, const char* label, E& value, std::span<const std::string_view> names,
                  const char* meaning) {
  auto index = static_cast<std::size_t>(value);
  const bool changed = choiceWidget(path, label, index, names, meaning);
  value = static_cast<E>(index);
  return changed;
}
bool buttonWidget(const char* path, const char* label, const char* meaning = "");

/// A red one as wide as the room, or as its text.
bool stopButton(const char* path, const char* label, bool wide, const char* meaning);

// A dialog in the middle of the window, which owns mouse and keyboard until it is closed: by its buttons, Enter or Esc.

/// In the middle of the window, for ImGui::BeginPopupModal of this title; false where none is open.
bool openCentredModal(const char* title, bool open);
/// `open` is the caller's and is reset when it closes. Call endDialog if it returns true.
bool beginDialog(const char* title, bool& open);
void endDialog(bool& open);
/// Whether Enter was pressed in this frame, also on the keypad.
bool enterPressed();

/// Whether the theme has dark letters on light windows.
bool isLightTheme();

/// A line "label   value", the value right-aligned in digits of equal width.
void valueLine(const char* label, const std::string& value);
/// Small grey text.
void remark(const std::string& words);

}  // namespace palpate::viewer
