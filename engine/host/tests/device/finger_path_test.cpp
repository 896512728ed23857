#include "palpate/device/finger_path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/tests/scene/dome_scene.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"

namespace palpate::device {
namespace {

using PathOf = scene::DomeScene;

TEST_F(PathOf, ScriptsFollowTheSkinFromAbove) {
  writeDome("dome.obj");
  const auto world = scene::build(meshScene());
  const FingerPaths paths = pathsOf(*world);
  ASSERT_EQ(paths.ticks, 1001u);
  EXPECT_NEAR(paths.tips[0]->front().z(), 19.95 + 10.0, 0.2);
  EXPECT_NEAR(paths.tips[0]->back().z(), 19.95 - 3.0, 0.2);
}

TEST_F(PathOf, FingersShareOneClock) {
  writeDome("dome.obj");
  write("early.csv", "1.0,0,0,30\n1.1,0,0,20\n");
  write("late.csv", "1.5,0,0,30\n2.0,0,0,20\n");
  scene::Scene scene = meshScene();
  scene.fingers = {{"early", 0.0, folder_ / "early.csv", Vec2::Zero(), 10.0, {}},
                   {"late", 0.0, folder_ / "late.csv", Vec2::Zero(), 10.0, {}}};
  const FingerPaths paths = pathsOf(*scene::build(scene));
  EXPECT_EQ(paths.start_s, 1.0);
  EXPECT_EQ(paths.ticks, 1001u);
  EXPECT_EQ((*paths.tips[1])[500], Vec3(0, 0, 30));
  EXPECT_LT((*paths.tips[1])[501].z(), 30.0);
}

TEST_F(PathOf, AnyMeshGetsAPathOverItsTop) {
  writeDome("dome.obj");
  const auto world = scene::build(meshScene());
  const Trajectory path = automaticPath(*world);
  EXPECT_NEAR(path.tip_mm.front().z(), 20.0 + 10.0 * world->surface.geometry->tree.diagonal / 400.0, 0.5);
  double lowest = 1e9;
  for (const Vec3& tip : path.tip_mm) lowest = std::min(lowest, tip.z());
  EXPECT_LT(lowest, 16.0);
}

/// 200 places off the border, falling to the right and a little away; the highest has no room for a drag to its right.
TEST_F(PathOf, EachOfTwoHundredPlacesIsTriedForRoom) {
  mesh::TriangleMesh slope = zoo::grid(21, 210.0);
  std::erase_if(slope.triangles, [&](const auto& t) {
    return std::ranges::any_of(t, [&](Index v) { return slope.positions[v].y() > 115.0; });
  });
  for (Vec3& place : slope.positions) {
    const bool is_highest = (place - Vec3(200, 100, 0)).norm() < 1.0;
    place.z() = is_highest ? 5.0 : -0.02 * place.x() - 0.003 * place.y();
  }
  mesh::save(folder_ / "dome.obj", slope);
  const Vec3 start = automaticPath(*scene::build(meshScene())).tip_mm.front();
  EXPECT_LT((start - Vec3(10, 10, start.z())).norm(), 1.0) << start.transpose();
}

TEST_F(PathOf, AnOnlyPlaceIsTriedToo) {
  mesh::save(folder_ / "dome.obj", {{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, {5, 5, 10}},
                                    {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});
  const Vec3 start = automaticPath(*scene::build(meshScene())).tip_mm.front();
  EXPECT_LT((start - Vec3(5, 5, start.z())).norm(), 1.0) << start.transpose();
}

TEST_F(PathOf, NeedsSkinUnderTheFinger) {
  writeDome("dome.obj");
  scene::Scene beside = meshScene();
  beside.fingers[0].at_mm = Vec2(500, 0);
  const auto world = scene::build(beside);
  EXPECT_EQ(support::thrownMessage([&] { pathsOf(*world); }),
            (folder_ / "s.toml").string() + ":4: finger 'a': there is no skin at at_mm = [500, 0]");
}

TEST_F(PathOf, ComplaintsNameTheFingersPlaceInTheSceneFile) {
  const std::string scene = "\n[[finger]]\nname = \"a\"\n";
  const auto message = [&](const std::string& rest) {
    writeDome("dome.obj");
    scene::Scene with_finger = meshScene();
    with_finger.fingers = scene::parse(scene + rest, "s.toml").fingers;
    const auto world = scene::build(with_finger);
    return support::thrownMessage([&] { pathsOf(*world); });
  };
  EXPECT_EQ(message("at_mm = [500, 0]\nscript = [{ do = \"press\" }]\n"),
            "s.toml:2: finger 'a': there is no skin at at_mm = [500, 0]");
  EXPECT_EQ(message("script = [{ do = \"hold\", seconds = 3600 }, { do = \"hold\", seconds = 3600 }, "
                    "{ do = \"hold\", seconds = 3600 }, { do = \"hold\", seconds = 3600 }]\n"),
            "s.toml:2: finger 'a': the script lasts 14400 s, more than 10,800 s");
}

TEST_F(PathOf, ATrajectoryOfTooManyTicksNamesItsFile) {
  writeDome("dome.obj");
  write("long.csv", "0,0,0,30\n40000,0,0,20\n");
  scene::Scene scene = meshScene();
  scene.ticks_per_s = 2000.0;
  scene.fingers = {{"a", 0.0, folder_ / "long.csv", Vec2::Zero(), 10.0, {}}};
  const auto world = scene::build(scene);
  EXPECT_EQ(support::thrownMessage([&] { pathsOf(*world); }),
            (folder_ / "long.csv").string() + ": the trajectory has 80,000,000 ticks; expected at most 50,000,000");
}

}  // namespace
}  // namespace palpate::device
