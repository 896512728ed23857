// Every panel, the plots, the pages and the notices against pictures that a person has looked at (image_compare.h).
// What they show is made up, so that no clock and no thread has a say in it.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>

#include "palpate/base/text.h"
#include "palpate/view/offscreen.h"
#include "view/tests/viewer/gui_picture.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/preview_pane.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {
namespace {

constexpr double kTicksPerS = 1000.0;
constexpr float kPanelWidth = 300.0f;
constexpr double kDeviceLimitN = 3.3;

/// One press of a finger that is pulled sideways on its way, as the servo would tell it.
void addPress(SampleHistory& history, double from_s, double most_mm) {
  constexpr int kTicks = 2500;
  for (int i = 0; i < kTicks; ++i) {
    const double share = static_cast<double>(i) / kTicks;
    trace::Sample sample;
    sample.tick = static_cast<std::uint64_t>(from_s * kTicksPerS) + static_cast<std::uint64_t>(i);
    sample.contact.depth_mm = most_mm * std::sin(std::numbers::pi * share);
    sample.contact.tip = Vec3(60.0 * share * share, 0.0, -sample.contact.depth_mm);
    sample.contact.hold = sample.contact.tip;
    sample.contact.normal = Vec3::UnitZ();
    sample.contact.force = sample.contact.depth_mm * Vec3(-0.2 * share, 0.0, 0.5);
    sample.contact.touch = share > 0.6 && share < 0.8 ? contact::Touch::slip : contact::Touch::stick;
    history.add(sample, kDeviceLimitN);
  }
}

Performance somePerformance() {
  Performance p;
  p.servo = {123456, 7, 2, 0, {}, {}, 1000.0};
  p.servo.compute.p50_us = 4.1;
  p.servo.compute.p99_us = 9.7;
  p.servo.lateness.p50_us = 12.5;
  p.servo.lateness.p99_us = 80.3;
  p.servo.lateness.max_us = 412.0;
  p.deform_ms = 0.84;
  p.upload_ms = 0.21;
  p.draw_ms = 5.35;
  p.frame_ms = 7.02;
  p.frames_per_s = 60.0;
  p.graphics = "a renderer with a rather long name (and its version, 256 bits)";
  return p;
}

std::vector<maps::Dysfunction> someDysfunctions() {
  std::vector<maps::Dysfunction> items(2);
  items[0].x_mm = -32.0;
  items[0].y_mm = 41.0;
  items[0].change_percent = 50.0;
  items[1].x_mm = 45.0;
  items[1].y_mm = -110.0;
  items[1].change_percent = -25.0;
  return items;
}

class PanelPictures : public testing::Test {
 protected:
  /// In a window as the side panel is.
  void expectPanel(const std::string& name, int height, const std::function<void()>& panel) {
    expect("panel_" + name, static_cast<int>(kPanelWidth), height, [&] {
      ImGui::SetNextWindowPos({0.0f, 0.0f});
      ImGui::SetNextWindowSize({kPanelWidth, static_cast<float>(height)});
      if (ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration)) panel();
      ImGui::End();
    });
  }

  /// Width and height in points; over the grey that stands for the body.
  void expect(const std::string& name, int width, int height, const std::function<void()>& draw) {
    gui_.setTheme(theme);
    expectGuiPicture(gui_, name, Vec2(width, height), pixels_per_point, draw);
  }

  void pressTwice() {
    addPress(plots.fingers[0], 1.0, 7.0);
    addPress(plots.fingers[0], 5.0, 9.0);
    addPress(plots.fingers[1], 6.0, 4.0);
  }

  void expectPlots(const std::string& name, std::optional<double> frozen_at_s = {}, int width = 700) {
    const std::array<bool, 2> present = {true, true};
    double now_s = 1000.0;
    expect(name, width, 162, [&] {
      now_s += 10.0;  // an axis shrinks after some seconds: to this test's own, whatever was drawn before
      plotStrips({plots, present, kDeviceLimitN, now_s, frozen_at_s}, {0.0f, 0.0f, float(width), 12.0f}, output);
    });
  }

  void saySomething() {
    messages.add(Severity::info, "Saved stage.toml", 2.0);
    messages.add(Severity::warning, "The clipboard holds no view", 14.5);
    messages.add(Severity::error,
                 "cannot open broken.obj: line 2: 'this' is not an element of an OBJ file; the body stays as it was",
                 21.25);
  }

