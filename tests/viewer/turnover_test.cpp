#include "apps/viewer/turnover.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/mesh/files/save.h"
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
  const scene::Scene scene = sceneFromFile((folder / "ball.PLY").string(), like);
  EXPECT_EQ(scene.fingers[0].radius_mm, 5.0);
  EXPECT_TRUE(scene.dysfunctions.empty());
  EXPECT_EQ(scene::build(scene)->body_name, "ball.PLY");
}

TEST(SceneFromFile, NamesAFileThatCannotBeRead) {
  try {
    sceneFromFile("/no/such/thing.toml", {});
    FAIL() << "no such file";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/thing.toml"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace palpate::viewer
