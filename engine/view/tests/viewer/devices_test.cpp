// Devices in the window, as a user meets them: found, opened, felt, lost and back, stopped, placed, calibrated, let go.
// What is opened is the double of a maker's library (engine/host/tests/device/doubles), through the same code as a real
// one.
#include "stage.h"

#include <cstdlib>
#include <set>
#include <utility>

#include "host/tests/device/doubles/double_library.h"
#include "support/wait_for.h"
#include "view/viewer/state/devices_shown.h"
#include "view/viewer/state/scene_document.h"

namespace palpate::viewer {
namespace {

/// A window, and two devices of which the double's clock turns the loop.
class HeldStage {
 public:
  HeldStage() : control(doubles::controlOf("openhaptics")) {
    doubles::reset(control);
    control.by_hand = false;
    ::setenv("PALPATE_LIBHD", doubles::libraryOf("openhaptics").c_str(), 1);
    stage.state().scene.devices.push_back({.name = "openhaptics", .origin_mm = Vec3(100, 100, 30)});
  }
  HeldStage(const HeldStage&) = delete;
  HeldStage& operator=(const HeldStage&) = delete;
  ~HeldStage() {
    stage.viewer.reset();
    ::unsetenv("PALPATE_LIBHD");
  }

  /// By the panel: looked for, chosen, opened.
  void open(std::size_t finger = 0) {
    stage.click("panel/Touch");
    stage.click("panel/Devices");
    ASSERT_TRUE(stage.until([&] { return !devices().back_ends.empty() && !devices().looking; }));
    choose(finger, "openhaptics");
    stage.click(finger == 0 ? "devices/left/open" : "devices/right/open");
    ASSERT_TRUE(stage.until([&] { return !devices().fingers[finger].words.empty(); })) << stage.lastMessage();
  }
  void choose(std::size_t finger, const std::string& name) {
    for (std::size_t i = 0; i < devices().back_ends.size(); ++i) {
      if (devices().back_ends[i].name == name) devices().fingers[finger].back_end = i;
    }
    stage.frame();
  }
  /// The double's own mm; by steps that no guard takes for a jump.
  void moveTo(const Vec3& place, std::size_t i = 0) {
    Vec3 at(control.devices[i].place[0], control.devices[i].place[1], control.devices[i].place[2]);
    while ((place - at).norm() > 0.0) {
      const Vec3 way = place - at;
      at = way.norm() < 4.0 ? place : Vec3(at + 4.0 * way.normalized());
      for (std::size_t axis = 0; axis < 3; ++axis) control.devices[i].place[axis] = at[static_cast<long>(axis)];
      const std::uint64_t seen = devices().fingers[i].reading.fresh;
      ASSERT_TRUE(stage.until([&] { return devices().fingers[i].reading.fresh > seen + 4; }));
    }
  }
  double force(std::size_t i = 0) const {
    const auto& f = control.devices[i].force;
    return Vec3(f[0], f[1], f[2]).norm();
  }
  /// From outside, into the sheet. On a busy machine the double's clock is late at times, which is a fault: then again.
  void press() {
    for (int attempt = 0; attempt < 20 && !(force() > 0.3); ++attempt) {
      moveTo({0, 0, 0});
      moveTo({0, 0, -27});
      for (int i = 0; i < 10 && !(force() > 0.3); ++i) stage.frame();
    }
    ASSERT_GT(force(), 0.3) << "tip " << devices().fingers[0].reading.tip.transpose() << ", depth "
                            << stage.finger(0).depth_mm << ", "
                            << devices().fingers[0].interventions.recent(stage.now_s) << "; " << stage.lastMessage();
  }

  /// Where the finger is once all that was done to the double has arrived.
  Vec3 settledTip(std::size_t i = 0) {
    Vec3 tip = devices().fingers[i].reading.tip;
    for (int look = 0; look < 50; ++look) {
      const std::uint64_t seen = devices().fingers[i].reading.fresh;
      EXPECT_TRUE(stage.until([&] { return devices().fingers[i].reading.fresh > seen + 20; }));
      const Vec3 before = std::exchange(tip, devices().fingers[i].reading.tip);
      if (before == tip) break;
    }
    return tip;
  }

