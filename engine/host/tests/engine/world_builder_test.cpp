#include "palpate/engine/world_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/mesh/files/save.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::engine {
namespace {

/// Balls in files: a small one that is built in milliseconds, and one that takes a good while.
struct Balls {
  Balls() {
    mesh::save(folder / "small.ply", zoo::sphere(40.0, 3));
    mesh::save(folder / "large.ply", zoo::sphere(40.0, 6));
  }
  BuildRequest request(const std::string& name) const {
    BuildRequest request;
    request.scene.body.kind = scene::BodyKind::mesh;
    request.scene.body.file = folder / name;
    return request;
  }
  support::TemporaryFolder folder;
};

BuildResult awaitResult(WorldBuilder& builder) {
  while (true) {
    if (auto result = builder.collectResult()) return *std::move(result);
    std::this_thread::yield();
  }
}

void waitUntilIdle(const WorldBuilder& builder) {
  while (builder.progress()) std::this_thread::yield();
}

TEST(WorldBuilder, HandsOverWhatWasRequestedOnce) {
  const Balls balls;
  WorldBuilder builder;
  EXPECT_FALSE(builder.collectResult());
  builder.request(balls.request("small.ply"));
  const BuildResult result = awaitResult(builder);
  ASSERT_TRUE(result.world) << result.error;
  EXPECT_EQ(result.world->body->name, "small.ply");
  EXPECT_FALSE(builder.progress());
  EXPECT_FALSE(builder.collectResult());
}

TEST(WorldBuilder, TellsWhatIsWrongWithAFile) {
  const Balls balls;
  WorldBuilder builder;
  builder.request(balls.request("missing.ply"));
  const BuildResult result = awaitResult(builder);
  EXPECT_FALSE(result.world);
  EXPECT_NE(result.error.find("missing.ply"), std::string::npos) << result.error;
}

TEST(WorldBuilder, ReadsTheSceneBesideTheCaller) {
  const Balls balls;
  WorldBuilder builder;
  std::thread::id reader;
  BuildRequest request;
  request.read = [&] {
    reader = std::this_thread::get_id();
    return balls.request("small.ply").scene;
  };
  builder.request(request);
  EXPECT_EQ(awaitResult(builder).world->body->name, "small.ply");
  EXPECT_NE(reader, std::this_thread::get_id());
  request.read = []() -> scene::Scene { throw Error("no scene today"); };
  builder.request(request);
  EXPECT_EQ(awaitResult(builder).error, "no scene today");
}

TEST(WorldBuilder, AWorldCanBeRefusedBeforeAnybodySeesIt) {
  const Balls balls;
  WorldBuilder builder([](const scene::World& world) { throw Error("not " + world.body->name); });
  builder.request(balls.request("small.ply"));
  const BuildResult result = awaitResult(builder);
  EXPECT_FALSE(result.world);
  EXPECT_EQ(result.error, "not small.ply");
}

TEST(WorldBuilder, OnlyTheNewestRequestCounts) {
  const Balls balls;
  WorldBuilder builder;
  for (int i = 0; i < 20; ++i) builder.request(balls.request("large.ply"));
  builder.request(balls.request("small.ply"));
  EXPECT_EQ(awaitResult(builder).world->body->name, "small.ply");
  waitUntilIdle(builder);
  EXPECT_FALSE(builder.collectResult());
}

TEST(WorldBuilder, ACancelledRequestLeavesNothingEvenWhenItWasDone) {
  const Balls balls;
  WorldBuilder builder;
  builder.request(balls.request("large.ply"));
  builder.cancel();
  waitUntilIdle(builder);
  EXPECT_FALSE(builder.collectResult());
  builder.request(balls.request("small.ply"));
  waitUntilIdle(builder);
  builder.cancel();
  EXPECT_FALSE(builder.collectResult());
}

TEST(WorldBuilder, ReusesABody) {
  const Balls balls;
  WorldBuilder builder;
  builder.request(balls.request("small.ply"));
  const auto first = awaitResult(builder).world;
  BuildRequest request{first->scene, first, {}};
  request.scene.stiffness.constant_n_per_mm = 2.0;
  request.scene.body.file = "not/looked/at.ply";
  builder.request(request);
  const auto second = awaitResult(builder).world;
  ASSERT_TRUE(second);
  EXPECT_EQ(second->surface.stiffness_n_per_mm->at(0), 2.0);
  EXPECT_EQ(second->body->skin.triangles, first->body->skin.triangles);
}

TEST(WorldBuilder, ReportsProgressWhileItBuilds) {
  const Balls balls;
  WorldBuilder builder;
  builder.request(balls.request("large.ply"));
  std::vector<std::string> stages;
  std::optional<BuildResult> result;
  while (!(result = builder.collectResult())) {
    if (const auto progress = builder.progress()) {
      EXPECT_GE(progress->done, 0.0);
      EXPECT_LE(progress->done, 1.0);
      EXPECT_GE(progress->since_s, 0.0);
      if (stages.empty() || stages.back() != progress->stage) stages.push_back(progress->stage);
    }
    std::this_thread::yield();
  }
  EXPECT_TRUE(result->world) << result->error;
  EXPECT_GE(stages.size(), 2u);
}

// Not by the clock, which a busy machine stretches: what it was building when it was destroyed never comes to its end.
TEST(WorldBuilder, GivesUpWhatItBuildsWhenItIsDestroyed) {
  const Balls balls;
  std::atomic<bool> under_way = false;
  std::atomic<bool> leaving = false;
  bool finished = false;
  {
    WorldBuilder builder([&](const scene::World&) { finished = true; });
    BuildRequest request;
    request.read = [&] {
      under_way = true;
      while (!leaving) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the destructor has begun by now
      return balls.request("large.ply").scene;
    };
    builder.request(request);
    while (!under_way) std::this_thread::yield();
    leaving = true;
  }
  EXPECT_FALSE(finished);
}

// Also the test that ThreadSanitizer watches.
TEST(WorldBuilder, ManyThreadsRequestAndTakeAtOnce) {
  const Balls balls;
  WorldBuilder builder;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      Random random(static_cast<std::uint64_t>(t));
      for (int i = 0; i < 200; ++i) {
        if (random.below(8) == 0) builder.request(balls.request("small.ply"));
        if (random.below(40) == 0) builder.cancel();
        const auto progress = builder.progress();
        EXPECT_LE(progress ? progress->done : 0.0, 1.0);
        const auto result = builder.collectResult();
        EXPECT_TRUE(!result || result->world);
        if (random.below(4) == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  builder.request(balls.request("small.ply"));
  EXPECT_TRUE(awaitResult(builder).world);
}

}  // namespace
}  // namespace palpate::engine