  scene::Scene scene;
  WorldFacts world{.name = "torso",
                   .triangles = 20389,
                   .vertices = 10199,
                   .width_mm = 352.0,
                   .height_mm = 512.0,
                   .depth_mm = 214.0,
                   .closed = true,
                   .has_bones = true,
                   .softest_n_per_mm = 0.30,
                   .stiffest_n_per_mm = 1.20,
                   .notes = {}};
  Plots plots{{SampleHistory(kTicksPerS), SampleHistory(kTicksPerS)}};
  Messages messages;
  UiOutput output;
  window::Theme theme = window::Theme::dark;
  double pixels_per_point = 1.0;

 private:
  const view::OffscreenContext context_;
  window::Gui gui_;
};

TEST_F(PanelPictures, OfTouch) {
  TouchSettings touch;
  std::size_t active = 0;
  expectPanel("touch", 310, [&] { touchPanel({touch, active, scene}, output); });
}

TEST_F(PanelPictures, OfTouchByForce) {
  TouchSettings touch;
  touch.by = device::PressBy::force;
  std::size_t active = 1;
  expectPanel("touch_force", 160, [&] { touchPanel({touch, active, scene}, output); });
}

/// A device that is felt on the left finger, and the mouse on the right.
DevicesShown someDevices() {
  DevicesShown devices;
  devices.stiffness_factor = 0.83;
  FingerHeld& left = devices.fingers[0];
  left.words = "openhaptics:Left";
  left.about = "openhaptics, PHANTOM Omni, at most 3.30 N";
  left.workspace.frame.origin_mm = Vec3(-30, 41, 120);
  left.reading.tip = Vec3(-28.0, 37.0, 92.0);
  left.known_place = left.reading.place = Vec3(2.0, -4.0, -28.0);
  left.reading.force = Vec3(0.2, 0.0, 1.61);
  left.reading.state.loop_ticks = 2;
  left.reading.state.buttons = 2;
  left.positions_per_s = 998.0;
  left.most_loss_n_mm = 0.004;
  devices.back_ends = {{.name = "openhaptics", .available = true, .devices = {"in use here"}},
                       {.name = "forcedimension",
                        .reason = "libdhd.so: cannot open shared object file",
                        .remedy = "install the maker's SDK, or name the file by PALPATE_LIBDHD"},
                       {.name = "remote", .available = true, .devices = {"127.0.0.1:4117"}}};
  return devices;
}

TEST_F(PanelPictures, OfDevices) {
  DevicesShown devices = someDevices();
  const std::optional<VertexReading> reading;
  bool reach = true;
  expectPanel("devices", 640, [&] { devicePanel({devices, scene, reading, reach, 1000.0}, output); });
}

TEST_F(PanelPictures, OfACalibrationAfterTheStop) {
  DevicesShown devices = someDevices();
  devices.stopped = true;
  devices.calibration.finger = 0;
  devices.calibration.of_device = devices.calibration.of_body = {Vec3::Zero()};
  std::optional<VertexReading> reading;
  reading.emplace().place = Vec3(12, 140, 55);
  bool reach = true;
  expectPanel("devices_calibrated", 640, [&] { devicePanel({devices, scene, reading, reach, 1000.0}, output); });
}

TEST_F(PanelPictures, OfTheEmergencyStop) {
  const FreeArea free{0.0f, 24.0f, 640.0f, 320.0f};
  ViewState state;
  int hint = 0;
  MenuBar menu{state, hint, {}, 0, {"torso", "openhaptics", "1000 Hz", "60 fps"}, {}};
  menu.offers_stop = true;
  const std::vector<std::string> lines = {"left: held back 812, damped 3"};
  expect("stop_offered", 640, 320, [&] {
    menuBar(menu, output);
    interventionNotice(lines, free);
  });
  menu.stopped = true;
  expect("stop", 640, 320, [&] {
    menuBar(menu, output);
    stopBanner(free, output);
    interventionNotice(lines, free);
  });
}

TEST_F(PanelPictures, OfTissue) {
  ProfileEdit profile;
  expectPanel("tissue", 595, [&] { tissuePanel({scene, profile, true}, output); });
}