  DevicesShown& devices() { return stage.state().devices; }

  Stage stage;
  doubles::DoubleControl& control;
};

TEST(Devices, OfThePanelAreListedWithWhyAndRemedy) {
  HeldStage held;
  held.stage.click("panel/Touch");
  held.stage.click("panel/Devices");
  ASSERT_TRUE(held.stage.until([&] { return !held.devices().looking; }));
  std::set<std::string> missing;
  for (const BackEndFound& back_end : held.devices().back_ends) {
    if (back_end.available) continue;
    missing.insert(back_end.name);
    EXPECT_FALSE(back_end.reason.empty()) << back_end.name;
    EXPECT_FALSE(back_end.remedy.empty()) << back_end.name;
  }
  EXPECT_TRUE(missing.contains("forcedimension"));
  EXPECT_FALSE(missing.contains("openhaptics"));
}

TEST(Devices, OneIsOpenedFeltAndLetGoWhileTheMouseKeepsTheOtherFinger) {
  HeldStage held;
  held.open();
  Stage& stage = held.stage;
  EXPECT_NE(stage.state().held_by.find("openhaptics"), std::string::npos) << stage.state().held_by;
  EXPECT_EQ(stage.state().active_finger, 1u) << "the mouse takes the finger that is left";
  held.press();
  EXPECT_GT(stage.finger(0).depth_mm, 1.0);
  EXPECT_TRUE(stage.until([&] { return held.devices().fingers[0].positions_per_s > 200.0; }));
  stage.move(stage.middle() + Vec2(60, 0));
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger(1).depth_mm > 4.0; }));
  EXPECT_GT(stage.finger(0).depth_mm, 1.0) << "both at once";
  stage.button(false);
  stage.click("devices/left/close");
  EXPECT_TRUE(stage.until([&] { return !held.control.devices[0].open && held.force() == 0.0; }));
  EXPECT_EQ(stage.state().held_by, "mouse");
  stage.key(window::key('1'));
  stage.move(stage.middle());
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger(0).depth_mm > 4.0; }))
      << "the mouse has it again: " << stage.finger(0).tip.transpose() << ", finger " << stage.state().active_finger;
}

TEST(Devices, OneThatDoesNotOpenSaysWhyAndTheMouseKeepsTheFinger) {
  HeldStage held;
  held.stage.click("panel/Touch");
  held.stage.click("panel/Devices");
  ASSERT_TRUE(held.stage.until([&] { return !held.devices().looking && !held.devices().back_ends.empty(); }));
  held.choose(0, "playback");
  held.devices().fingers[0].which = "no_such_file.csv";
  held.stage.click("devices/left/open");
  const auto says = [&] { return held.stage.lastMessage().find("no_such_file.csv") != std::string::npos; };
  EXPECT_TRUE(held.stage.until(says)) << held.stage.lastMessage();
  EXPECT_EQ(held.stage.state().messages.all().back().severity, Severity::error);
  EXPECT_TRUE(held.devices().fingers[0].words.empty());
}

TEST(Devices, ALostOneSaysSoAndComesBack) {
  HeldStage held;
  held.open();
  held.press();
  held.control.devices[0].connected = false;
  EXPECT_TRUE(held.stage.until([&] { return !held.devices().fingers[0].trouble.empty(); }));
  EXPECT_NE(held.devices().fingers[0].reading.state.faults, 0u);
  EXPECT_FALSE(held.stage.viewer->wantsToQuit());
  held.control.devices[0].connected = true;
  const auto back = [&] { return held.stage.lastMessage().find("has reconnected") != std::string::npos; };
  EXPECT_TRUE(held.stage.until(back)) << held.stage.lastMessage();
  EXPECT_TRUE(held.stage.until([&] { return held.devices().fingers[0].reading.state.faults == 0; }));
  EXPECT_EQ(held.force(), 0.0) << "it is inside: nothing before it has been outside";
  held.moveTo({0, 0, 0});
  held.press();
}

