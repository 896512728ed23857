#include "teach/window/training_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpate::viewer {

namespace {

using window::Key;
using StrokeKind = TrainingStroke::Kind;

/// During a test only these of the window's keys work: no other key may reach what a test hides.
bool passesThrough(const window::InputEvent& event) {
  static constexpr std::array kKept = {Key::f12,           Key::page_up, Key::page_down,         Key::left_bracket,
                                       Key::right_bracket, Key::home,    window::functionKey(11)};
  return !event.modifiers.ctrl && std::ranges::find(kKept, event.key) != kKept.end();
}

TrainingStroke pressed(const TrainingScreen& screen, std::size_t index) {
  if (index >= screen.buttons.size() || !screen.buttons[index].enabled) return {};
  const TrainingButton& button = screen.buttons[index];
  return {.kind = StrokeKind::press_button, .click = {button.act, button.value}};
}

TrainingStroke strokeForAct(const TrainingScreen& screen, TrainingAct act) {
  const auto found = std::ranges::find(screen.buttons, act, &TrainingButton::act);
  return pressed(screen, static_cast<std::size_t>(found - screen.buttons.begin()));
}

bool offers(const TrainingScreen& screen, TrainingAct act) {
  return std::ranges::find(screen.buttons, act, &TrainingButton::act) != screen.buttons.end();
}

/// The next button that can be pressed, round the end.
TrainingStroke focusMoved(const TrainingScreen& screen, bool forward) {
  const std::size_t count = screen.buttons.size();
  for (std::size_t step = 1; step < count; ++step) {
    const std::size_t index = (screen.focus + (forward ? step : count - step)) % count;
    if (screen.buttons[index].enabled) return {.kind = StrokeKind::focus, .index = index};
  }
  return {};
}

/// Back: whatever of these the screen offers.
TrainingStroke escaped(const TrainingScreen& screen) {
  for (const TrainingAct act : {TrainingAct::leave, TrainingAct::no, TrainingAct::sign_out}) {
    if (const TrainingStroke stroke = strokeForAct(screen, act); stroke.kind != StrokeKind::nothing) return stroke;
  }
  return {};
}

Vec2 keyDirection(Key key) {
  if (key == Key::left) return {-1.0, 0.0};
  if (key == Key::right) return {1.0, 0.0};
  if (key == Key::up) return {0.0, 1.0};
  if (key == Key::down) return {0.0, -1.0};
  return Vec2::Zero();
}

TrainingStroke onTrial(const window::InputEvent& event, const TrainingScreen& screen) {
  if (const Vec2 by = keyDirection(event.key); by != Vec2::Zero()) return {.kind = StrokeKind::walk, .by = by};
  if (event.key == Key::space && !event.repeat) return {.kind = StrokeKind::touch};
  if (event.key == Key::enter || event.key == Key::pad_enter) return strokeForAct(screen, TrainingAct::answer);
  if (event.key == Key::backspace) return {.kind = StrokeKind::erase};
  if (event.key == window::key('P')) return strokeForAct(screen, TrainingAct::pause);
  return {};
}

TrainingStroke onCard(const window::InputEvent& event, const TrainingScreen& screen) {
  if (screen.place == TrainingPlace::body) {
    if (const Vec2 by = keyDirection(event.key); by != Vec2::Zero()) return {.kind = StrokeKind::walk, .by = by};
    if (event.key == window::key('T') && !event.repeat) return {.kind = StrokeKind::touch};
    if (event.key == Key::backspace) return {.kind = StrokeKind::erase};
    if (event.key == window::key('P') && offers(screen, TrainingAct::pause))
      return strokeForAct(screen, TrainingAct::pause);
  }
  const bool back = event.key == Key::left || event.key == Key::up;
  const bool on = event.key == Key::right || event.key == Key::down || event.key == Key::tab;
  if (back || on) return focusMoved(screen, on && !(event.key == Key::tab && event.modifiers.shift));
  if (event.key == Key::enter || event.key == Key::pad_enter) return pressed(screen, screen.focus);
  if (event.key == Key::backspace) return {.kind = StrokeKind::erase};
  if (event.key == Key::space && !screen.entry) return pressed(screen, screen.focus);
  if (event.key == window::key('P')) return strokeForAct(screen, TrainingAct::go_on);
  return {};
}

}  // namespace

bool isForbidden(const window::Command& command) {
  using CommandKind = window::Command::Kind;
  switch (command.kind) {
    case CommandKind::act: {
      using window::Action;
      static constexpr std::array kAllowed = {Action::deeper, Action::lighter,     Action::home,
                                              Action::clutch, Action::full_screen, Action::screenshot};
      return std::ranges::find(kAllowed, command.action) == kAllowed.end();
    }
    case CommandKind::edit_grab:
    case CommandKind::edit_move:
    case CommandKind::edit_drop:
    case CommandKind::edit_size:
    case CommandKind::edit_strength:
      return true;
    default:
      return false;
  }
}

TrainingStroke interpretInput(const window::InputEvent& event, const TrainingScreen& screen) {
  using EventKind = window::InputEvent::Kind;
  if (event.kind == EventKind::text) return {.kind = StrokeKind::letters, .text = event.text};
  if (event.kind != EventKind::key) return {.kind = StrokeKind::pass};
  if (passesThrough(event)) return {.kind = StrokeKind::pass};
  if (!event.down) return {};
  if (event.modifiers.ctrl) {
    const bool quits = event.key == window::key('Q');
    return quits ? TrainingStroke{.kind = StrokeKind::press_button, .click = {TrainingAct::quit, 0}} : TrainingStroke{};
  }
  if (event.key == Key::escape) return escaped(screen);
  return screen.picks_sites ? onTrial(event, screen) : onCard(event, screen);
}

int siteTowards(const training::SiteSet& sites, int from, const Vec2& by) {
  const training::Site* start = sites.numbered(from);
  if (start == nullptr) return sites.sites.empty() ? 0 : sites.sites.front().number;
  int best = from;
  double least = std::numeric_limits<double>::infinity();
  for (const training::Site& site : sites.sites) {
    const Vec2 way = site.place_mm - start->place_mm;
    const double along = way.dot(by);
    const double across = std::abs(way.x() * by.y() - way.y() * by.x());
    if (along <= 1.0 || across > 1.5 * along) continue;
    // Prefers straight ahead to merely near.
    if (const double cost = along + 2.0 * across; cost < least) {
      least = cost;
      best = site.number;
    }
  }
  return best;
}

}  // namespace palpate::viewer
