#include "palpate/window/head_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palpate::window {
namespace {

using State = window::HeadTracker::State;
constexpr double kPicture = 1.0 / 60.0;

/// A head that is measured before every picture, at a place that depends on time; what was shown last.
template <class Place>
Vec3 track(window::HeadTracker& tracker, double from_s, double to_s, const Place& place) {
  Vec3 shown = Vec3::Zero();
  for (double t = from_s; t < to_s; t += kPicture) {
    tracker.measured(place(t), t);
    shown = tracker.eyesAt(t);
  }
  return shown;
}

TEST(HeadTracker, ShowsTheExpectedPlaceUntilAHeadIsSeen) {
  window::HeadTracker tracker;
  EXPECT_EQ(tracker.eyesAt(0.0), Vec3(0, 0, 600));
  EXPECT_EQ(tracker.stateAt(5.0), State::waiting);
}

TEST(HeadTracker, ComesToRestWhereTheHeadRests) {
  window::HeadTracker tracker;
  const Vec3 head(120, -40, 480);
  EXPECT_LT((track(tracker, 0.0, 1.0, [&](double) { return head; }) - head).norm(), 0.01);
  EXPECT_EQ(tracker.stateAt(1.0), State::tracking);
}

TEST(HeadTracker, TakesTremblingAway) {
  window::HeadTracker tracker;
  double most = 0.0;
  double sign = 1.0;
  for (double t = 0.0; t < 2.0; t += kPicture) {
    tracker.measured(Vec3(3.0 * (sign = -sign), 0, 600), t);
    if (t > 1.0) most = std::max(most, std::abs(tracker.eyesAt(t).x()));
  }
  EXPECT_LT(most, 1.0) << "of 3 mm";
}

TEST(HeadTracker, PredictionTakesBackSomeOfTheDelay) {
  const auto moving = [](double t) { return Vec3(200.0 * t, 0, 600); };
  const auto lag_with = [&](double prediction_s) {
    window::HeadTrackerSettings settings;
    settings.prediction_s = prediction_s;
    window::HeadTracker tracker(settings);
    double last = 0.0;
    for (double t = 0.0; t < 2.0; t += kPicture) last = t;
    return moving(last).x() - track(tracker, 0.0, 2.0, moving).x();
  };
  EXPECT_GT(lag_with(0.0), 5.0);
  EXPECT_NEAR(lag_with(0.0) - lag_with(kPicture), 200.0 * kPicture, 0.1) << "one picture's worth";
}

TEST(HeadTracker, StandsStillWhenTheHeadIsLostThenGlidesWithoutAJump) {
  window::HeadTracker tracker;
  const Vec3 head(150, 60, 500);
  track(tracker, 0.0, 1.0, [&](double) { return head; });
  Vec3 before = tracker.eyesAt(1.0);
  for (double t = 1.0; t < 6.0; t += kPicture) {
    const Vec3 now = tracker.eyesAt(t);
    EXPECT_LT((now - before).norm(), 8.0) << "no jump at " << t;
    const bool still = t > 1.25 && t < 2.1;
    EXPECT_TRUE(!still || (now - head).norm() < 0.1) << "stands still";
    before = now;
  }
  EXPECT_EQ(tracker.stateAt(6.0), State::gliding);
  EXPECT_LT((before - Vec3(0, 0, 600)).norm(), 1.0) << "is where a head is expected";
  // Found again at the other side: no jump either.
  tracker.measured(-head + Vec3(0, 0, 1100), 6.0);
  EXPECT_LT((tracker.eyesAt(6.0) - before).norm(), 1.0);
  EXPECT_LT((track(tracker, 6.02, 7.0, [&](double) { return Vec3(-150, -60, 600); }) - Vec3(-150, -60, 600)).norm(),
            0.1);
}

TEST(HeadTracker, KeepsTheEyesBeforeTheScreenAndIgnoresNonsense) {
  window::HeadTracker tracker;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  tracker.measured(Vec3(nan, 0, 500), 0.0);
  EXPECT_EQ(tracker.stateAt(0.0), State::waiting);
  EXPECT_EQ(track(tracker, 0.0, 1.0, [](double) { return Vec3(0, 0, -300); }).z(), tracker.settings.nearest_mm);
}

TEST(HeadTracker, AddsWhereTheCameraStands) {
  window::HeadTracker tracker;
  tracker.settings.offset_mm = {0, 180, -10};
  const Vec3 eyes = track(tracker, 0.0, 1.0, [](double) { return Vec3(10, 20, 600); });
  EXPECT_LT((eyes - Vec3(10, 200, 590)).norm(), 0.01);
}

}  // namespace
}  // namespace palpate::window
