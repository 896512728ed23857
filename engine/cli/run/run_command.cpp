// `palpate run`: opens the window on a scene, to be touched with the mouse.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/device_option.h"
#include "cli/kit/families.h"
#include "cli/kit/interruption.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "cli/own/commands.h"
#include "cli/run/control_lines.h"
#include "cli/run/opening.h"
#include "cli/run/other_programs.h"
#include "cli/run/playback.h"
#include "cli/run/run_modes.h"
#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/head/head_stream.h"
#include "palpate/device/head/openxr_head.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/window/window.h"
#include "view/viewer/state/state_file.h"
#include "view/viewer/viewer.h"

namespace palpate::app {

namespace {

std::vector<OfferedMode>& offeredModes() {
  static std::vector<OfferedMode> modes;
  return modes;
}

struct RunOptions {
  std::string scene;
  std::string preset;
  std::string begin;  ///< measuring or class; empty: neither
  std::string play;
  std::string out = ".";
  std::string replay;
  std::string beside;
  std::vector<ModeMaker> modes;
  std::string stereo;
  std::string head_tracker;          ///< [ADDRESS:]PORT or openxr; empty: none
  std::vector<std::string> devices;  ///< for the first fingers, instead of the mouse
  double unit_mm = 0.0;              ///< for a mesh file; 0: the format's
  std::string group;
  int width = 0;
  int height = 0;
  std::uint64_t frames = 0;
  bool unsafe_stiffness = false;
  bool no_intro = false;
  bool no_shortcuts = false;
  bool no_state = false;
  bool no_recording = false;
  std::string language;    ///< a code; empty: the remembered one, else the system's
  std::string recordings;  ///< folder; empty: the user's own
  bool full_screen = false;
  bool verbose = false;
  bool keys = false;
};

viewer::StateReading readRememberedState(const RunOptions& options) {
  return options.no_state ? viewer::StateReading{} : viewer::readState(viewer::stateFile());
}

window::WindowSettings windowFor(const RunOptions& options, const viewer::StateReading& state) {
  window::WindowSettings settings = state.remembered ? state.remembered->window : window::WindowSettings{};
  if (options.width > 0) settings.width = options.width;
  if (options.height > 0) settings.height = options.height;
  settings.full_screen = settings.full_screen || options.full_screen;
  settings.quad_buffer =
      !options.stereo.empty() && view::stereoModeNamed(options.stereo) == view::StereoMode::quad_buffer;
  return settings;
}

/// Prints one line per frame, for tests and bug reports.
void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);  // a reader that has left must not end the window
  std::fflush(stdout);
}

void logFrame(std::uint64_t number, double now_s, viewer::Viewer& viewer) {
  const viewer::ViewerState& s = viewer.state();
  const contact::FingerOutput& finger = s.fingers[s.active_finger];
  const viewer::Message* message = s.messages.all().empty() ? nullptr : &s.messages.all().back();
  print(fmt::format(
      "frame {} t={:.3f} size={}x{} finger={} pressed={} depth={:.2f} force={:.2f} drag={:.2f} set_depth={:.2f} "
      "distance={:.0f} yaw={:.3f} body={} building={} panel={} overlays={} row={} recording={} changed={} question={} "
      "message={}\n",
      number, now_s, viewer.target().width(), viewer.target().height(), s.active_finger,
      viewer.pointer().pressed(s.active_finger) ? 1 : 0, finger.depth_mm, finger.force.norm(),
      (finger.proxy - finger.anchor).norm(), s.state.touch.depth_mm, s.camera.distance_mm, s.camera.yaw_rad,
      s.world.triangles, s.building ? 1 : 0, s.state.shown.panel ? 1 : 0, s.state.look.overlays.to_string(),
      s.state.stereo.monitor_row, s.recording.forces ? 1 : 0, s.history.changed() ? 1 : 0, s.question ? 1 : 0,
      message == nullptr ? "-" : message->text));
}

void logServo(const servo::LoopReport& report) {
  print(fmt::format(
      "servo: {} ticks in {:.1f} s, {} overruns, {} slow, {} stalls; tick p50 {:.1f} p99 {:.1f} us; late p50 "
      "{:.1f} p99 {:.1f} p99.9 {:.1f} max {:.0f} us\n",
      report.ticks, report.wall_s, report.overruns, report.slow_ticks, report.stalls, report.compute.p50_us,
      report.compute.p99_us, report.lateness.p50_us, report.lateness.p99_us, report.lateness.p99_9_us,
      report.lateness.max_us));
}