TEST(Devices, TheEmergencyStopLatchesByKeyAndIsReleasedByTheButtonAlone) {
  HeldStage held;
  held.open();
  Stage& stage = held.stage;
  for (const window::Key key : {window::Key::pause, window::Key::space}) {
    held.press();
    stage.key(key);
    EXPECT_TRUE(held.devices().stopped);
    EXPECT_TRUE(stage.until([&] { return held.force() == 0.0; }));
    EXPECT_FALSE(stage.state().replay.frozen) << "Space stops, and does nothing else";
    stage.key(key);
    EXPECT_TRUE(held.devices().stopped) << "pressing again releases nothing";
    ASSERT_TRUE(stage.until([&] { return (held.devices().fingers[0].interventions.counts()[11]) > 0; }));
    EXPECT_EQ(held.force(), 0.0);
    stage.click("stop/release");
    EXPECT_FALSE(held.devices().stopped);
    EXPECT_EQ(held.force(), 0.0) << "still inside";
    held.moveTo({0, 0, 0});
  }
}

TEST(Devices, TheStopIsHeardWhateverElseIsAsked) {
  HeldStage held;
  held.open();
  held.stage.state().ask({.kind = Question::Kind::leave, .words = "Save?"});
  held.stage.frame();
  held.stage.key(window::Key::pause);
  EXPECT_TRUE(held.devices().stopped);
  EXPECT_TRUE(held.stage.state().question) << "and answers no question";
}

TEST(Devices, SpaceFreezesWhereNoDeviceIsHeldAndTheStopIsThereAllTheSame) {
  Stage stage;
  stage.key(window::Key::space);
  EXPECT_TRUE(stage.state().replay.frozen);
  EXPECT_FALSE(stage.state().devices.stopped);
  stage.key(window::Key::pause);
  EXPECT_TRUE(stage.state().devices.stopped);
  stage.click("stop/release");
  EXPECT_FALSE(stage.state().devices.stopped);
}

TEST(Devices, WhatIsDoneToAForceIsSaidWhileItIsDone) {
  HeldStage held;
  held.open();
  held.press();
  held.stage.key(window::Key::pause);
  // The loop must have seen the stop before it is released: on a busy machine a click comes between two ticks.
  ASSERT_TRUE(held.stage.until([&] { return held.force() == 0.0; }));
  held.stage.click("stop/release");
  const auto words = [&] { return held.devices().fingers[0].interventions.recent(held.stage.now_s); };
  // Softening by the press may be said first, and alone.
  EXPECT_TRUE(held.stage.until([&] { return words().find("held back") != std::string::npos; })) << words();
  held.stage.frame();
  EXPECT_TRUE(widgetPlaces().contains("interventions"));
}

TEST(Interventions, AreCountedAndSaidForAWhile) {
  Interventions seen;
  seen.add(servo::kDamped, 1.0);
  seen.add(servo::kDamped | servo::kHeldBack, 1.5);
  seen.add(0, 1.6);
  EXPECT_EQ(seen.counts()[4], 2u);
  EXPECT_NE(seen.recent(1.6).find(" 2"), std::string::npos);
  EXPECT_TRUE(seen.recent(9.0).empty());
}

TEST(Devices, TheClutchKeyLeavesTheFingerWhereItIs) {
  HeldStage held;
  held.open();
  held.press();
  const Vec3 tip = held.settledTip();
  // There is no tip while the double's clock is late, as it is at times on a busy machine.
  const auto is_there = [&] { return (held.devices().fingers[0].reading.tip - tip).norm() < 1e-9; };
  window::InputEvent u{.kind = window::InputEvent::Kind::key, .down = true, .key = window::key('U')};
  held.stage.frame({u});
  ASSERT_TRUE(held.stage.until([&] { return held.devices().fingers[0].reading.state.clutched; }));
  EXPECT_TRUE(held.stage.until([&] { return held.force() == 0.0; }));
  held.moveTo({0, 0, 20});
  EXPECT_TRUE(held.stage.until(is_there));
  EXPECT_GT(held.stage.finger(0).depth_mm, 1.0) << "it is still seen to press";
  u.down = false;
  held.stage.frame({u});
  ASSERT_TRUE(held.stage.until([&] { return !held.devices().fingers[0].reading.state.clutched; }));
  EXPECT_TRUE(held.stage.until(is_there));
  EXPECT_EQ(held.force(), 0.0) << "inside: nothing before it has been outside";
  held.moveTo({0, 0, 50});
  EXPECT_NEAR(held.settledTip().z() - tip.z(), 30.0, 1e-6);
}

