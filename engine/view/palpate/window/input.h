// Translates mouse and keyboard into intentions: raw events in, commands out. Pure; no window, no GL.
//
//   GLFW │ input script │ test ─► InputEvent ─► Input (this state machine) ─► Command ─► viewer
//
// The rule: the left button on the skin touches, the right button or empty space turns, the wheel zooms unless a finger
// is down. Touching changes nothing lasting, so it may be the plain left button. A finger is never left pressed by
// accident: losing the focus lifts all of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/window/keys.h"

namespace palpate::window {

enum class Button : std::uint8_t { left, right, middle };
inline constexpr std::size_t kButtons = 3;

struct InputEvent {
  enum class Kind : std::uint8_t { move, button, scroll, key, text, focus, leave, drop, resize };
  Kind kind = Kind::move;
  double time_s = 0.0;
  Vec2 at = Vec2::Zero();  ///< pixels of the picture from its upper left corner; resize: the new size
  Button button = Button::left;
  bool down = false;    ///< button, key: pressed; focus: gained
  bool repeat = false;  ///< key: held down
  Key key = Key::none;
  Modifiers modifiers = {};
  double notches = 0.0;   ///< scroll: away from the user is positive
  std::string text = {};  ///< typed text (UTF-8); drop: a file's path
};

/// Facts about the place and moment of an event.
struct Situation {
  bool on_skin = false;         ///< the skin is under the event's place
  bool over_gui = false;        ///< a panel, menu or popup has the mouse
  bool gui_wants_text = false;  ///< a text field has the keys
  bool editing = false;         ///< the dysfunction editor is open: the left button places and moves
};

struct Command {
  enum class Kind : std::uint8_t {
    act,        ///< `action`, `fine`
    hover,      ///< the ring goes to `at`
    press,      ///< the active finger goes down at `at`
    hold,       ///< it goes down where its ring is
    slide,      ///< it is dragged to `at`
    lift,       ///< it goes up
    lift_all,   ///< every finger goes up
    deepen,     ///< amount: notches (0.5 mm or 0.25 N each; may be a fraction)
    grab,       ///< a turn or pan begins at `at`: the thing there is its pivot
    orbit,      ///< by: pixels
    pan,        ///< by: pixels
    zoom,       ///< amount: notches; about `at`
    centre,     ///< the place at `at` becomes the centre of turning
    edit_grab,  ///< editor: place or grab at `at`
    edit_move,
    edit_drop,
    edit_size,      ///< editor: by `amount` notches
    edit_strength,  ///< editor: by `amount` notches
    take_finger,    ///< `finger` becomes the active one
  };
  Kind kind = Kind::act;
  Action action = Action::cancel;
  bool fine = false;
  bool over_gui = false;  ///< hold: a panel is under the mouse
  Vec2 at = Vec2::Zero();
  Vec2 by = Vec2::Zero();
  double amount = 0.0;
  std::size_t finger = 0;
};

/// Mouse buttons as in other programs.
enum class MousePreset : std::uint8_t {
  palpate,  ///< right turns, middle pans
  blender,  ///< middle turns, Shift and middle pans
  cad,      ///< middle turns, right pans
};
inline constexpr std::array<std::string_view, 3> kMousePresetNames = {"Palpate", "Blender", "CAD"};

struct InputSettings {
  MousePreset preset = MousePreset::palpate;
  bool swap_left_and_right = false;
  bool invert_zoom = false;
  double speed = 1.0;     ///< factor on turning
  bool shortcuts = true;  ///< false: only F1, Esc and the mouse
};

inline constexpr std::size_t kMouseFingers = 2;

class Input {
 public:
  InputSettings settings;

  /// Appends the commands for the event. Any order of events is safe.
  void handle(const InputEvent& event, const Situation& situation, std::vector<Command>& commands);

  std::size_t activeFinger() const { return active_; }
  /// A panel has chosen the finger.
  void useFinger(std::size_t finger);
  bool pressed(std::size_t finger) const { return pressed_[finger]; }
  bool held(std::size_t finger) const { return held_[finger]; }

 private:
  enum class Drag : std::uint8_t { none, touch, orbit, pan, edit };

  void move(const InputEvent& event, const Situation& situation, std::vector<Command>& commands);
  void buttonDown(const InputEvent& event, const Situation& situation, std::vector<Command>& commands);
  void buttonUp(const InputEvent& event, std::vector<Command>& commands);
  void scroll(const InputEvent& event, const Situation& situation, std::vector<Command>& commands);
  void keyDown(const InputEvent& event, const Situation& situation, std::vector<Command>& commands);
  void act(const PressedKey& pressed, const Situation& situation, std::vector<Command>& commands);
  void hold(const Situation& situation, std::vector<Command>& commands);
  void selectFinger(std::size_t finger, std::vector<Command>& commands);
  void begin(Drag drag, const InputEvent& event, std::vector<Command>& commands);
  void endDrag(std::vector<Command>& commands);
  void liftAll(std::vector<Command>& commands);
  Drag dragFor(Button button, const Modifiers& modifiers, const Situation& situation) const;
  Button meant(Button button) const;
  bool isSecondClick(const InputEvent& event);

  Drag drag_ = Drag::none;
  Button drag_button_ = Button::left;
  bool depth_drag_ = false;  // the right button with a pressing left one
  Vec2 last_ = Vec2::Zero();
  Vec2 last_click_ = Vec2::Constant(-1e9);
  double last_click_s_ = -1e9;
  std::size_t active_ = 0;
  std::array<bool, kMouseFingers> pressed_{};
  std::array<bool, kMouseFingers> held_{};
};

/// Pixels of vertical drag with both buttons for one notch of depth.
inline constexpr double kDepthDragPixels = 8.0;

}  // namespace palpate::window