TEST_F(PanelPictures, OfTheProfileEditor) {
  tissue::ProfileSettings of_scene;
  of_scene.kind = tissue::ProfileKind::user;
  ProfileEdit profile{{{0.0, 1.0}, {0.3, 0.85}, {0.5, 0.3}, {0.75, -0.2}, {1.0, 0.0}}};
  expectPanel("profile", 160, [&] { profileCurve(of_scene, profile, output); });
}

TEST_F(PanelPictures, OfDysfunctions) {
  std::vector<maps::Dysfunction> items = someDysfunctions();
  Editor editor{.active = true, .selected = 1};
  expectPanel("dysfunctions", 235, [&] { dysfunctionPanel({.edit = {items, editor, output}}); });
}

TEST_F(PanelPictures, OfLumps) {
  std::vector<scene::LumpSettings> items(2);
  items[0].name = "node";
  items[0].at = "T9 right 30 mm";
  items[1].name = "cyst";
  items[1].x_mm = -45.0;
  items[1].y_mm = -110.0;
  items[1].stiffness_ratio = 0.4;
  LumpEditor editor{.active = false, .selected = 0};
  expectPanel("lumps", 345, [&] { lumpPanel({.edit = {items, editor, output}}); });
}

TEST_F(PanelPictures, OfTheModel) {
  world.tissue = "half-Gaussian tissue, force F = k d";
  world.notes = {"no layers because of fidelity.E15 = \"literal\"", "2 holes of the skin were closed"};
  bool dialog = false;
  expectPanel("model", 560, [&] { modelPanel({scene, world, dialog}, output); });
}

TEST_F(PanelPictures, OfTheModelOfAMeshFile) {
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = "scan.ply";
  world = {"scan.ply", 81664, 40834, 310.0, 455.0, 180.0, false, false, 0.50, 0.50, {}};
  world.notes = {"3 triangles without an area were left out", "it has a border: fingers slide off there"};
  bool dialog = false;
  expectPanel("model_mesh", 500, [&] { modelPanel({scene, world, dialog}, output); });
}

TEST_F(PanelPictures, OfWhatIsShown) {
  view::Look look;
  look.colouring = view::Colouring::stiffness;
  look.show(view::Overlay::rings, true);
  bool adapts = true;
  bool simpler = true;
  expectPanel("show", 545, [&] { showPanel({look, adapts, simpler, false, world}); });
}

TEST_F(PanelPictures, OfASkinThatIsDrawnSmoothForNow) {
  view::Look look;
  bool adapts = true;
  bool simpler = true;
  expectPanel("show_slow", 200, [&] { showPanel({look, adapts, simpler, true, world}); });
}

class StereoPanelPictures : public PanelPictures {
 protected:
  StereoPanelPictures() { camera.distance_mm = 600.0; }
  void expectStereo(const std::string& name, int height) {
    expectPanel(name, height, [&] { stereoPanel({stereo, head, seen, camera, world}); });
  }

  view::StereoSettings stereo;
  HeadSettings head;
  SeenHead seen;
  view::Camera camera;
};

TEST_F(StereoPanelPictures, OfATrackedHead) {
  stereo.mode = view::StereoMode::interlaced;
  head.on = true;
  head.offset_mm = {0.0, 170.0, -10.0};
  seen.eyes_mm = {112.0, 38.0, 547.0};
  seen.state = window::HeadTracker::State::standing_still;
  expectStereo("stereo_head", 470);
}

TEST_F(StereoPanelPictures, OfStereo) {
  stereo.mode = view::StereoMode::anaglyph_dubois;
  expectStereo("stereo", 215);
}

TEST_F(PanelPictures, OfARecording) {
  Recording recording{true, "forces.csv", 2.0, true, "pictures", 37};
  recording.viewer = true;
  recording.length_s = 754.3;
  bool keeps_last_hour = true;
  expectPanel("record", 345, [&] { recordPanel(recording, keeps_last_hour, 14.2, output); });
}

TEST_F(PanelPictures, OfPerformance) {
  const Performance performance = somePerformance();
  expectPanel("performance", 370, [&] { performancePanel(performance); });
}