viewer::OpenedScene namedScene(const RunOptions& options) {
  if (!options.preset.empty() && !options.scene.empty()) {
    throw Error(options.scene + " and --preset " + options.preset + ": only one scene can be given");
  }
  if (!options.preset.empty()) {
    return {scene::presetScene(options.preset), {.title = std::string(scene::presetNamed(options.preset).title)}};
  }
  const scene::Scene standard = scene::standardScene();
  if (options.scene.empty()) return {standard, {}};
  viewer::OpenedScene opened = viewer::sceneFromFile(options.scene, standard);
  if (options.unit_mm == 0.0 && options.group.empty()) return opened;
  if (!opened.scene.file.empty()) {
    throw Error("--unit and --group are for mesh files: " + options.scene + " has its own");
  }
  useUnit(options.unit_mm, opened.scene.body);
  opened.scene.body.group = options.group;
  return opened;
}

/// The consent is for this scene: one opened later does not have it.
viewer::OpenedScene sceneToRun(const RunOptions& options) {
  viewer::OpenedScene opened = namedScene(options);
  opened.scene.safety.unsafe_stiffness = options.unsafe_stiffness;
  return opened;
}

void saveState(const RunOptions& options, viewer::Viewer& viewer, const window::Window& window) {
  if (!options.no_state) viewer::writeState(viewer::stateFile(), {viewer.state().state, window.placement()});
}

/// An unread error at the end becomes the command's, since the window is closed.
void finishViewer(const RunOptions& options, viewer::Viewer& viewer) {
  viewer::Messages& messages = viewer.state().messages;
  messages.markRead();
  const servo::LoopReport report = viewer.finish(endingSignal() == 0 ? "done" : nameOfSignal(endingSignal()));
  if (options.verbose) logServo(report);
  if (messages.unread() == 0) return;
  for (auto message = messages.all().rbegin(); message != messages.all().rend(); ++message) {
    if (message->severity == viewer::Severity::error) throw Error(message->text);
  }
}

/// A signal leaves no time for a question.
void saveBackup(const viewer::Viewer& viewer) {
  if (endingSignal() == 0) return;
  try {
    const std::filesystem::path kept = viewer.saveBackup();
    if (!kept.empty()) say(fmt::format("palpate: the changed scene is kept as {}\n", kept.string()));
  } catch (const Error& error) {
    say(fmt::format("palpate: the changed scene is lost: {}\n", error.what()));
  }
}

/// Without saved state, recordings need a named folder.
std::filesystem::path recordingFolder(const RunOptions& options) {
  if (options.no_recording) return {};
  if (!options.recordings.empty()) return std::filesystem::absolute(pathOf(options.recordings));
  return options.no_state ? std::filesystem::path() : viewer::recordingsFolder();
}

/// An unreadable file must fail before the window opens.
void checkReplays(const RunOptions& options) {
  if (!options.beside.empty() && !trace::isRecording(pathOf(options.replay))) {
    throw Error("--beside requires --replay with a recording");
  }
  for (const std::string& file : {options.replay, options.beside}) {
    if (file.empty()) continue;
    trace::isRecording(pathOf(file)) ? static_cast<void>(trace::RecordingReader(pathOf(file)))
                                     : static_cast<void>(trace::readForcesTable(pathOf(file)));
  }
}

/// The source of the head's position: none, a tracker's program, or a headset.
using HeadSource = std::variant<std::monostate, device::HeadStream, device::OpenXrHead>;

void openHeadSource(const std::string& which, HeadSource& heads) {
  if (which.empty()) return;
  if (which == "openxr") {
    heads.emplace<device::OpenXrHead>();
  } else if (which.find_first_of("0123456789") != std::string::npos) {
    heads.emplace<device::HeadStream>(which);
  } else {
    throw Error(fmt::format("head tracker: '{}' must be [ADDRESS:]PORT or openxr", oneLine(which)));
  }
}

std::optional<Vec3> newestHead(HeadSource& heads) {
  if (auto* stream = std::get_if<device::HeadStream>(&heads)) return stream->newest();
  if (auto* headset = std::get_if<device::OpenXrHead>(&heads)) return headset->newest();
  return std::nullopt;
}

/// Measured from the expected head: there the tracker was centred, or the headset first seen.
void followHead(HeadSource& heads, viewer::Viewer& viewer, double now_s) {
  const std::optional<Vec3> place = newestHead(heads);
  const viewer::HeadSettings& head = viewer.state().state.head;
  if (place) viewer.headAt(head.expected_mm - head.offset_mm + *place, now_s);
}

/// True without any particular request.
bool wantsStartPage(const RunOptions& options, const viewer::ViewState& state) {
  const bool asked_for = !options.scene.empty() || !options.preset.empty() || !options.replay.empty() ||
                         !options.play.empty() || !options.devices.empty() || !options.begin.empty() ||
                         options.frames > 0;
  return state.start_page && !options.no_intro && !asked_for;
}

