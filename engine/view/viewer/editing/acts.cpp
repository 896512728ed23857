#include "view/viewer/editing/acts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "palpate/base/language.h"
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/editing/lump_editor.h"
#include "view/viewer/state/replay.h"

namespace palpate::viewer {

namespace {

using window::Action;

/// The switch of an action, in a state that may be constant; null for other actions.
template <class S>
auto* findSwitch(Action action, S& viewer) {
  auto& shown = viewer.state.shown;
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
      return &viewer.replay.frozen;
    case Action::swap_eyes:
      return &viewer.state.stereo.swap_eyes;
    case Action::measure:
      return &viewer.ruler.active;
    default:
      return static_cast<decltype(&viewer.replay.frozen)>(nullptr);
  }
}

/// The request for those who own the window, the files and the servo, if an action is one.
std::optional<Request> requestFor(Action action) {
  static const std::pair<Action, Request> requests[] = {
      {Action::emergency_stop, StopDevices{}},
      {Action::full_screen, ToggleFullScreen{}},
      {Action::screenshot, TakeScreenshot{}},
      {Action::screenshot_with_pop_ups, TakeScreenshot{.with_pop_ups = true}},
      {Action::clear_screenshot, TakeClearScreenshot{}},
      {Action::play_script, PlayScript{}},
      {Action::record, ToggleForces{}},
      {Action::keep_recording, KeepRecording{}},
      {Action::mark, SetMark{}},
      {Action::save, SaveScene{}},
      {Action::reload, Reload{}},
      {Action::reset, ResetScene{}},
      {Action::undo, Undo{}},
      {Action::redo, Redo{}},
      {Action::copy_scene, CopyScene{}},
      {Action::quit, Quit{}},
      {Action::home, GoHome{}},
  };
  for (const auto& [known, request] : requests) {
    if (known == action) return request;
  }
  return std::nullopt;
}

void nextStereoMode(BodyView& seen, Conversation& user) {
  auto& mode = seen.state.stereo.mode;
  auto next = (static_cast<std::size_t>(mode) + 1) % view::kStereoModeNames.size();
  const bool quad_buffer = static_cast<view::StereoMode>(next) == view::StereoMode::quad_buffer;
  if (quad_buffer && !seen.quad_buffer_offered) next = 0;
  mode = static_cast<view::StereoMode>(next);
  user.report(Severity::info, trf("Stereo: {}", tr(std::string(view::kStereoModeNames[next]).c_str())));
}

void leaveEditors(EditedScene& edited, UiOutput& output) {
  if (edited.editor.active) stopEditing(edited.dysfunctions(output));
  if (edited.lump_editor.active) stopEditing(edited.lumps(output));
}

/// Deletes lumps while they are edited, or where only one of them is selected.
void deleteSelection(EditedScene& edited, UiOutput& output) {
  const bool of_lumps = edited.lump_editor.active || (!edited.editor.active && edited.editor.selected < 0);
  of_lumps ? deleteSelected(edited.lumps(output)) : deleteSelected(edited.dysfunctions(output));
}

/// Starts again, or sets an end; the editor uses the same button.
void startMeasuring(Ruler& ruler, EditedScene& edited, UiOutput& output) {
  const bool on = !ruler.active;
  if (on) leaveEditors(edited, output);
  ruler = {};
  ruler.active = on;
}

/// Steps of the speed of time.
constexpr std::array<double, 7> kTimeSpeeds = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};

void changeTimeSpeed(double& speed, int step, Conversation& user) {
  const auto at = std::lower_bound(kTimeSpeeds.begin(), kTimeSpeeds.end(), speed - 1e-6);
  const auto now = static_cast<int>(at - kTimeSpeeds.begin());
  const int next = std::clamp(now + step, 0, static_cast<int>(kTimeSpeeds.size()) - 1);
  speed = kTimeSpeeds[static_cast<std::size_t>(next)];
  user.report(Severity::info, trf("Playback speed x{:g}", speed));
}

/// Escape leaves the innermost thing: a page, then the editor. It never quits. Dialogs handle it themselves.
void cancel(EditedScene& edited, BodyView& seen, UiOutput& output) {
  Shown& shown = seen.state.shown;
  if (shown.help) {
    shown.help = false;
  } else if (shown.messages) {
    shown.messages = false;
  } else if (edited.editing()) {
    leaveEditors(edited, output);
  } else if (seen.ruler.active) {
    seen.ruler = {};
  } else if (edited.building) {
    output.request(CancelBuild{});
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

void perform(Action action, ViewerState& viewer) {
  EditedScene& edited = viewer;
  BodyView& seen = viewer;
  view::Look& look = seen.state.look;
  if (const auto overlay = window::overlayFor(action)) return look.show(*overlay, !look.shows(*overlay));
  if (const auto colouring = window::colouringFor(action)) {
    look.colouring = look.colouring == *colouring ? view::Colouring::plain : *colouring;
    return;
  }
  if (action == Action::measure) return startMeasuring(seen.ruler, edited, viewer.output);
  if (action == Action::freeze) return freeze(viewer.replay, !viewer.replay.frozen);
  if (bool* on = findSwitch(action, viewer)) {
    *on = !*on;
    return;
  }
  if (auto request = requestFor(action)) return viewer.request(*std::move(request));
  switch (action) {
    case Action::skin_opacity:
      look.skin_opacity = nextOpacity(look.skin_opacity);
      return;
    case Action::stereo_mode:
      return nextStereoMode(seen, viewer);
    case Action::slower:
      return changeTimeSpeed(viewer.time_speed, -1, viewer);
    case Action::faster:
      return changeTimeSpeed(viewer.time_speed, 1, viewer);
    case Action::open:
      viewer.state.shown.open_dialog = true;
      return;
    case Action::find_place:
      viewer.place_search = {.open = true};
      return;
    case Action::save_as:
      viewer.state.shown.save_dialog = true;
      return;
    case Action::delete_selected:
      return deleteSelection(edited, viewer.output);
    case Action::cancel:
      return cancel(edited, seen, viewer.output);
    case Action::measure_person:  // no mode has handled it
      return viewer.report(Severity::info, "This window cannot measure photographs");
    default:
      return;
  }
}

bool isOn(Action action, const ViewerState& viewer) {
  const view::Look& look = viewer.state.look;
  if (const auto overlay = window::overlayFor(action)) return look.shows(*overlay);
  if (const auto colouring = window::colouringFor(action)) return look.colouring == *colouring;
  if (action == Action::record) return viewer.recording.forces;
  const bool* on = findSwitch(action, viewer);
  return on != nullptr && *on;
}

}  // namespace palpate::viewer
