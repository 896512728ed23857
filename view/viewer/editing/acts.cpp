#include "view/viewer/editing/acts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/state/replay.h"

namespace palpate::viewer {

namespace {

using window::Action;

/// The switch of an action, in a session that may be constant; null for actions that are no switches.
template <class S>
auto* switchOf(Action action, S& session) {
  auto& shown = session.state.shown;
  switch (action) {
    case Action::help:
      return &shown.help;
    case Action::numbers:
      return &shown.numbers;
    case Action::performance:
      return &shown.performance;
    case Action::plots:
      return &shown.plots;
    case Action::reach:
      return &shown.reach;
    case Action::panel:
      return &shown.panel;
    case Action::freeze:
      return &session.replay.frozen;
    case Action::swap_eyes:
      return &session.state.stereo.swap_eyes;
    case Action::measure:
      return &session.ruler.active;
    default:
      return static_cast<decltype(&session.replay.frozen)>(nullptr);
  }
}

/// What an action only hands on to those who hold the window, the files and the servo; nothing for the others.
std::optional<Request> requestOf(Action action) {
  switch (action) {
    case Action::emergency_stop:
      return StopDevices{};
    case Action::full_screen:
      return ToggleFullScreen{};
    case Action::screenshot:
      return TakeScreenshot{};
    case Action::screenshot_with_pop_ups:
      return TakeScreenshot{.with_pop_ups = true};
    case Action::clear_screenshot:
      return TakeClearScreenshot{};
    case Action::play_script:
      return PlayScript{};
    case Action::record:
      return ToggleForces{};
    case Action::keep_session:
      return KeepRecording{};
    case Action::mark:
      return SetMark{};
    case Action::save:
      return SaveScene{};
    case Action::reload:
      return Reload{};
    case Action::reset:
      return ResetScene{};
    case Action::undo:
      return Undo{};
    case Action::redo:
      return Redo{};
    case Action::copy_scene:
      return CopyScene{};
    case Action::quit:
      return Quit{};
    case Action::home:
      return GoHome{};
    default:
      return std::nullopt;
  }
}

void nextStereoMode(Session& session) {
  auto& mode = session.state.stereo.mode;
  auto next = (static_cast<std::size_t>(mode) + 1) % view::kStereoModeNames.size();
  const bool quad_buffer = static_cast<view::StereoMode>(next) == view::StereoMode::quad_buffer;
  if (quad_buffer && !session.quad_buffer_offered) next = 0;
  mode = static_cast<view::StereoMode>(next);
  session.report(Severity::info, fmt::format("Stereo: {}", view::kStereoModeNames[next]));
}

/// Anew, or an end of it; the editor wants the same button.
void startMeasuring(Session& session) {
  const bool on = !session.ruler.active;
  if (on && session.editor.active) stopEditing(session.dysfunctions());
  session.ruler = {};
  session.ruler.active = on;
}

/// Speeds of time that are gone through.
constexpr std::array<double, 7> kTimeSpeeds = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};

void changeTimeSpeed(Session& session, int step) {
  const auto at = std::lower_bound(kTimeSpeeds.begin(), kTimeSpeeds.end(), session.time_speed - 1e-6);
  const auto now = static_cast<int>(at - kTimeSpeeds.begin());
  const int next = std::clamp(now + step, 0, static_cast<int>(kTimeSpeeds.size()) - 1);
  session.time_speed = kTimeSpeeds[static_cast<std::size_t>(next)];
  session.report(Severity::info, fmt::format("What is played passes at {:g} of its time", session.time_speed));
}

/// Escape leaves the innermost thing: a dialog, a page, then the editor. It never quits.
void cancel(Session& session) {
  Shown& shown = session.state.shown;
  if (shown.open_dialog || shown.save_dialog) {
    shown.open_dialog = shown.save_dialog = false;
  } else if (shown.help) {
    shown.help = false;
  } else if (shown.messages) {
    shown.messages = false;
  } else if (session.editor.active) {
    stopEditing(session.dysfunctions());
  } else if (session.ruler.active) {
    session.ruler = {};
  } else if (session.building) {
    session.request(CancelBuild{});
  }
}

}  // namespace

double nextOpacity(double opacity) {
  static constexpr std::array<double, 4> kSteps = {1.0, 0.6, 0.3, 0.0};
  for (const double step : kSteps) {
    if (step < opacity - 1e-6) return step;
  }
  return 1.0;
}

void perform(Action action, Session& session) {
  view::Look& look = session.state.look;
  if (const auto overlay = window::overlayOf(action)) return look.show(*overlay, !look.shows(*overlay));
  if (const auto colouring = window::colouringOf(action)) {
    look.colouring = look.colouring == *colouring ? view::Colouring::plain : *colouring;
    return;
  }
  if (action == Action::measure) return startMeasuring(session);
  if (action == Action::freeze) return freeze(session.replay, !session.replay.frozen);
  if (bool* on = switchOf(action, session)) {
    *on = !*on;
    return;
  }
  if (auto request = requestOf(action)) return session.request(*std::move(request));
  switch (action) {
    case Action::skin_opacity:
      look.skin_opacity = nextOpacity(look.skin_opacity);
      return;
    case Action::stereo_mode:
      return nextStereoMode(session);
    case Action::slower:
      return changeTimeSpeed(session, -1);
    case Action::faster:
      return changeTimeSpeed(session, 1);
    case Action::open:
      session.state.shown.open_dialog = true;
      return;
    case Action::save_as:
      session.state.shown.save_dialog = true;
      return;
    case Action::delete_selected:
      return deleteSelected(session.dysfunctions());
    case Action::cancel:
      return cancel(session);
    case Action::measure_person:  // no mode has taken it
      return session.report(Severity::info, "This window measures no photographs");
    default:
      return;
  }
}

bool isOn(Action action, const Session& session) {
  const view::Look& look = session.state.look;
  if (const auto overlay = window::overlayOf(action)) return look.shows(*overlay);
  if (const auto colouring = window::colouringOf(action)) return look.colouring == *colouring;
  if (action == Action::record) return session.recording.forces;
  const bool* on = switchOf(action, session);
  return on != nullptr && *on;
}

}  // namespace palpate::viewer
