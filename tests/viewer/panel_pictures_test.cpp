// Every panel, the plots, the pages and the notices against pictures that a person has looked at (image_compare.h).
// What they show is made up, so that no clock and no thread has a say in it.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "apps/viewer/panels/open_dialog.h"
#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"
#include "palpate/base/text.h"
#include "palpate/view/offscreen.h"
#include "pictures/image_compare.h"

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

Session someSession() {
  Session session;
  session.world = {"torso", 20389, 10199, 352.0, 512.0, 214.0, true, true, 0.30, 1.20, {}};
  session.performance.servo = {123456, 7, 2, 0, {}, {}, 1000.0};
  session.performance.servo.compute.p50_us = 4.1;
  session.performance.servo.compute.p99_us = 9.7;
  session.performance.servo.lateness.p50_us = 12.5;
  session.performance.servo.lateness.p99_us = 80.3;
  session.performance.servo.lateness.max_us = 412.0;
  session.performance.deform_ms = 0.84;
  session.performance.upload_ms = 0.21;
  session.performance.draw_ms = 5.35;
  session.performance.frame_ms = 7.02;
  session.performance.frames_per_s = 60.0;
  session.performance.graphics = "a renderer with a rather long name (and its version, 256 bits)";
  for (SampleHistory& plot : session.plots) plot = SampleHistory(kTicksPerS);
  session.finger_present = {true, true};
  session.camera.distance_mm = 600.0;
  return session;
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
  void expectPanel(const std::string& name, int height, PanelFunction panel) {
    expect("panel_" + name, static_cast<int>(kPanelWidth), height, [&] {
      ImGui::SetNextWindowPos({0.0f, 0.0f});
      ImGui::SetNextWindowSize({kPanelWidth, static_cast<float>(height)});
      if (ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration)) panel(session);
      ImGui::End();
    });
  }

  /// Width and height in points; over the grey that stands for the body.
  void expect(const std::string& name, int width, int height, const std::function<void()>& draw) {
    gui_.setTheme(session.state.theme);
    const view::Target target(static_cast<int>(width * pixels_per_point), static_cast<int>(height * pixels_per_point));
    for (int frame = 0; frame < kFramesToSettle; ++frame) {
      gui_.begin(Vec2(width, height), pixels_per_point, 1.0 / 60.0, {});
      widgetPlaces().clear();
      draw();
      gui_.end();
    }
    target.bind();
    glClearColor(0.35f, 0.35f, 0.35f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.present(target.width(), target.height());
    support::Tolerance tolerance;
    tolerance.bad_in_block = kLetter;
    support::expectPicture(name, target.read(), view::rendererName(), tolerance);
  }

  void pressTwice() {
    addPress(session.plots[0], 1.0, 7.0);
    addPress(session.plots[0], 5.0, 9.0);
    addPress(session.plots[1], 6.0, 4.0);
  }

  void expectPlots(const std::string& name) {
    session.now_s = 1000.0;
    expect(name, 700, 162, [&] {
      session.now_s += 10.0;  // an axis shrinks after some seconds: to this test's own, whatever was drawn before
      plotStrips(session, {0.0f, 0.0f, 700.0f, 12.0f});
    });
  }

  void saySomething() {
    session.messages.add(Severity::info, "Saved stage.toml", 2.0);
    session.messages.add(Severity::warning, "The clipboard holds no view", 14.5);
    session.messages.add(
        Severity::error,
        "cannot open broken.obj: line 2: 'this' is no element of an OBJ file; the body stays as it was", 21.25);
  }

  static constexpr int kFramesToSettle = 3;  // windows that fit their contents know them after a frame
  static constexpr double kLetter = 0.03;    ///< of a block: what a lost letter leaves, also in a large picture
  Session session = someSession();
  double pixels_per_point = 1.0;

 private:
  const view::OffscreenContext context_;
  window::Gui gui_;
};

TEST_F(PanelPictures, OfTouch) { expectPanel("touch", 310, touchPanel); }

TEST_F(PanelPictures, OfTouchByForce) {
  session.state.touch.by = device::PressBy::force;
  session.active_finger = 1;
  expectPanel("touch_force", 160, touchPanel);
}

TEST_F(PanelPictures, OfTissue) { expectPanel("tissue", 595, tissuePanel); }

TEST_F(PanelPictures, OfTheProfileEditor) {
  session.scene.deformation.forms.normal_profile.kind = tissue::ProfileKind::user;
  session.profile_knots = {{0.0, 1.0}, {0.3, 0.85}, {0.5, 0.3}, {0.75, -0.2}, {1.0, 0.0}};
  expectPanel("profile", 160, profileCurve);
}

TEST_F(PanelPictures, OfDysfunctions) {
  session.scene.dysfunctions = someDysfunctions();
  session.editor.active = true;
  session.editor.selected = 1;
  expectPanel("dysfunctions", 235, dysfunctionPanel);
}

TEST_F(PanelPictures, OfTheModel) {
  session.world.notes = {"2 holes of the skin were closed"};
  expectPanel("model", 500, modelPanel);
}

