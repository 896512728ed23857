// The table, looked up row by row: some fifty rows, once a key. The order of overlays and colourings is that of their
// enumerators, so an action becomes one by subtraction.
#include "palpate/window/keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/language.h"

namespace palpate::window {

namespace {

constexpr Modifiers kPlain{};
constexpr Modifiers kCtrl{true, false};
constexpr Modifiers kShift{false, true};
constexpr Chord kNone{};
constexpr Chord plain(Key k) { return {k, kPlain}; }
constexpr Chord plain(char c) { return {key(c), kPlain}; }
constexpr Chord ctrl(char c) { return {key(c), kCtrl}; }
constexpr Chord ctrlShift(char c) { return {key(c), {true, true}}; }
constexpr Chord shift(char c) { return {key(c), kShift}; }
constexpr Chord f(int n) { return {functionKey(n), kPlain}; }

using A = Action;
using G = KeyGroup;

// clang-format off
constexpr KeyBinding kTable[] = {
    {A::hold, G::touch, plain(Key::enter), plain(Key::pad_enter), false, toTranslate("Hold"), toTranslate("Keep the finger pressed without the button; again: lift it.")},
    {A::deeper, G::touch, plain(Key::page_down), plain(Key::right_bracket), true, toTranslate("Deeper"), toTranslate("Press 0.5 mm deeper, or with 0.25 N more.")},
    {A::lighter, G::touch, plain(Key::page_up), plain(Key::left_bracket), true, toTranslate("Lighter"), toTranslate("Press 0.5 mm less deep, or with 0.25 N less.")},
    {A::ring_left, G::touch, plain(Key::left), kNone, true, toTranslate("Finger left"), toTranslate("Move the finger 2 mm left; it drags the skin.")},
    {A::ring_right, G::touch, plain(Key::right), kNone, true, toTranslate("Finger right"), toTranslate("Move the finger 2 mm to the right.")},
    {A::ring_up, G::touch, plain(Key::up), kNone, true, toTranslate("Finger up"), toTranslate("Move the finger 2 mm up.")},
    {A::ring_down, G::touch, plain(Key::down), kNone, true, toTranslate("Finger down"), toTranslate("Move the finger 2 mm down.")},
    {A::take_left_finger, G::touch, plain('1'), kNone, false, toTranslate("Use the left finger"), toTranslate("Move the left (blue) finger; the other stays.")},
    {A::take_right_finger, G::touch, plain('2'), kNone, false, toTranslate("Use the right finger"), toTranslate("Move the right (red) finger; the other stays.")},
    {A::lift_all, G::touch, plain(Key::backspace), kNone, false, toTranslate("Lift all fingers"), toTranslate("Lift every finger.")},
    {A::clutch, G::touch, plain('U'), kNone, false, toTranslate("Clutch"), toTranslate("While down, devices move and fingers stay.")},
    {A::emergency_stop, G::touch, plain(Key::pause), kNone, false, toTranslate("Emergency stop"), toTranslate("No device gets a force until it is released.")},
    {A::home, G::view, plain(Key::home), kNone, false, toTranslate("Whole body"), toTranslate("Show the whole body again.")},
    {A::centre_on_finger, G::view, plain('F'), kNone, false, toTranslate("Centre on the finger"), toTranslate("Turn about the place under the finger.")},
    {A::next_view, G::view, plain('V'), kNone, false, toTranslate("Next standard view"), toTranslate("Show the next standard view.")},
    {A::previous_view, G::view, shift('V'), kNone, false, toTranslate("Previous standard view"), toTranslate("Show the previous standard view.")},
    {A::view_back, G::view, plain(Key::pad_1), kNone, false, toTranslate("From behind"), toTranslate("Show the back.")},
    {A::view_right, G::view, plain(Key::pad_3), kNone, false, toTranslate("From the right"), toTranslate("Show the patient's right side.")},
    {A::view_above, G::view, plain(Key::pad_7), kNone, false, toTranslate("From above"), toTranslate("Look down along the spine.")},
    {A::measure, G::view, plain('D'), kNone, false, toTranslate("Measure a distance"), toTranslate("Measure a distance with two clicks on the skin; Esc ends it.")},
    {A::find_place, G::view, ctrl('F'), kNone, false, toTranslate("Go to a place ..."), toTranslate("Fly to a place by its name, such as T6.")},
    {A::show_wireframe, G::overlays, plain('W'), kNone, false, toTranslate("Wireframe"), toTranslate("Show the edges of the mesh.")},
    {A::show_haptic_triangles, G::overlays, plain('T'), kNone, false, toTranslate("Haptic triangles"), toTranslate("Show the triangles tested for contact, in green.")},
    {A::show_leaf_boxes, G::overlays, plain('B'), kNone, false, toTranslate("Leaf boxes"), toTranslate("Show the leaves of the partition, in blue.")},
    {A::show_planes, G::overlays, plain('P'), kNone, false, toTranslate("Splitting planes"), toTranslate("Show splitting planes: x green, y red, z yellow.")},
    {A::show_detecting_box, G::overlays, plain('H'), kNone, false, toTranslate("Detecting box"), toTranslate("Show the haptic detecting box.")},
    {A::show_ellipses, G::overlays, plain('E'), kNone, false, toTranslate("Ellipses"), toTranslate("Show how far the skin follows, here and at the key points.")},
    {A::show_rings, G::overlays, plain('G'), kNone, false, toTranslate("Neighbour rings"), toTranslate("Show the rings of neighbours round the finger.")},
    {A::show_arrows, G::overlays, plain('A'), kNone, false, toTranslate("Displacement"), toTranslate("Show how far the skin has moved, as arrows.")},
    {A::show_contact, G::overlays, plain('C'), kNone, false, toTranslate("Contact"), toTranslate("Show friction anchor, proxy, tip and force.")},
    {A::show_normals, G::overlays, plain('N'), kNone, false, toTranslate("Normals"), toTranslate("Show the normals of the skin.")},
    {A::show_section, G::overlays, plain('X'), kNone, false, toTranslate("Cross section"), toTranslate("Show a cut through the contact, in mm.")},
    {A::show_names, G::overlays, plain('I'), kNone, false, toTranslate("Names"), toTranslate("Show the names of the body's places.")},
    {A::show_pressure, G::overlays, shift('P'), kNone, false, toTranslate("Pressure"), toTranslate("Show the pressure under the fingertip, in kPa.")},
    {A::show_lumps, G::overlays, shift('L'), kNone, false, toTranslate("Lumps"), toTranslate("Show the lumps under translucent skin.")},
    {A::show_cut, G::overlays, shift('X'), kNone, false, toTranslate("Cut-away"), toTranslate("Show the tissue cut open under the finger.")},
    {A::show_muscles, G::overlays, shift('I'), kNone, false, toTranslate("Muscles"), toTranslate("Draw superficial muscles of the back on the skin.")},
    {A::skin_opacity, G::overlays, plain('O'), kNone, false, toTranslate("Skin opacity"), toTranslate("Make the skin 100, 60, 30 and 0 % opaque in turn.")},
    {A::colour_strain, G::overlays, plain('S'), kNone, false, toTranslate("Strain"), toTranslate("Colour the skin by strain; again: off.")},
    {A::colour_stiffness, G::overlays, plain('M'), kNone, false, toTranslate("Stiffness"), toTranslate("Colour the skin by stiffness; again: off.")},
    {A::colour_ellipses, G::overlays, plain('L'), kNone, false, toTranslate("Ellipse map"), toTranslate("Colour the skin by the size of its ellipse; again: off.")},
    {A::freeze, G::window, plain(Key::space), kNone, false, toTranslate("Freeze"), toTranslate("Freeze picture and plots; Left and Right step, touch continues. While a device is held: Pause.")},
    {A::play_script, G::window, f(7), kNone, false, toTranslate("Play the scene's fingers"), toTranslate("Play the scene's own fingers; again: the mouse.")},
    {A::slower, G::window, f(8), kNone, false, toTranslate("Slower"), toTranslate("Slow playback down, to a tenth of its speed.")},
    {A::faster, G::window, f(9), kNone, false, toTranslate("Faster"), toTranslate("Speed playback up, to ten times its speed.")},
    {A::help, G::window, f(1), kNone, false, toTranslate("Keys"), toTranslate("Show this list.")},
    {A::numbers, G::window, f(2), kNone, false, toTranslate("Numbers"), toTranslate("Show depth and force beside the finger.")},
    {A::performance, G::window, f(3), kNone, false, toTranslate("Performance"), toTranslate("Show rates, compute times and lateness.")},
    {A::plots, G::window, f(4), kNone, false, toTranslate("Plots"), toTranslate("Show force, depth and speed over time.")},
    {A::full_screen, G::window, f(11), kNone, false, toTranslate("Full screen"), toTranslate("Fill the screen, or go back to a window.")},
    {A::screenshot, G::window, f(12), kNone, false, toTranslate("Save a picture"), toTranslate("Save a picture (PNG) without messages and dialogs.")},
    {A::screenshot_with_pop_ups, G::window, {functionKey(12), kShift}, kNone, false, toTranslate("Save a picture with pop-ups"), toTranslate("The same with messages, menus and dialogs.")},
    {A::clear_screenshot, G::window, {functionKey(12), kCtrl}, kNone, false, toTranslate("Save a picture without background"), toTranslate("Save the body alone as a PNG file, the rest transparent.")},
    {A::panel, G::window, plain(Key::tab), kNone, false, toTranslate("Side panel"), toTranslate("Show or hide the panel.")},
    {A::record, G::window, plain('R'), kNone, false, toTranslate("Record"), toTranslate("Start or stop recording forces to a CSV file.")},
    {A::keep_recording, G::window, shift('R'), kNone, false, toTranslate("Keep the recording"), toTranslate("Save the last hour, recorded automatically, as a file.")},
    {A::mark, G::window, shift('M'), kNone, false, toTranslate("Mark"), toTranslate("Mark this moment in the recording, to find it again.")},
    {A::reach, G::window, plain('J'), kNone, false, toTranslate("Reach"), toTranslate("Show the box that each device in use can reach.")},
    {A::stereo_mode, G::window, plain('K'), kNone, false, toTranslate("Stereo mode"), toTranslate("Go through the stereo modes.")},
    {A::swap_eyes, G::window, shift('K'), kNone, false, toTranslate("Swap the eyes"), toTranslate("Swap the pictures of the two eyes.")},
    {A::open, G::file, ctrl('O'), kNone, false, toTranslate("Open ..."), toTranslate("Open a scene or a mesh.")},
    {A::measure_person, G::file, ctrl('M'), kNone, false, toTranslate("Measure a person ..."), toTranslate("Measure a person from two photographs; again: back.")},
    {A::save, G::file, ctrl('S'), kNone, false, toTranslate("Save scene"), toTranslate("Save the scene with all changes, look and camera.")},
    {A::save_as, G::file, ctrlShift('S'), kNone, false, toTranslate("Save scene as ..."), toTranslate("Save the scene to another file.")},
    {A::reload, G::file, f(5), kNone, false, toTranslate("Read again"), toTranslate("Read the scene or mesh file once more.")},
    {A::reset, G::file, f(6), kNone, false, toTranslate("Reset"), toTranslate("Restore everything as it was opened or saved.")},
    {A::undo, G::file, ctrl('Z'), kNone, false, toTranslate("Undo"), toTranslate("Undo the last change, in any control.")},
    {A::redo, G::file, ctrlShift('Z'), kNone, false, toTranslate("Redo"), toTranslate("Redo the change that was undone.")},
    {A::copy_scene, G::file, ctrl('C'), kNone, false, toTranslate("Copy as a scene"), toTranslate("Copy what you see and feel now as the text of a scene file.")},
    {A::delete_selected, G::file, plain(Key::delete_key), kNone, false, toTranslate("Delete"), toTranslate("Delete the selected dysfunction or lump.")},
    {A::cancel, G::file, plain(Key::escape), kNone, false, toTranslate("Cancel"), toTranslate("Leave the drag, tool or dialog; never quits.")},
    {A::quit, G::file, ctrl('Q'), kNone, false, toTranslate("Quit"), toTranslate("Close the window.")},
};
// clang-format on
static_assert(std::size(kTable) == kActions);

std::string nameOf(Key k) {
  static constexpr std::pair<Key, std::string_view> kNames[] = {
      {Key::space, toTranslate("Space")},
      {Key::escape, toTranslate("Esc")},
      {Key::enter, toTranslate("Enter")},
      {Key::tab, toTranslate("Tab")},
      {Key::backspace, toTranslate("Backspace")},
      {Key::delete_key, toTranslate("Delete")},
      {Key::right, toTranslate("Right")},
      {Key::left, toTranslate("Left")},
      {Key::down, toTranslate("Down")},
      {Key::up, toTranslate("Up")},
      {Key::page_up, toTranslate("PgUp")},
      {Key::page_down, toTranslate("PgDn")},
      {Key::home, toTranslate("Home")},
      {Key::end, toTranslate("End")},
      {Key::pause, toTranslate("Pause")},
      {Key::left_bracket, "["},
      {Key::right_bracket, "]"},
      {Key::pad_1, toTranslate("Keypad 1")},
      {Key::pad_3, toTranslate("Keypad 3")},
      {Key::pad_7, toTranslate("Keypad 7")},
      {Key::pad_enter, toTranslate("Keypad Enter")},
  };
  for (const auto& [key, name] : kNames) {
    if (key == k) return std::string(name);
  }
  if (k >= Key::f1 && k <= Key::f12) return fmt::format("F{}", static_cast<int>(k) - static_cast<int>(Key::f1) + 1);
  return {static_cast<char>(k)};
}

bool isOverlay(Action action) { return action >= Action::show_wireframe && action <= Action::show_muscles; }

}  // namespace

std::span<const KeyBinding> keyTable() { return kTable; }

const KeyBinding& findBinding(Action action) {
  return *std::find_if(std::begin(kTable), std::end(kTable), [&](const auto& row) { return row.action == action; });
}

std::optional<PressedKey> findAction(const Chord& chord) {
  if (chord.key == Key::none) return std::nullopt;
  for (const KeyBinding& row : kTable) {
    if (row.chord == chord || row.also == chord) return PressedKey{row.action, false};
  }
  if (!chord.modifiers.shift) return std::nullopt;
  const Chord coarse{chord.key, {chord.modifiers.ctrl, false}};
  for (const KeyBinding& row : kTable) {
    if (row.fine_with_shift && (row.chord == coarse || row.also == coarse)) return PressedKey{row.action, true};
  }
  return std::nullopt;
}

std::string nameOf(const Chord& chord) {
  if (chord.key == Key::none) return {};
  return fmt::format("{}{}{}", chord.modifiers.ctrl ? "Ctrl+" : "", chord.modifiers.shift ? "Shift+" : "",
                     nameOf(chord.key));
}

std::string localisedChordName(const Chord& chord) {
  if (chord.key == Key::none) return {};
  std::string words;
  if (chord.modifiers.ctrl) words += fmt::format("{}+", tr("Ctrl"));
  if (chord.modifiers.shift) words += fmt::format("{}+", tr("Shift"));
  return words + tr(nameOf(chord.key).c_str());
}

std::string keysOf(const KeyBinding& binding) {
  const std::string second = localisedChordName(binding.also);
  const std::string first = localisedChordName(binding.chord);
  return second.empty() ? first : fmt::format("{} {} {}", first, tr("or"), second);
}

std::optional<view::Overlay> overlayFor(Action action) {
  if (!isOverlay(action)) return std::nullopt;
  return static_cast<view::Overlay>(static_cast<int>(action) - static_cast<int>(Action::show_wireframe));
}

std::optional<view::Colouring> colouringFor(Action action) {
  if (action < Action::colour_strain || action > Action::colour_ellipses) return std::nullopt;
  return static_cast<view::Colouring>(static_cast<int>(action) - static_cast<int>(Action::colour_strain) + 1);
}

Action actionFor(view::Overlay overlay) {
  return static_cast<Action>(static_cast<int>(Action::show_wireframe) + static_cast<int>(overlay));
}

std::string keysAsMarkdown() {
  std::string text;
  for (std::size_t group = 0; group < kKeyGroupNames.size(); ++group) {
    text += fmt::format("\n### {}\n\n| key | does |\n|---|---|\n", kKeyGroupNames[group]);
    for (const KeyBinding& row : kTable) {
      if (static_cast<std::size_t>(row.group) != group) continue;
      text += fmt::format("| {} | {}{} |\n", keysOf(row), row.does,
                          row.fine_with_shift ? " With Shift: a finer step." : "");
    }
  }
  return text;
}

}  // namespace palpate::window