/// Becomes the program for the activity: the training's, or a new window with the parts built since.
void becomeActivity(viewer::Activity activity, const RunOptions& options) {
  using viewer::Activity;
  const bool trains = activity == Activity::training;
  std::vector<std::string> words = {trains ? "train" : "run"};
  if (options.verbose) words.emplace_back("--verbose");
  if (!options.language.empty()) words.insert(words.end(), {"--language", options.language});
  if (trains) {
    becomeFamily({.group = {}, .command = "train", .family = "teach", .what = {}}, words);
    return;
  }
  words.insert(words.end(), {"--begin", activity == Activity::measuring ? "measuring" : "class", "--out", options.out});
  if (options.no_state) words.emplace_back("--no-state");
  if (options.no_recording) words.emplace_back("--no-session");
  if (!options.recordings.empty()) words.insert(words.end(), {"--sessions", options.recordings});
  becomeCommand(words);
}

/// All but the document, and the devices, which need a body.
viewer::ViewerSettings viewerSettings(const RunOptions& options, const viewer::StateReading& state) {
  viewer::ViewerSettings settings;
  settings.intro = !options.no_intro && !state.remembered && options.play.empty();
  settings.output_folder = pathOf(options.out);
  settings.recording_folder = recordingFolder(options);
  settings.default_scene = scene::standardScene();
  for (const ModeMaker& make : options.modes) settings.modes.push_back(make());
  return settings;
}

viewer::ViewState viewState(const RunOptions& options, const viewer::StateReading& state) {
  viewer::ViewState view_state = state.remembered ? state.remembered->state : viewer::ViewState{};
  view_state.input.shortcuts = !options.no_shortcuts;
  if (!options.stereo.empty()) view_state.stereo.mode = view::stereoModeNamed(options.stereo);
  if (!options.head_tracker.empty()) view_state.head.on = true;
  return view_state;
}

/// The viewer continues where the start page was when the body was ready, and does what the options ask for.
void beginWith(const Opening& opening, const RunOptions& options, viewer::ViewerState& viewer) {
  viewer.state.shown.start = opening.page;
  viewer.awaited = opening.awaited;
  for (const viewer::Request& request : opening.requests) viewer.request(request);
  for (const window::Action action : opening.actions) viewer.output.act(action);
  if (options.no_intro) viewer.hint = viewer::kNoHint;
  if (options.begin == "measuring") viewer.output.act(window::Action::measure_person);
  if (options.begin == "class") viewer.request(viewer::ShowClass{});
  if (!options.replay.empty()) viewer.request(viewer::OpenFile{options.replay});
  viewer.beside_at_first = options.beside;
}

/// The window was closed while its body was built: perhaps for another program of the start page.
void followStartPage(const Opening& opening, const RunOptions& options) {
  if (endingSignal() != 0 || opening.requests.empty()) return;
  if (const auto* way = std::get_if<viewer::GiveWay>(&opening.requests.back())) becomeActivity(way->activity, options);
}

void runWindow(const RunOptions& options) {
  const auto started = Clock::now();
  const viewer::StateReading state = readRememberedState(options);
  const std::string remembered_language = state.remembered ? state.remembered->state.language : std::string();
  useLanguage(options.language.empty() ? remembered_language : options.language);
  Playback playback(options.play);
  checkReplays(options);
  HeadSource heads;
  openHeadSource(options.head_tracker, heads);
  viewer::OpenedScene opened = sceneToRun(options);
  // The body is built while the window opens; without a display there is nothing to build it for.
  engine::WorldBuilder building({}, false);  // without contacts yet
  if (window::displayOffered()) building.request({.scene = opened.scene, .body = nullptr, .read = {}});
  window::Window window(windowFor(options, state));
  const FinishesInOrder in_order;
  viewer::ViewerSettings settings = viewerSettings(options, state);
  settings.document = std::move(opened.document);
  viewer::ViewState view_state = viewState(options, state);
  std::optional<viewer::Activity> wanted;
  viewer::ViewerHost host = makeViewerHost(window);
  host.class_program = familyProgram("class");
  OtherPrograms others({.measuring = !settings.modes.empty(), .classes = !host.class_program.empty()});
  host.activities = [&others] { return others.now(); };
  host.give_way = [&wanted](viewer::Activity activity) { wanted = activity; };
  const viewer::OpeningView::Offers offers{.page = wantsStartPage(options, view_state), .activities = host.activities};
  ControlLines controls;
  bool page_told = false;
  const auto tell_page = [&] {
    if (!std::exchange(page_told, true)) print(fmt::format("start page after {:.3f} s\n", secondsSince(started)));
  };
  const Opening opening = showOpening(window, building, view_state, offers, [&] {
    if (!options.verbose) return;
    tell_page();
    controls.print(window.contentScale() * view_state.text_size);
  });
  if (!opening.world) return followStartPage(opening, options);
  if (!options.devices.empty()) settings.devices = openedFor(*opening.world, options.devices);
  viewer::Viewer viewer(opening.world, std::move(view_state), std::move(settings), std::move(host));
  beginWith(opening, options, viewer.state());
  if (!state.note.empty()) viewer.state().report(viewer::Severity::warning, state.note);
  const StoppedBySignal stopped(viewer.emergencyStop());
  showFrames(window, viewer, playback, options.frames, [&](std::uint64_t frame, double now_s) {
    followHead(heads, viewer, now_s);
    if (!options.verbose) return;
    if (opening.page) tell_page();  // if the body was ready before the window
    if (frame == 1) print(fmt::format("first frame after {:.3f} s\n", secondsSince(started)));
    logFrame(frame, now_s, viewer);
    controls.print(window.contentScale() * viewer.state().state.text_size);
  });
  saveBackup(viewer);
  saveState(options, viewer, window);
  finishViewer(options, viewer);
  if (wanted) becomeActivity(*wanted, options);
}

}  // namespace

