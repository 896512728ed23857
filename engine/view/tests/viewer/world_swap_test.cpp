#include "view/viewer/world/world_swap.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/mesh/files/save.h"
#include "support/error_message.h"
#include "support/mesh_scene.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::viewer {
namespace {

TEST(SceneFromFile, PutsTheFingersOfTheSceneBeforeOnAMesh) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.ply", zoo::sphere(40.0, 3));
  std::filesystem::rename(folder / "ball.ply", folder / "ball.PLY");
  scene::Scene like;
  like.fingers.resize(1);
  like.fingers[0].radius_mm = 5.0;
  like.dysfunctions.push_back({});
  const scene::Scene scene = sceneFromFile((folder / "ball.PLY").string(), like).scene;
  EXPECT_EQ(scene.fingers[0].radius_mm, 5.0);
  EXPECT_TRUE(scene.dysfunctions.empty());
  EXPECT_EQ(scene::build(scene)->body->name, "ball.PLY");
}

TEST(SceneFromFile, NamesAFileThatCannotBeRead) {
  const std::string message = support::thrownMessage([] { sceneFromFile("/no/such/thing.toml", {}); });
  EXPECT_NE(message.find("/no/such/thing.toml"), std::string::npos) << message;
}

scene::Scene ballScene(const support::TemporaryFolder& folder, double radius_mm) {
  return support::meshScene(folder / (radius_mm > 50.0 ? "large.ply" : "small.ply"), zoo::sphere(radius_mm, 3));
}

/// A window's session and servo, without the window.
struct AtWork {
  explicit AtWork(const scene::Scene& scene)
      : world(scene::build(scene)), servo(planFor(world, scene, true)), world_swap(world) {
    viewer.scene = scene;
    viewer.ticks_per_s = servo.thread().ticksPerS();
  }

  void advance(double now_s, std::uint32_t changed = kNothing) {
    viewer.now_s = now_s;
    viewer.output.changed = changed;
    world_swap.advance({viewer, viewer, viewer, viewer.state.recent, servo.thread()});
  }
  /// The next world that is shown; null after twenty seconds.
  std::shared_ptr<const scene::World> shown() {
    const auto until = Clock::now() + std::chrono::seconds(20);
    while (Clock::now() < until) {
      advance(viewer.now_s + 1.0);
      if (auto now = world_swap.popShown(servo.thread()).world) return now;
      std::this_thread::yield();
    }
    return nullptr;
  }

  std::shared_ptr<const scene::World> world;
  LiveServo servo;
  WorldSwap world_swap;
  ViewerState viewer;
};

double skinHeight(const scene::World& world) { return mesh::boundingBox(world.body->skin).sizes().z(); }

// The body was still being built when the slider was moved; the build that took its place kept the old body.
TEST(WorldSwap, MakesTheBodyToldBeforeTheLastSlider) {
  const support::TemporaryFolder folder;
  AtWork work(ballScene(folder, 40.0));
  work.viewer.scene.body = ballScene(folder, 60.0).body;
  work.advance(0.0, kBodyChange);
  work.advance(1.0);  // quiet for long enough: the body is begun
  work.viewer.scene.stiffness.constant_n_per_mm = 2.0;
  work.advance(1.1, kMapChange);
  work.advance(2.0);  // and replaced by a build of the same body with another stiffness
  const auto shown = work.shown();
  ASSERT_TRUE(shown);
  EXPECT_NEAR(skinHeight(*shown), 120.0, 2.0);
  const auto last = (*shown->surface.stiffness_n_per_mm)[0] == 2.0 ? shown : work.shown();
  ASSERT_TRUE(last);
  EXPECT_EQ((*last->surface.stiffness_n_per_mm)[0], 2.0);
  EXPECT_NEAR(skinHeight(*last), 120.0, 2.0);
}

TEST(WorldSwap, FeelsAnotherSceneAtTheRateTheWindowBeganWithAndSaysSo) {
  const support::TemporaryFolder folder;
  AtWork work(ballScene(folder, 40.0));
  const std::string file = folder / "fast.toml";
  std::ofstream(file) << "ticks_per_s = 500\n[body]\nkind = \"mesh\"\nfile = \"small.ply\"\n";
  work.world_swap.open(file, work.viewer);
  const auto shown = work.shown();
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->scene.ticks_per_s, 500.0);
  EXPECT_EQ(work.servo.thread().ticksPerS(), 1000.0);
  ASSERT_EQ(work.viewer.messages.all().size(), 1u);
  EXPECT_EQ(work.viewer.messages.all().front().text,
            "Touch runs at 1000 ticks per second since this window opened; the scene asks for 500");
}

}  // namespace
}  // namespace palpate::viewer