TEST_F(PanelPictures, OfTheReplayBar) {
  const FreeArea free{0.0f, 0.0f, 500.0f, 90.0f};
  Replay replay{.at_s = 6.4, .to_s = 9.1};
  expect("replay", 500, 90, [&] { replayBar(replay, free, output); });
  replay = {.at_s = 3.2, .to_s = 9.1, .playing = true, .table = "somewhere/run.session", .loops = true};
  replay.marks = {{1.0, "start"}, {3.1, "T6 right"}, {8.8, "end"}};
  const FreeArea higher{0.0f, 0.0f, 500.0f, 120.0f};
  expect("replay_table", 500, 120, [&] { replayBar(replay, higher, output); });
}

TEST_F(PanelPictures, OfPlotsAtAFrozenMoment) {
  pressTwice();
  expectPlots("plots_frozen", 6.4);
}

TEST_F(PanelPictures, OfTheOpenDialog) {
  const std::filesystem::path folder = "/tmp/palpate-pictures";
  std::filesystem::create_directories(folder / "people");
  for (const char* name : {"back.toml", "scan.ply", "forces.csv", "notes.txt"}) writeFile(folder / name, "");
  const std::vector<std::string> recent = {"/home/somebody/back.toml", "/home/somebody/scans/torso.obj"};
  showFolder(folder);
  bool open = true;
  PreviewPane preview;
  expect("open", 600, 420, [&] { openDialog(recent, open, preview, output); });
  std::filesystem::remove_all(folder);
}

TEST_F(PanelPictures, OfTheEditorsFrame) {
  expect("editing", 640, 160, [&] { editingFrame({0.0f, 0.0f, 640.0f, 160.0f}); });
}

TEST_F(PanelPictures, OfThePlots) {
  pressTwice();
  expectPlots("plots");
}

TEST_F(PanelPictures, OfThePlotsOfANarrowWindow) {
  pressTwice();
  expectPlots("plots_narrow", 6.4, 500);
}

TEST_F(PanelPictures, OfTheMenuWhileRecordingInANarrowWindow) {
  ViewState state;
  int hint = 0;
  const std::vector<std::string> status = {"torso, 20389 triangles with bones", "drawn smooth: slow", "mouse",
                                           "1000 Hz", "20 fps"};
  expect("menu_recording", 500, 40, [&] { menuBar({state, hint, {}, 0, status, "recording 1:05"}, output); });
}

TEST_F(PanelPictures, OfTheHelpPage) {
  pixels_per_point = 0.75;  // it is large
  bool open = true;
  expect("help", 1140, 800, [&] { helpPage(open); });
  pixels_per_point = 1.0;
  expect("help_narrow", 500, 400, [&] { helpPage(open); });
}

TEST_F(PanelPictures, OfTheMessageList) {
  saySomething();
  bool open = true;
  expect("messages", 580, 160, [&] { messageList(messages, open); });
}

TEST_F(PanelPictures, OfTheNotices) {
  const FreeArea free{0.0f, 0.0f, 480.0f, 220.0f};
  messages.add(Severity::error, "cannot open broken.obj: line 2: 'this' is not an element of an OBJ file", 0.0);
  const engine::BuildProgress building{"sorting the triangles", 0.4, 1.0};
  expect("notices", 480, 220, [&] {
    toast(messages, 0.0, free);
    buildProgress(building, free, output);
    hint(hintText(0), free);
  });
}

TEST_F(PanelPictures, OfTheMenu) {
  ViewState state;
  int hint = 0;
  expect("menu", 480, 40, [&] { menuBar({state, hint, {}, 0, {"torso", "mouse", "1000 Hz", "60 fps"}, {}}, output); });
}

TEST_F(PanelPictures, OfTheLightTheme) {
  theme = window::Theme::light;
  pressTwice();
  saySomething();
  TouchSettings touch;
  std::size_t active = 0;
  expectPanel("touch_light", 160, [&] { touchPanel({touch, active, scene}, output); });
  expectPlots("plots_light");
  bool open = true;
  expect("messages_light", 580, 160, [&] { messageList(messages, open); });
}

TEST_F(PanelPictures, OfTheThemeOfHighContrast) {
  theme = window::Theme::contrast;
  TouchSettings touch;
  std::size_t active = 0;
  expectPanel("touch_contrast", 160, [&] { touchPanel({touch, active, scene}, output); });
}

}  // namespace
}  // namespace palpate::viewer