void offerRunMode(OfferedMode mode) {
  if (std::ranges::find(offeredModes(), mode) == offeredModes().end()) offeredModes().push_back(mode);
}

void addRunCommand(Command& app) {
  Command* command = app.add_subcommand("run", "Open a window and touch a body with the mouse");
  command->group("Touch");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("SCENE", options->scene, "Scene (TOML) or mesh file (default: the built-in trunk)");
  addPresetOption(*command, options->preset);
  restrictTo({"measuring", "class"}, command->add_option("--begin", options->begin, "Mode to open first"));
  command->footer(
      "Examples:\n  palpate run --preset vhb                 The dissertation's Virtual Haptic Back\n  palpate run     "
      "                         The built-in trunk in layered tissue\n  palpate run my_scan.stl                  Any "
      "mesh\n  palpate run scene.toml --device mouse    A scene file, with a device for the left finger");
  addUnit(*command, options->unit_mm);
  command->add_option("--group", options->group, "Use only this group or object of an OBJ file");
  command->add_option("--play", options->play,
                      "Play an input script (docs/reference/viewer.md): time_s, event, values");
  command->add_option("--replay", options->replay,
                      "Play a recording, or repeat the presses of a table of forces (CSV), tick by tick if wanted");
  command->add_option("--beside", options->beside, "Play this recording next to that of --replay");
  for (const OfferedMode& add : offeredModes()) options->modes.push_back(add(*command));
  restrictTo(wordList<view::StereoMode>(),
             command->add_option(
                 "--stereo", options->stereo,
                 "Stereo mode in place of the remembered one; quad-buffer requests a window for shutter glasses"));
  command
      ->add_option("--head-tracker", options->head_tracker,
                   "Track the head with opentrack (\"UDP over network\", default port 4242) or with a headset "
                   "(openxr): the screen becomes a window onto a life-size body (docs/reference/viewer.md)")
      ->type_name("[ADDRESS:]PORT|openxr");
  addDeviceOption(*command, options->devices,
                  "Device for the left finger, in place of the mouse; repeat for the right one");
  addUnsafeStiffness(*command, options->unsafe_stiffness);
  addNumber(*command, "--frames", options->frames, between(1, 1e12), "Close after this number of frames");
  addLanguage(*command, options->language);
  command->add_option("-o,--out", options->out, "Folder for saved pictures and tables")->capture_default_str();
  addNumber(*command, "--width", options->width, between(320, 16384, "pixels"),
            "Width of the window, in place of the remembered one");
  addNumber(*command, "--height", options->height, between(240, 16384, "pixels"), "Height of the window");
  command->add_flag("--full-screen", options->full_screen, "Fill the screen");
  command->add_flag("--no-intro", options->no_intro, "Skip the start page, hints and instructions");
  command->add_flag("--no-shortcuts", options->no_shortcuts, "Disable all keys except F1 and Esc");
  command->add_flag("--no-state", options->no_state, "Do not read or write settings remembered between runs");
  command->add_flag("--no-session", options->no_recording, "Do not record the last hour automatically");
  command->add_option("--sessions", options->recordings,
                      "Folder for recordings of the last hour (default: the user's own; none with --no-state)");
  command->add_flag("--verbose", options->verbose,
                    "Print a line per frame, the positions of the controls, and the servo report at the end");
  command->add_flag("--keys", options->keys, "Print the table of keys (Markdown) and exit");
  command->callback([=] {
    if (options->keys) {
      fmt::print("{}", window::keysAsMarkdown());
    } else {
      runWindow(*options);
    }
  });
}

}  // namespace palpate::app
