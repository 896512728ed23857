// A person's folder walked with pictures that are plain text and a measurer that tells what it is asked.
#include "palpate/measure/person/person_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/key_row.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::measure {
namespace {

namespace fs = std::filesystem;

Protocol twoPoints() {
  Protocol protocol{.person = "P07", .presses = 2, .enough = 1, .drags = {}, .points = {}};
  protocol.drags = {{"up", 90.0}, {"right", 0.0}};
  protocol.points = {{"P1", "T5", {0, 73}}, {"P4", "", {-100, 5.5}}};
  return protocol;
}

/// The row of an ellipse, as keyRow writes it.
std::string makeKeyRow(const PlannedPress& planned, double half_major_mm) {
  return fmt::format("{},{},{},{},1.2,{},,,,,,,{},1,0.02,2,,", planned.point, planned.place_mm.x(),
                     planned.place_mm.y(), half_major_mm, planned.drag_deg, planned.drag_deg);
}

class PersonFolder : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text = "picture") const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  void putPress(const std::string& press, const std::string& text = "picture") const {
    put(press + "_before.jpg", text + " before");
    put(press + "_after.jpg", text + " after");
  }
  void begin(const Protocol& protocol = twoPoints()) const { put("protocol.toml", protocolText(protocol)); }

  /// "refuse" in the picture before refuses it, "blind" finds nothing at all.
  MeasurePress measurer() {
    return [this](const Protocol&, const PlannedPress& planned, const PressPictures& pictures, const Progress&) {
      measured_.push_back(planned.name);
      const std::string before = readFile(pictures.before, 1000);
      if (before.find("blind") != std::string::npos) return PressOutcome{.refusals = {"no dots"}};
      PressOutcome outcome{.accepted = before.find("refuse") == std::string::npos, .row = makeKeyRow(planned, 80)};
      if (!outcome.accepted) outcome.refusals = {"the body \"moved\", by 2 mm"};
      if (!pictures.before2.empty()) outcome.null_drift_mm = 0.125;
      return outcome;
    };
  }
  PersonWalk walk(const WalkDecisions& decisions = {}) {
    measured_.clear();
    return walkPerson(folder_.path(), measurer(), decisions);
  }
  static const WalkedPress& pressOf(const PersonWalk& walk, const std::string& name) {
    for (const WalkedPress& press : walk.presses) {
      if (press.planned.name == name) return press;
    }
    throw Error("no press " + name);
  }

  support::TemporaryFolder folder_;
  std::vector<std::string> measured_;
};

TEST_F(PersonFolder, ANewFolderHasAProtocolAStencilAndAList) {
  const fs::path fresh = folder_ / "P07";
  const auto written = beginPerson(fresh, twoPoints());
  EXPECT_EQ(written.size(), 3u);
  const Protocol read = readProtocol(fresh / kProtocolFile);
  EXPECT_EQ(read.person, "P07");
  EXPECT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[1].place_mm, Vec2(-100, 5.5));
  EXPECT_EQ(read.drags[1].degrees, 0.0);
  EXPECT_EQ(read.presses, 2);
  EXPECT_NE(readFile(fresh / "checklist.md", 1 << 20).find("P4_right_2_released"), std::string::npos);
  EXPECT_NE(readFile(fresh / "stencil.svg", 1 << 20).find("<svg"), std::string::npos);
  EXPECT_NE(support::thrownMessage([&] { beginPerson(fresh, twoPoints()); }).find("is not replaced"),
            std::string::npos);
}

TEST_F(PersonFolder, TellsWhichPicturesAreMissingAndWhichAreStrangers) {
  begin();
  putPress("P1_up_1");
  put("p1_UP_2_before.PNG");
  put("P1_upp_2_after.jpg");
  const PersonWalk walked = walk();
  EXPECT_EQ(walked.presses.size(), 8u);
  EXPECT_TRUE(pressOf(walked, "P1_up_1").missing.empty());
  EXPECT_TRUE(pressOf(walked, "P1_up_1").counts());
  EXPECT_EQ(pressOf(walked, "P1_up_2").missing, std::vector<std::string>{"P1_up_2_after"});
  EXPECT_EQ(pressOf(walked, "P4_up_1").missing.size(), 2u);
  EXPECT_EQ(walked.strangers, std::vector<std::string>{"P1_upp_2_after.jpg"});
  EXPECT_FALSE(walked.complete());
  EXPECT_EQ(walked.progress().front().counting, 1);
  EXPECT_EQ(walked.progress().back().counting, 0);
}

TEST_F(PersonFolder, AFolderCalledAsAPressHoldsItsPictures) {
  begin();
  fs::create_directories(folder_ / "P1_up_1");
  put("P1_up_1/before.jpg");
  put("P1_up_1/after.JPG");
  put("P1_up_1/before2.jpg");
  put("P1_up_1/truth.json");
  const PersonWalk walked = walk();
  EXPECT_TRUE(pressOf(walked, "P1_up_1").counts());
  EXPECT_EQ(pressOf(walked, "P1_up_1").outcome->null_drift_mm, 0.125);
  EXPECT_TRUE(walked.strangers.empty());
}