TEST(Devices, TheWorkspaceIsPartOfTheSceneSavedAndReadBack) {
  HeldStage held;
  held.stage.state().scene.devices.clear();
  held.open();
  EXPECT_TRUE(held.stage.state().scene.devices.empty()) << "opening changes nothing";
  held.stage.click("devices/left/workspace");
  held.stage.click("devices/left/scale");  // the middle of its slider
  ASSERT_EQ(held.stage.state().scene.devices.size(), 1u);
  const scene::DeviceSettings& settings = held.stage.state().scene.devices.front();
  EXPECT_GT(settings.scale, 1.5);
  EXPECT_TRUE(settings.origin_mm);
  ASSERT_TRUE(held.stage.until([&] { return held.devices().fingers[0].workspace.frame.mm == settings.scale; }));
  ASSERT_EQ(held.stage.state().held.size(), 1u);
  EXPECT_EQ(held.stage.state().held[0].motion_scale, settings.scale) << "the limits follow";
  held.stage.key(window::key('S'), {true, false});
  const std::filesystem::path file = held.stage.state().document.file;
  const scene::Scene saved = scene::load(file);
  ASSERT_EQ(saved.devices.size(), 1u);
  EXPECT_EQ(saved.devices[0].name, "openhaptics");
  EXPECT_EQ(saved.devices[0].scale, settings.scale);
  EXPECT_EQ(*saved.devices[0].origin_mm, *settings.origin_mm);
  held.stage.key(window::key('Z'), {true, false});
  EXPECT_TRUE(held.stage.until([&] { return held.devices().fingers[0].workspace.frame.mm == 1.0; })) << "undo";
}

TEST(Devices, UnsafeStiffnessIsSeenUntilAnotherBodyIsOpened) {
  Stage stage;
  ViewerState& viewer = stage.state();
  EXPECT_EQ(widgetPlaces().count("unsafe"), 0u);
  viewer.scene.safety.unsafe_stiffness = true;
  viewer.output.changed |= kMapChange;
  ASSERT_TRUE(stage.until([&] { return viewer.devices.unsafe; }));
  stage.frame();
  EXPECT_EQ(widgetPlaces().count("unsafe"), 1u) << "the strip along the upper edge";
  stage.drop(stage.folder / "sheet.ply");
  ASSERT_TRUE(stage.until([&] { return !viewer.devices.unsafe; }));
  stage.frame();
  EXPECT_EQ(widgetPlaces().count("unsafe"), 0u);
}

TEST(Devices, ThreePlacesThatAreTouchedCalibrateOne) {
  HeldStage held;
  held.open();
  const std::array<Vec3, 3> device = {Vec3(0, 0, 0), Vec3(40, 0, 0), Vec3(0, 40, 0)};
  const std::array<Vec3, 3> body = {Vec3(50, 50, 0), Vec3(50, 130, 0),
                                    Vec3(-30, 50, 0)};  // turned by 90, twice as large
  held.stage.click("devices/left/calibrate");
  for (std::size_t i = 0; i < 3; ++i) {
    held.moveTo(device[i]);
    held.stage.state().reading.emplace().place = body[i];
    ASSERT_TRUE(held.stage.until([&] { return held.devices().fingers[0].known_place == device[i]; }));
    held.stage.click("devices/left/take");
    EXPECT_EQ(held.force(), 0.0);
  }
  ASSERT_TRUE(held.devices().calibration.found) << held.devices().calibration.trouble;
  EXPECT_LT(held.devices().calibration.found->residual_mm, 1e-6);
  held.stage.click("devices/left/use");
  EXPECT_FALSE(held.devices().calibration.finger);
  ASSERT_TRUE(held.stage.until([&] { return (held.devices().fingers[0].reading.tip - body[2]).norm() < 1e-6; }))
      << held.devices().fingers[0].reading.tip.transpose();
  EXPECT_NEAR(held.stage.state().scene.devices.front().scale, 2.0, 1e-9);
  EXPECT_NEAR(held.stage.state().scene.devices.front().turn_deg.z(), 90.0, 1e-6);
}

