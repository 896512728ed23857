// At most one drag at a time. A button's effect is decided when it goes down, from button, modifiers, preset and the
// thing under it, and stays so until it is released: the skin may slip away below the cursor meanwhile. Pressed and
// held are two states of a finger, so that Enter and the button do not undo each other.
#include "palpate/window/input.h"

namespace palpate::window {

namespace {

/// A second click counts as a double click within this time and distance.
constexpr double kDoubleClickS = 0.35;
constexpr double kDoubleClickPixels = 5.0;
/// With Shift a notch of depth is a fifth: 0.1 mm instead of 0.5.
constexpr double kFineNotch = 0.2;

Command at(Command::Kind kind, const Vec2& place) { return {.kind = kind, .at = place}; }

Command commandWith(Command::Kind kind, const Vec2& place, double amount) {
  Command command = at(kind, place);
  command.amount = amount;
  return command;
}

}  // namespace

void Input::handle(const InputEvent& event, const Situation& situation, std::vector<Command>& commands) {
  using Kind = InputEvent::Kind;
  switch (event.kind) {
    case Kind::move:
      return move(event, situation, commands);
    case Kind::button:
      return event.down ? buttonDown(event, situation, commands) : buttonUp(event, commands);
    case Kind::scroll:
      return scroll(event, situation, commands);
    case Kind::key:
      if (event.down) keyDown(event, situation, commands);
      return;
    case Kind::focus:
      if (!event.down) {
        endDrag(commands);
        liftAll(commands);
      }
      return;
    case Kind::leave:
      if (drag_ == Drag::touch) endDrag(commands);
      return;
    default:
      return;
  }
}

void Input::move(const InputEvent& event, const Situation& situation, std::vector<Command>& commands) {
  const Vec2 moved = event.at - last_;
  last_ = event.at;
  if (drag_ == Drag::none) {
    if (!situation.over_gui) commands.push_back(at(Command::Kind::hover, event.at));
    return;
  }
  if (depth_drag_) {
    commands.push_back(commandWith(Command::Kind::deepen, event.at, moved.y() / kDepthDragPixels));
    return;
  }
  static constexpr Command::Kind kKinds[] = {Command::Kind::hover, Command::Kind::slide, Command::Kind::orbit,
                                             Command::Kind::pan, Command::Kind::edit_move};
  Command command = at(kKinds[static_cast<std::size_t>(drag_)], event.at);
  command.by = drag_ == Drag::orbit ? Vec2(settings.speed * moved) : moved;
  commands.push_back(command);
}

Button Input::meant(Button button) const {
  if (!settings.swap_left_and_right || button == Button::middle) return button;
  return button == Button::left ? Button::right : Button::left;
}

Input::Drag Input::dragFor(Button button, const Modifiers& modifiers, const Situation& situation) const {
  const bool middle_pans = settings.preset == MousePreset::palpate;
  switch (button) {
    case Button::left:
      if (modifiers.ctrl) return Drag::orbit;
      if (modifiers.shift) return Drag::pan;
      if (!situation.on_skin) return Drag::orbit;
      return situation.editing ? Drag::edit : Drag::touch;
    case Button::right:
      return modifiers.shift || settings.preset == MousePreset::cad ? Drag::pan : Drag::orbit;
    default:
      return middle_pans || modifiers.shift ? Drag::pan : Drag::orbit;
  }
}

void Input::buttonDown(const InputEvent& event, const Situation& situation, std::vector<Command>& commands) {
  last_ = event.at;
  const Button button = meant(event.button);
  if (drag_ != Drag::none) {
    depth_drag_ = depth_drag_ || (drag_ == Drag::touch && button == Button::right);
    return;
  }
  if (situation.over_gui) return;
  const Drag drag = dragFor(button, event.modifiers, situation);
  if (button == Button::left && isSecondClick(event) && drag != Drag::edit) {
    commands.push_back(at(Command::Kind::centre, event.at));
    return;
  }
  drag_button_ = event.button;
  begin(drag, event, commands);
}

bool Input::isSecondClick(const InputEvent& event) {
  const bool second = event.time_s - last_click_s_ <= kDoubleClickS && event.time_s >= last_click_s_ &&
                      (event.at - last_click_).norm() <= kDoubleClickPixels;
  last_click_ = event.at;
  last_click_s_ = second ? -1e9 : event.time_s;  // a third click is a first one again
  return second;
}

void Input::begin(Drag drag, const InputEvent& event, std::vector<Command>& commands) {
  drag_ = drag;
  depth_drag_ = false;
  if (drag == Drag::touch) {
    pressed_[active_] = true;
    commands.push_back(at(Command::Kind::press, event.at));
  } else {
    commands.push_back(at(drag == Drag::edit ? Command::Kind::edit_grab : Command::Kind::grab, event.at));
  }
}

void Input::buttonUp(const InputEvent& event, std::vector<Command>& commands) {
  last_ = event.at;
  if (drag_ == Drag::none) return;
  if (event.button == drag_button_) {
    endDrag(commands);
  } else if (meant(event.button) == Button::right) {
    depth_drag_ = false;
  }
}

void Input::endDrag(std::vector<Command>& commands) {
  const Drag ended = drag_;
  drag_ = Drag::none;
  depth_drag_ = false;
  if (ended == Drag::edit) commands.push_back(at(Command::Kind::edit_drop, last_));
  if (ended != Drag::touch || held_[active_]) return;
  pressed_[active_] = false;
  commands.push_back(at(Command::Kind::lift, last_));
}

void Input::liftAll(std::vector<Command>& commands) {
  if (drag_ == Drag::touch) drag_ = Drag::none;
  pressed_.fill(false);
  held_.fill(false);
  commands.push_back(at(Command::Kind::lift_all, last_));
}

void Input::scroll(const InputEvent& event, const Situation& situation, std::vector<Command>& commands) {
  if (situation.over_gui && drag_ == Drag::none) return;
  if (situation.editing) {
    const auto kind = event.modifiers.shift ? Command::Kind::edit_strength : Command::Kind::edit_size;
    commands.push_back(commandWith(kind, event.at, event.notches));
  } else if (pressed_[active_]) {
    // Towards the user is deeper, like pushing a finger down.
    commands.push_back(
        commandWith(Command::Kind::deepen, event.at, -event.notches * (event.modifiers.shift ? kFineNotch : 1.0)));
  } else {
    commands.push_back(
        commandWith(Command::Kind::zoom, event.at, settings.invert_zoom ? -event.notches : event.notches));
  }
}

void Input::keyDown(const InputEvent& event, const Situation& situation, std::vector<Command>& commands) {
  if (situation.gui_wants_text) return;
  const auto pressed = findAction({event.key, event.modifiers});
  if (!pressed) return;
  const bool always = pressed->action == Action::help || pressed->action == Action::cancel;
  if (!settings.shortcuts && !always) return;
  const bool steps = findBinding(pressed->action).fine_with_shift;
  if (event.repeat && !steps) return;  // a switch flips once per press of its key
  act(*pressed, situation, commands);
}

void Input::act(const PressedKey& pressed, const Situation& situation, std::vector<Command>& commands) {
  switch (pressed.action) {
    case Action::hold:
      return hold(situation, commands);
    case Action::deeper:
    case Action::lighter: {
      const double notch = pressed.fine ? kFineNotch : 1.0;
      commands.push_back(commandWith(Command::Kind::deepen, last_, pressed.action == Action::deeper ? notch : -notch));
      return;
    }
    case Action::take_left_finger:
      return selectFinger(0, commands);
    case Action::take_right_finger:
      return selectFinger(1, commands);
    case Action::lift_all:
      return liftAll(commands);
    case Action::cancel:
      endDrag(commands);
      break;
    default:
      break;
  }
  Command command = at(Command::Kind::act, last_);
  command.action = pressed.action;
  command.fine = pressed.fine;
  commands.push_back(command);
}

void Input::hold(const Situation& situation, std::vector<Command>& commands) {
  if (held_[active_]) {
    held_[active_] = false;
    if (drag_ == Drag::touch) return;  // the button still presses it
    pressed_[active_] = false;
    commands.push_back(at(Command::Kind::lift, last_));
    return;
  }
  held_[active_] = true;
  if (!pressed_[active_]) {
    commands.push_back(at(Command::Kind::hold, last_));
    commands.back().over_gui = situation.over_gui;
  }
  pressed_[active_] = true;
}

void Input::useFinger(std::size_t finger) {
  std::vector<Command> known_already;
  selectFinger(finger, known_already);
}

/// The other finger keeps its state: if the button pressed it, it is held from now on.
void Input::selectFinger(std::size_t finger, std::vector<Command>& commands) {
  if (finger == active_) return;
  if (drag_ == Drag::touch) {
    held_[active_] = true;
    drag_ = Drag::none;
  }
  active_ = finger;
  Command command = at(Command::Kind::take_finger, last_);
  command.finger = finger;
  commands.push_back(command);
}

}  // namespace palpate::window