TEST_F(PersonFolder, MeasuresAgainOnlyWhatHasChanged) {
  begin();
  putPress("P1_up_1");
  putPress("P1_up_2");
  walk();
  EXPECT_EQ(measured_, (std::vector<std::string>{"P1_up_1", "P1_up_2"}));
  const PersonWalk again = walk();
  EXPECT_TRUE(measured_.empty());
  EXPECT_TRUE(pressOf(again, "P1_up_1").counts()) << "as it was kept";
  EXPECT_FALSE(pressOf(again, "P1_up_1").fresh);
  putPress("P1_up_2", "another");
  walk();
  EXPECT_EQ(measured_, std::vector<std::string>{"P1_up_2"});
  Protocol wider = twoPoints();
  wider.spacing_mm = 25.0;
  begin(wider);
  walk();
  EXPECT_EQ(measured_.size(), 2u) << "what it is measured by has changed";
}

TEST_F(PersonFolder, KeepsWhatWasSeenToTheLetter) {
  begin();
  putPress("P1_up_1", "refuse");
  put("P1_up_1_before2.jpg");
  walk();
  const PersonWalk again = walk();
  const PressOutcome& outcome = *pressOf(again, "P1_up_1").outcome;
  EXPECT_FALSE(outcome.accepted);
  EXPECT_EQ(outcome.refusals, std::vector<std::string>{"the body \"moved\", by 2 mm"});
  EXPECT_EQ(outcome.null_drift_mm, 0.125);
  EXPECT_EQ(outcome.row, makeKeyRow(pressOf(again, "P1_up_1").planned, 80));
}

TEST_F(PersonFolder, ADecisionHoldsUntilThePicturesChange) {
  begin();
  putPress("P1_up_1", "refuse");
  putPress("P1_up_2");
  EXPECT_FALSE(pressOf(walk(), "P1_up_1").counts());
  const PersonWalk decided = walk({.accept = {"P1_up_1"}, .repeat = {"P1_up_2"}});
  EXPECT_TRUE(pressOf(decided, "P1_up_1").counts());
  EXPECT_FALSE(pressOf(decided, "P1_up_2").counts());
  EXPECT_TRUE(pressOf(walk(), "P1_up_1").counts());
  putPress("P1_up_2", "repeated");
  EXPECT_TRUE(pressOf(walk(), "P1_up_2").counts()) << "a new picture, a new chance";
}

TEST_F(PersonFolder, WhatCannotBeDecidedIsSaid) {
  begin();
  putPress("P1_up_1", "blind");
  EXPECT_EQ(support::thrownMessage([&] { walk({.accept = {"P1_up_1"}}); }),
            "P1_up_1 gave no ellipse that could be accepted; repeat it");
  EXPECT_EQ(support::thrownMessage([&] { walk({.accept = {"P4_up_1"}}); }),
            "P4_up_1 was not measured; its pictures are missing");
  EXPECT_EQ(support::thrownMessage([&] { walk({.repeat = {"P1_up_7"}}); }),
            "unknown press 'P1_up_7'; did you mean 'P1_up_1'?");
}

TEST_F(PersonFolder, ListedPicturesLieWhereTheListSays) {
  Protocol protocol = twoPoints();
  begin(protocol);
  std::ofstream(folder_ / "protocol.toml", std::ios::app)
      << "\n[[pictures]]\npress = \"P1_up_1\"\nbefore = \"DSC_1.JPG\"\nafter = \"sub/DSC_2.JPG\"\ncontact_px = [20, "
         "30.5]\n";
  fs::create_directories(folder_ / "sub");
  put("DSC_1.JPG");
  put("sub/DSC_2.JPG");
  const PersonWalk walked = walk();
  EXPECT_EQ(measured_, std::vector<std::string>{"P1_up_1"});
  EXPECT_EQ(pressOf(walked, "P1_up_1").pictures.contact_px, Vec2(20, 30.5));
  EXPECT_TRUE(walked.strangers.empty());
}