TEST_F(PanelPictures, OfTheModelOfAMeshFile) {
  session.scene.body.kind = scene::BodyKind::mesh;
  session.scene.body.file = "scan.ply";
  session.world = {"scan.ply", 81664, 40834, 310.0, 455.0, 180.0, false, false, 0.50, 0.50, {}};
  session.world.notes = {"3 triangles without an area were left out", "it has a border: fingers slide off there"};
  expectPanel("model_mesh", 500, modelPanel);
}

TEST_F(PanelPictures, OfWhatIsShown) {
  session.state.look.colouring = view::Colouring::stiffness;
  session.state.look.show(view::Overlay::rings, true);
  expectPanel("show", 545, showPanel);
}

TEST_F(PanelPictures, OfASkinThatIsDrawnSmoothForNow) {
  session.simple_shading = true;
  expectPanel("show_slow", 200, showPanel);
}

TEST_F(PanelPictures, OfATrackedHead) {
  session.state.stereo.mode = view::StereoMode::interlaced;
  session.state.head.on = true;
  session.state.head.offset_mm = {0.0, 170.0, -10.0};
  session.eyes_mm = {112.0, 38.0, 547.0};
  session.head = window::HeadTracker::State::standing_still;
  session.camera.distance_mm = 600.0;
  expectPanel("stereo_head", 470, stereoPanel);
}

TEST_F(PanelPictures, OfStereo) {
  session.state.stereo.mode = view::StereoMode::anaglyph_dubois;
  expectPanel("stereo", 215, stereoPanel);
}

TEST_F(PanelPictures, OfARecording) {
  session.now_s = 14.2;
  session.recording = {true, "forces.csv", 2.0, true, "pictures", 37};
  expectPanel("record", 185, recordPanel);
}

TEST_F(PanelPictures, OfPerformance) { expectPanel("performance", 370, performancePanel); }

TEST_F(PanelPictures, OfTheReplayBar) {
  session.frozen = true;
  session.replay = {6.4, 0.0, 9.1, false, {}};
  expect("replay", 500, 90, [&] { replayBar(session, {0.0f, 0.0f, 500.0f, 90.0f}); });
  session.replay = {3.2, 0.0, 9.1, true, "somewhere/forces.csv"};
  expect("replay_table", 500, 90, [&] { replayBar(session, {0.0f, 0.0f, 500.0f, 90.0f}); });
}

TEST_F(PanelPictures, OfPlotsAtAFrozenMoment) {
  pressTwice();
  session.frozen = true;
  session.replay.at_s = 6.4;
  expectPlots("plots_frozen");
}

TEST_F(PanelPictures, OfTheOpenDialog) {
  const std::filesystem::path folder = "/tmp/palpate-pictures";
  std::filesystem::create_directories(folder / "people");
  for (const char* name : {"back.toml", "scan.ply", "forces.csv", "notes.txt"}) writeFile(folder / name, "");
  session.state.recent = {"/home/somebody/back.toml", "/home/somebody/scans/torso.obj"};
  showFolder(folder);
  expect("open", 600, 420, [&] { openDialog(session); });
  std::filesystem::remove_all(folder);
}

TEST_F(PanelPictures, OfTheEditorsFrame) {
  const FreeArea free{0.0f, 0.0f, 640.0f, 160.0f};
  expect("editing", 640, 160, [&] { editingFrame(session, free); });
}

TEST_F(PanelPictures, OfThePlots) {
  pressTwice();
  expectPlots("plots");
}

TEST_F(PanelPictures, OfTheHelpPage) {
  pixels_per_point = 0.75;  // it is large
  expect("help", 1140, 800, [&] { helpPage(session); });
}

TEST_F(PanelPictures, OfTheMessageList) {
  saySomething();
  expect("messages", 580, 160, [&] { messageList(session); });
}

TEST_F(PanelPictures, OfTheNotices) {
  const FreeArea free{0.0f, 0.0f, 480.0f, 220.0f};
  session.messages.add(Severity::error, "cannot open broken.obj: line 2: 'this' is no element of an OBJ file", 0.0);
  session.building = engine::BuildProgress{"sorting the triangles", 0.4, 1.0};
  expect("notices", 480, 220, [&] {
    toast(session, free);
    buildProgress(session, free);
    hint(session, free);
  });
}

TEST_F(PanelPictures, OfTheMenu) {
  expect("menu", 480, 40, [&] { menuBar(session); });
}

TEST_F(PanelPictures, OfTheLightTheme) {
  session.state.theme = window::Theme::light;
  pressTwice();
  saySomething();
  expectPanel("touch_light", 160, touchPanel);
  expectPlots("plots_light");
  expect("messages_light", 580, 160, [&] { messageList(session); });
}

TEST_F(PanelPictures, OfTheThemeOfHighContrast) {
  session.state.theme = window::Theme::contrast;
  expectPanel("touch_contrast", 160, touchPanel);
}

}  // namespace
}  // namespace palpate::viewer
