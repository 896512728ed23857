// What an instructor sees: messages become tiles, who needs help comes first and for the right reason, old data are
// shown as old, and the class's curve is the median of its trainees.
#include "palpate/classroom/class_board.h"

#include <gtest/gtest.h>

#include "teach/tests/training/records_samples.h"

namespace palpate::classroom {
namespace {

namespace samples = training::samples;

/// Stations that send what a test makes them send.
class ClassBoardTest : public testing::Test {
 protected:
  bool send(const std::string& station, const char* kind, const std::string& text, double now_s) {
    return board_.acceptMessage(topicText({"osteo-1", station, kind}), text, now_s);
  }
  Envelope envelope() { return {++sequence_, samples::id(9, sequence_), 0.0}; }
  void online(const std::string& station, bool there = true, const std::string& safety = "ok") {
    ASSERT_TRUE(send(station, "status", statusText(envelope(), {there, "palpate", "mouse", safety}), 0.0));
  }
  void state(const std::string& station, const StationState& state, double now_s) {
    ASSERT_TRUE(send(station, "state", stateText(envelope(), state), now_s));
  }
  void press(const std::string& station, double force_n, double now_s) {
    LiveSample live;
    live.force_n = force_n;
    live.site = 3;
    live.sites_pressed = 4;
    ASSERT_TRUE(send(station, "live", liveText(envelope(), live), now_s));
  }
  static StationState inTrial(int trial = 1) {
    StationState state;
    state.session = samples::id(2, 1);
    state.trainee = samples::trainee().id;
    state.screen = training::Screen::trial;
    state.trial = trial;
    return state;
  }
  Need stationNeed(const std::string& station, double now_s) const { return board_.tile(station, now_s).value().need; }