TEST_F(PersonFolder, ACompleteWalkBecomesAMapAndASceneThatBuilds) {
  begin();
  for (const char* press : {"P1_up_1", "P1_right_2", "P4_up_1", "P4_right_1"}) putPress(press);
  std::string forces = "place,x_mm,y_mm,depth_mm,force_n\n";
  for (int i = 1; i <= 12; ++i) {
    forces += fmt::format("P1,,,{0},{1:.5f}\nloin,60,-150,{0},{2:.5f}\n", i, 0.3 * i * std::pow(i / 8.0, 0.6),
                          0.5 * i * std::pow(i / 8.0, 0.6));
  }
  put("forces.csv", forces);
  const PersonWalk walked = walk();
  ASSERT_TRUE(walked.complete());
  const PersonResult result = writePerson(walked);
  EXPECT_EQ(result.written.size(), 2u);
  const auto keys = maps::readKeyPoints(folder_ / "person.csv");
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_NEAR(*keys[0].stiffness_n_per_mm, 0.3, 0.003);
  EXPECT_FALSE(keys[1].stiffness_n_per_mm);
  EXPECT_EQ(keys[2].name, "loin");
  // Pulled up 80 x 66.7 up, pulled right 80 x 66.7 right: a circle stretched along the drag.
  EXPECT_NEAR(keys[0].ellipse.half_major_mm, 80.0 / std::sqrt(1.2), 1e-3);
  EXPECT_NEAR(result.averages.points[0].along_drag->value, 1.2, 1e-6);
  const scene::Scene scene = scene::load(folder_ / "scene.toml");
  EXPECT_EQ(scene.title, "P07");
  EXPECT_NEAR(scene.ellipses.basic_radius_mm, 80.0 / std::sqrt(1.2), 0.05) << "the mean of what was measured";
  const auto world = scene::build(scene);
  EXPECT_NEAR(world->ellipses.at(0, 73).half_major_mm, keys[0].ellipse.half_major_mm, 1e-6);
}

TEST_F(PersonFolder, AnIncompleteWalkWritesNothing) {
  begin();
  putPress("P1_up_1");
  const PersonWalk walked = walk();
  EXPECT_NE(
      support::thrownMessage([&] { writePerson(walked); }).find("is not complete; measure the missing presses first"),
      std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "person.csv"));
}

TEST(PersonProtocol, APersonIsACodeAndNoName) {
  for (const char* code : {"P07", "a1", "7"}) EXPECT_EQ(faultOfPerson(code), "") << code;
  for (const char* name : {"", "Anna", "Mueller", "P-7", "P 7", "../P7", "A123456789012345678"}) {
    EXPECT_NE(faultOfPerson(name), "") << name;
  }
}

TEST(PersonProtocol, NamesTheLineOfWhatItCannotRead) {
  const auto fault = [](const std::string& text) {
    return support::thrownMessage([&] { parseProtocol(text, "p.toml"); });
  };
  const std::string good = "person = \"P7\"\ndrags = [\"up\"]\n";
  const std::string point = "[[point]]\nname = \"P1\"\nx_mm = 0\ny_mm = 1\n";
  EXPECT_EQ(fault(good + point), "no error");
  EXPECT_EQ(fault("person = \"Anna\"\n"),
            "p.toml:1: person: a person is a code with a digit in it, such as P07, and no name");
  EXPECT_EQ(fault(good + "spacing = 3\n" + point), "p.toml:3: unknown key 'spacing'; did you mean 'spacing_mm'?");
  EXPECT_EQ(fault(good + "spacing_mm = 3\n" + point), "p.toml:3: spacing_mm = 3 is out of range: 5 to 100");
  EXPECT_EQ(fault(good + "presses = 2.5\n" + point), "p.toml:3: presses must be a whole number");
  EXPECT_EQ(fault("person = \"P7\"\ndrags = [\"uphill\"]\n" + point),
            "p.toml:2: 'uphill' must be up, down, left or right");
  EXPECT_EQ(fault(good), "p.toml: has no [[point]]");
  EXPECT_EQ(fault(good + point + point), "p.toml: the point P1 appears twice");
  EXPECT_EQ(fault(good + "enough = 4\n" + point), "p.toml: enough must not exceed presses");
  EXPECT_EQ(fault(good + point + "[[pictures]]\npress = \"P2_up_1\"\n"),
            "p.toml: unknown press 'P2_up_1' in [[pictures]]; did you mean 'P1_up_1'?");
  EXPECT_NE(fault("person = \n").find("p.toml:1:"), std::string::npos);
  EXPECT_NE(fault(good + "[[point]]\nname = \"P1/..\"\n").find("letters and digits"), std::string::npos);
}

TEST(PersonPress, ADragThatIsNotTheOneAskedForIsRefused) {
  Measurement measurement;
  FieldFit fit;
  fit.at_2_mm = {
      .half_major_mm = {80, 1}, .half_minor_mm = {60, 1}, .major_over_minor = {1.33, 0.01}, .direction_deg = {80, 1}};
  fit.drag_deg = {-85.0, 1.0};
  measurement.fit = fit;
  const PlannedPress up{"P1_up_1", "P1", {0, 73}, 90.0};
  const PlannedPress down{"P1_down_1", "P1", {0, 73}, -90.0};
  EXPECT_TRUE(assessPress(measurement, down, 0.1).accepted);
  const PressOutcome swapped = assessPress(measurement, up, 0.1);
  EXPECT_FALSE(swapped.accepted);
  EXPECT_NE(swapped.refusals.front().find("the skin was dragged down, expected up"), std::string::npos);
  const PressOutcome moved = assessPress(measurement, down, 0.8);
  EXPECT_FALSE(moved.accepted);
  EXPECT_NE(moved.refusals.front().find("moved 0.80 mm"), std::string::npos);
  EXPECT_EQ(moved.row.substr(0, 11), "P1,0,73,80,") << "kept, for who accepts it all the same";
}

}  // namespace
}  // namespace palpate::measure
