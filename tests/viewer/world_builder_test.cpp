#include "apps/viewer/world_builder.h"

#include <gtest/gtest.h>

#include <chrono>

#include "palpate/mesh/files/save.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::viewer {
namespace {

BuildResult resultOf(WorldBuilder& builder) {
  while (true) {
    if (auto result = builder.take()) return *std::move(result);
    std::this_thread::yield();
  }
}

TEST(WorldBuilder, OpensAMeshWithTheFingersOfTheSceneBefore) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.ply", zoo::sphere(40.0, 3));
  std::filesystem::rename(folder / "ball.ply", folder / "ball.PLY");
  scene::Scene like;
  like.fingers.resize(1);
  like.fingers[0].radius_mm = 5.0;
  like.dysfunctions.push_back({});
  WorldBuilder builder;
  builder.wish({like, nullptr, (folder / "ball.PLY").string()});
  const BuildResult result = resultOf(builder);
  ASSERT_TRUE(result.world) << result.error;
  EXPECT_EQ(result.world->scene.fingers[0].radius_mm, 5.0);
  EXPECT_TRUE(result.world->scene.dysfunctions.empty());
  EXPECT_FALSE(builder.progress());
}

TEST(WorldBuilder, TellsWhatIsWrongWithAFile) {
  WorldBuilder builder;
  builder.wish({{}, nullptr, "/no/such/thing.obj"});
  const BuildResult result = resultOf(builder);
  EXPECT_FALSE(result.world);
  EXPECT_NE(result.error.find("/no/such/thing.obj"), std::string::npos) << result.error;
}

TEST(WorldBuilder, TheNewestWishWins) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.ply", zoo::sphere(40.0, 3));
  WorldBuilder builder;
  scene::Scene torso;
  for (int i = 0; i < 5; ++i) builder.wish({torso, nullptr, {}});
  builder.wish({{}, nullptr, (folder / "ball.ply").string()});
  EXPECT_EQ(resultOf(builder).world->body_name, "ball.ply");
}

TEST(WorldBuilder, ReusesABodyAndCanBeCancelled) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.ply", zoo::sphere(40.0, 3));
  WorldBuilder builder;
  builder.wish({{}, nullptr, (folder / "ball.ply").string()});
  const auto first = resultOf(builder).world;
  scene::Scene scene = first->scene;
  scene.stiffness.constant_n_per_mm = 2.0;
  builder.wish({scene, first, {}});
  EXPECT_EQ(resultOf(builder).world->stiffness_n_per_mm.at(0), 2.0);
  builder.wish({scene, nullptr, {}});
  builder.cancel();
  while (builder.progress()) std::this_thread::yield();
  EXPECT_FALSE(builder.take());
}

}  // namespace
}  // namespace palpate::viewer
