// The one table of keys: each key's action and its text. The keyboard, the menus, the F1 page and
// docs/reference/viewer.md all come from it, so that they cannot disagree.
//
// Unshifted keys only, or Shift for "finer" and "the other way": a key that needs Shift on one keyboard does not exist
// on another.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "palpate/view/look.h"

namespace palpate::window {

/// Keys by their place on a US keyboard; the numbers are GLFW's (window.cpp checks it). Letters and digits are ASCII.
enum class Key : std::uint16_t {
  none = 0,
  space = 32,
  left_bracket = 91,
  right_bracket = 93,
  escape = 256,
  enter = 257,
  tab = 258,
  backspace = 259,
  delete_key = 261,
  right = 262,
  left = 263,
  down = 264,
  up = 265,
  page_up = 266,
  page_down = 267,
  home = 268,
  end = 269,
  pause = 284,
  f1 = 290,
  f12 = 301,
  pad_1 = 321,
  pad_3 = 323,
  pad_7 = 327,
  pad_enter = 335,
};
/// A letter (upper case) or a digit.
constexpr Key key(char c) { return static_cast<Key>(c); }
constexpr Key functionKey(int n) { return static_cast<Key>(static_cast<int>(Key::f1) + n - 1); }

struct Modifiers {
  bool ctrl = false;
  bool shift = false;
  friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// A key's action. The overlays follow each other as in Overlay (look.h), the colourings as in Colouring.
enum class Action : std::uint8_t {
  hold,
  deeper,
  lighter,
  ring_left,
  ring_right,
  ring_up,
  ring_down,
  take_left_finger,
  take_right_finger,
  lift_all,
  clutch,
  emergency_stop,
  home,
  centre_on_finger,
  next_view,
  previous_view,
  view_back,
  view_right,
  view_above,
  measure,
  find_place,
  show_wireframe,
  show_haptic_triangles,
  show_leaf_boxes,
  show_planes,
  show_detecting_box,
  show_ellipses,
  show_rings,
  show_arrows,
  show_contact,
  show_normals,
  show_section,
  show_names,
  show_pressure,
  show_lumps,
  show_cut,
  show_muscles,
  skin_opacity,
  colour_strain,
  colour_stiffness,
  colour_ellipses,
  freeze,
  play_script,
  slower,
  faster,
  help,
  numbers,
  performance,
  plots,
  full_screen,
  screenshot,
  screenshot_with_pop_ups,
  clear_screenshot,
  panel,
  record,
  keep_recording,
  mark,
  reach,
  stereo_mode,
  swap_eyes,
  open,
  measure_person,
  save,
  save_as,
  reload,
  reset,
  undo,
  redo,
  copy_scene,
  delete_selected,
  cancel,
  quit,
};
inline constexpr std::size_t kActions = static_cast<std::size_t>(Action::quit) + 1;

struct Chord {
  Key key = Key::none;
  Modifiers modifiers;
  friend bool operator==(const Chord&, const Chord&) = default;
};

enum class KeyGroup : std::uint8_t { touch, view, overlays, window, file };
inline constexpr std::array<std::string_view, 5> kKeyGroupNames = {"Touch", "View", "Overlays", "Window", "File"};

struct KeyBinding {
  Action action;
  KeyGroup group;
  Chord chord;
  Chord also;             ///< a second chord, or none
  bool fine_with_shift;   ///< Shift does the same in smaller steps
  std::string_view name;  ///< in menus: "Full screen"
  std::string_view does;  ///< one sentence for the F1 page
};

/// One row per action, in the order of Action within each group.
std::span<const KeyBinding> keyTable();
const KeyBinding& findBinding(Action action);

struct PressedKey {
  Action action;
  bool fine = false;
};
std::optional<PressedKey> findAction(const Chord& chord);

/// "Ctrl+S", "PgDn", as input scripts write it; empty for no key.
std::string nameOf(const Chord& chord);
/// The same in the language in use: "Strg+S".
std::string localisedChordName(const Chord& chord);
/// Both chords: "PgDn or ]".
std::string keysOf(const KeyBinding& binding);

/// The overlay or colouring that an action switches, if it does.
std::optional<view::Overlay> overlayFor(Action action);
std::optional<view::Colouring> colouringFor(Action action);
Action actionFor(view::Overlay overlay);

/// The table as Markdown, for docs/reference/viewer.md.
std::string keysAsMarkdown();

}  // namespace palpate::window