TEST(Devices, PlacesOnALineAreTakenAnew) {
  CalibrationSteps steps;
  for (const double x : {0.0, 30.0, 60.0}) steps.addPair(Vec3(x, 0, 0), Vec3(x, 0, 0));
  EXPECT_FALSE(steps.found);
  EXPECT_NE(steps.trouble.find("nearly on a line"), std::string::npos);
  EXPECT_TRUE(steps.of_device.empty());
}

/// A window that begins on a scene with these devices.
class SceneWithDevices {
 public:
  explicit SceneWithDevices(const std::vector<scene::DeviceSettings>& devices) {
    ViewerSettings settings;
    settings.intro = false;
    settings.output_folder = folder.path();
    scene::Scene scene = sheetScene(folder);
    scene.devices = devices;
    viewer = std::make_unique<Viewer>(scene::build(scene), Stage::quiet(), std::move(settings));
    frame();
  }
  void frame(const std::vector<window::InputEvent>& events = {}) {
    viewer->frame(kStageWidth, kStageHeight, 1.0, now_s += 0.02, events);
  }
  void tap(window::Key key) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::key;
    event.key = key;
    for (const bool down : {true, false}) {
      event.down = down;
      frame({event});
    }
    for (int i = 0; i < 10; ++i) frame();
  }
  DevicesShown& devices() { return viewer->state().devices; }
  bool isAsking() const { return viewer->state().question.has_value(); }

  const support::TemporaryFolder folder;
  const view::OffscreenContext context;
  std::unique_ptr<Viewer> viewer;
  double now_s = 0.0;
};

TEST(Devices, ThoseThatTheSceneNamesAreAskedForAndThenOpened) {
  const HeldStage held;  // the double
  SceneWithDevices opened({{.name = "openhaptics", .finger = scene::HeldFinger::right}});
  ASSERT_TRUE(opened.isAsking());
  EXPECT_NE(opened.viewer->state().question->words.find("openhaptics"), std::string::npos);
  EXPECT_TRUE(opened.devices().fingers[1].opening.empty()) << "nothing is opened before the answer";
  opened.viewer->state().request(AnswerQuestion{"Open"});
  EXPECT_TRUE(support::waitFor([&] {
    opened.frame();
    return !opened.devices().fingers[1].words.empty();
  }));
  EXPECT_TRUE(opened.devices().fingers[0].words.empty());
  EXPECT_FALSE(opened.viewer->state().history.changed());
}

TEST(Devices, OfASceneStayClosedWhereEnterOrEscapeAnswers) {
  for (const window::Key key : {window::Key::enter, window::Key::escape}) {
    SceneWithDevices opened({{.name = "remote"}, {.name = "playback:path.csv", .finger = scene::HeldFinger::right}});
    ASSERT_TRUE(opened.isAsking());
    opened.tap(key);
    EXPECT_FALSE(opened.isAsking());
    for (const FingerHeld& finger : opened.devices().fingers)
      EXPECT_TRUE(finger.opening.empty() && finger.words.empty());
  }
}

TEST(Devices, APluginThatASceneBringsIsNeverLoaded) {
  SceneWithDevices opened({{.name = "plugin:" + doubles::libraryOf("plugin")}});
  for (int i = 0; i < 10; ++i) opened.frame();
  EXPECT_FALSE(opened.isAsking());
  ASSERT_FALSE(opened.viewer->state().messages.all().empty());
  EXPECT_NE(opened.viewer->state().messages.all().back().text.find("files may name only plugins"), std::string::npos);
  opened.viewer->state().request(AnswerQuestion{"Open"});
  opened.frame();
  for (const FingerHeld& finger : opened.devices().fingers) EXPECT_TRUE(finger.opening.empty() && finger.words.empty());
}

TEST(Devices, OfThisProgramAloneAreOpenedUnasked) {
  SceneWithDevices opened({{.name = "hand:stylus_z"}});
  EXPECT_FALSE(opened.isAsking());
  EXPECT_TRUE(support::waitFor([&] {
    opened.frame();
    return !opened.devices().fingers[0].words.empty();
  }));
}

}  // namespace
}  // namespace palpate::viewer
