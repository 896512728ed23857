// The hand-over of a trial's body, without a body: requested, taken, felt.
#include "teach/window/trial_world.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

TrialWorld::Body trialBody(int trial, int site) { return {training::HiddenNow{site, 0.5}, trial}; }

TEST(TrialWorld, IsFeltWithTheFirstTickOnAWorldThatIsTheRequestedOne) {
  TrialWorld world;
  EXPECT_FALSE(world.waiting()) << "nothing has been requested";
  EXPECT_FALSE(world.feel(3));
  EXPECT_TRUE(world.request(trialBody(1, 4)));
  EXPECT_TRUE(world.waiting());
  EXPECT_FALSE(world.feel(4)) << "the servo has taken nothing yet";
  world.taken(true);
  EXPECT_FALSE(world.feel(3)) << "a tick from before that was still under way";
  EXPECT_TRUE(world.waiting());
  EXPECT_TRUE(world.feel(4));
  EXPECT_FALSE(world.waiting());
  EXPECT_FALSE(world.feel(4)) << "it arrives once";
}

TEST(TrialWorld, AnotherWorldThatComesInBetweenIsNotTheRequestedOne) {
  TrialWorld world;
  world.request(trialBody(1, 4));
  world.taken(true);
  world.taken(false);
  EXPECT_FALSE(world.feel(1));
  EXPECT_TRUE(world.waiting());
  world.taken(true);
  EXPECT_TRUE(world.feel(2));
  world.taken(false);
  EXPECT_FALSE(world.waiting()) << "what comes afterwards was not asked for";
}

TEST(TrialWorld, TheNextTrialIsAnotherBodyEvenAtTheSamePlace) {
  TrialWorld world;
  EXPECT_TRUE(world.request(trialBody(1, 4)));
  EXPECT_FALSE(world.request(trialBody(1, 4))) << "it is on its way";
  world.taken(true);
  world.feel(1);
  EXPECT_FALSE(world.request(trialBody(1, 4))) << "it is there";
  EXPECT_TRUE(world.request(trialBody(2, 4)));
  EXPECT_TRUE(world.waiting());
  EXPECT_FALSE(world.feel(1)) << "the world of the trial before";
  world.taken(true);
  EXPECT_FALSE(world.feel(1));
  EXPECT_TRUE(world.feel(2));
}

TEST(TrialWorld, AnInterruptedTrialGoesOnAndDoesNotBeginAgain) {
  TrialWorld world;
  world.request(trialBody(1, 4));
  world.taken(true);
  ASSERT_TRUE(world.feel(1));
  EXPECT_TRUE(world.begins());
  EXPECT_FALSE(world.begins());
  EXPECT_TRUE(world.request({})) << "paused: nothing is to be felt";
  world.taken(true);
  ASSERT_TRUE(world.feel(2));
  EXPECT_TRUE(world.request(trialBody(1, 4)));
  world.taken(true);
  ASSERT_TRUE(world.feel(3));
  EXPECT_FALSE(world.begins()) << "it has the time that was left";
  world.request(trialBody(2, 4));
  world.taken(true);
  ASSERT_TRUE(world.feel(4));
  EXPECT_TRUE(world.begins());
}

TEST(TrialWorld, WhatCouldNotBeMadeIsMadeAnewAndTheNextSessionBeginsAfresh) {
  TrialWorld world;
  world.request(trialBody(1, 4));
  world.fail();
  EXPECT_TRUE(world.waiting());
  EXPECT_TRUE(world.request(trialBody(1, 4)));
  world.taken(true);
  ASSERT_TRUE(world.feel(7));
  ASSERT_TRUE(world.begins());
  world.clear();
  EXPECT_FALSE(world.waiting());
  EXPECT_FALSE(world.requested());
  EXPECT_TRUE(world.request(trialBody(1, 4))) << "the first trial of another session";
  world.taken(true);
  EXPECT_FALSE(world.feel(7)) << "worlds are counted on";
  EXPECT_TRUE(world.feel(8));
  EXPECT_TRUE(world.begins());
}

}  // namespace
}  // namespace palpate::viewer