  ClassBoard board_{"osteo-1"};
  std::uint64_t sequence_ = 0;
};

TEST_F(ClassBoardTest, ATileShowsTrialForceSitesAndAge) {
  online("s01");
  state("s01", inTrial(7), 100.0);
  press("s01", 1.25, 101.0);
  const Tile tile = board_.tile("s01", 102.5).value();
  EXPECT_TRUE(tile.online);
  EXPECT_EQ(tile.state->trial, 7);
  EXPECT_DOUBLE_EQ(tile.live.force_n, 1.25);
  EXPECT_EQ(tile.live.sites_pressed, 4);
  EXPECT_DOUBLE_EQ(tile.age_s.value(), 1.5);
  EXPECT_TRUE(tile.fresh);
  EXPECT_FALSE(board_.tile("s01", 103.1)->fresh) << "data of more than two seconds ago are grey";
}

TEST_F(ClassBoardTest, EachReasonForHelpIsSeen) {
  for (const char* station : {"errors", "skips", "light", "stopped", "well"}) online(station);
  StationState errors = inTrial();
  errors.wrong_in_a_row = 3;
  state("errors", errors, 0.0);
  StationState skips = inTrial();
  skips.sites_skipped = 2;
  state("skips", skips, 0.0);
  StationState light = inTrial();
  light.palpate_force_n = 0.4;
  state("light", light, 0.0);
  online("stopped", true, "emergency stop");
  StationState well = inTrial();
  well.wrong_in_a_row = 2;
  well.palpate_force_n = 0.6;
  state("well", well, 0.0);
  EXPECT_EQ(stationNeed("errors", 1.0), Need::three_errors);
  EXPECT_EQ(stationNeed("skips", 1.0), Need::sites_skipped);
  EXPECT_EQ(stationNeed("light", 1.0), Need::too_light);
  EXPECT_EQ(stationNeed("stopped", 1.0), Need::alarm);
  EXPECT_EQ(stationNeed("well", 1.0), Need::none);
  std::vector<std::string> order;
  for (const Tile& tile : board_.tiles(1.0)) order.push_back(tile.station);
  EXPECT_EQ(order, (std::vector<std::string>{"stopped", "errors", "skips", "light", "well"}));
}

TEST_F(ClassBoardTest, WhoTouchesNothingForAMinuteIsIdle) {
  online("s01");
  state("s01", inTrial(), 10.0);
  press("s01", 1.0, 20.0);
  press("s01", 0.0, 30.0);  // lifted
  EXPECT_EQ(stationNeed("s01", 79.0), Need::none);
  EXPECT_EQ(stationNeed("s01", 81.0), Need::idle);
  state("s01", inTrial(2), 82.0);  // an answer
  EXPECT_EQ(stationNeed("s01", 100.0), Need::none);
  StationState paused = inTrial(2);
  paused.paused = true;
  state("s01", paused, 101.0);
  EXPECT_EQ(stationNeed("s01", 1000.0), Need::none);
}

TEST_F(ClassBoardTest, WhoOnlyStrokesIsSeenDuringTheTrial) {
  online("s01");
  state("s01", inTrial(), 0.5);
  double now_s = 1.0;
  for (; now_s < 9.0; now_s += 0.1) press("s01", 0.3, now_s);
  EXPECT_EQ(stationNeed("s01", now_s), Need::none);
  for (; now_s < 12.0; now_s += 0.1) press("s01", 0.3, now_s);
  EXPECT_EQ(stationNeed("s01", now_s), Need::too_light);
  press("s01", 0.6, now_s);
  EXPECT_EQ(stationNeed("s01", now_s), Need::none);
}

TEST_F(ClassBoardTest, AStationThatIsGoneNeedsNobodyAndIsNotFresh) {
  online("s01");
  StationState errors = inTrial();
  errors.wrong_in_a_row = 5;
  state("s01", errors, 0.0);
  press("s01", 1.0, 0.5);
  online("s01", false);
  EXPECT_EQ(stationNeed("s01", 1.0), Need::none);
  EXPECT_FALSE(board_.tile("s01", 1.0)->fresh);
  ASSERT_TRUE(send("s01", "state", "", 2.0));  // signed off
  EXPECT_FALSE(board_.tile("s01", 2.0)->state);
}

TEST_F(ClassBoardTest, BlockRowsBringTheThresholdSoFar) {
  online("s01");
  StationState sits = inTrial();
  const training::SessionRow session = samples::session(samples::trainee(), 5);
  sits.session = session.id;
  state("s01", sits, 0.0);
  training::BlockRow block = samples::block(session, 5);
  block.finished = false;
  block.threshold = 0.19;
  block.threshold_low = 0.12;
  block.threshold_high = 0.31;
  ASSERT_TRUE(send("s01", "block", rowText(envelope(), training::rowJson(block)), 1.0));
  EXPECT_DOUBLE_EQ(board_.tile("s01", 1.0)->state->threshold, 0.19);
  EXPECT_DOUBLE_EQ(board_.tile("s01", 1.0)->state->high, 0.31);
  EXPECT_TRUE(board_.learningCurve().empty()) << "it is not finished";
}

TEST_F(ClassBoardTest, TheClassesCurveIsTheMedianOfItsTrainees) {
  const std::vector<std::vector<double>> thresholds = {{0.30, 0.20}, {0.20, 0.12}, {0.40}};
  std::uint64_t number = 1;
  for (std::size_t who = 0; who < thresholds.size(); ++who) {
    const auto trainee = samples::trainee("T" + std::to_string(who));
    for (const double threshold : thresholds[who]) {
      const auto session = samples::session(trainee, number);
      auto block = samples::block(session, number++);
      block.threshold = threshold;
      ASSERT_TRUE(send("s01", "session", rowText(envelope(), training::rowJson(session)), 1.0));
      ASSERT_TRUE(send("s01", "block", rowText(envelope(), training::rowJson(block)), 1.0));
      ASSERT_TRUE(send("s01", "block", rowText(envelope(), training::rowJson(block)), 1.0));  // sent again
    }
  }
  const auto curve = board_.learningCurve();
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0].trainees, 3);
  EXPECT_DOUBLE_EQ(curve[0].median, 0.30);
  EXPECT_EQ(curve[1].trainees, 2);
  EXPECT_DOUBLE_EQ(curve[1].median, 0.16);
}

TEST_F(ClassBoardTest, StrangeMessagesChangeNothing) {
  online("s01");
  press("s01", 1.0, 1.0);
  EXPECT_FALSE(send("s01", "live", "{}", 2.0));
  EXPECT_FALSE(send("s01", "state", "{\"a\":1}", 2.0));
  EXPECT_FALSE(send("s01", "trial", "[]", 2.0));
  EXPECT_FALSE(board_.acceptMessage("palpate/v1/other/st/s02/live", "{}", 2.0));
  EXPECT_DOUBLE_EQ(board_.tile("s01", 2.0)->live.force_n, 1.0);
  EXPECT_EQ(board_.tiles(2.0).size(), 1U);
}

TEST_F(ClassBoardTest, ForcesOfTheLastSecondsAreKept) {
  for (int i = 0; i < 600; ++i) press("s01", 0.01 * i, 0.1 * i);
  const auto forces = board_.forces("s01");
  ASSERT_FALSE(forces.empty());
  EXPECT_NEAR(forces.back().s - forces.front().s, ClassBoard::kForcesKeptS, 0.2);
  EXPECT_NEAR(forces.back().force_n, 5.99, 1e-9);
}

}  // namespace
}  // namespace palpate::classroom
