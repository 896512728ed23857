// A recording carries every file that its scene names.
#include "palpate/engine/recording_bundle.h"

#include <gtest/gtest.h>

#include <fstream>

#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "support/temporary_folder.h"

namespace palpate::engine {
namespace {

TEST(RecordingBundle, KnowsEveryKeyThatNamesAFile) {
  scene::Scene scene;
  scene.fingers.resize(1);
  scene.profiles.resize(1);
  scene.body.kind = scene::BodyKind::mesh;
  std::size_t named = 0;
  for (const NamedFile& file : namedFiles(scene)) *file.place = "/elsewhere/" + std::to_string(++named);
  std::size_t keys = 0;
  for (const scene::KeyRow& row : scene::describeKeys()) keys += row.form.kind == scene::KeyForm::Kind::file ? 1 : 0;
  EXPECT_EQ(named, keys) << "a new key of the scene file that names a file must be carried, too";
  const std::string toml = scene::sceneAsToml(scene, "/");
  for (std::size_t i = 1; i <= named; ++i) {
    EXPECT_NE(toml.find("\"elsewhere/" + std::to_string(i) + "\""), std::string::npos) << i << "\n" << toml;
  }
}

TEST(RecordingBundle, KnowsWhatAGltfFileIsNotWholeWithout) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "back.gltf")
      << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"data:application/octet-stream;base64,AAAA","byteLength":3},)"
      << R"({"uri":"parts/back%201.bin","byteLength":3}],"images":[{"uri":"skin.png"},{"bufferView":0}]})";
  std::vector<std::string> names;
  for (const auto& file : mesh::filesBeside(folder / "back.gltf")) {
    names.push_back(file.lexically_normal().lexically_relative(folder.path()).string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"parts/back 1.bin", "skin.png"}));
  std::ofstream(folder / "back.obj") << "v 0 0 0\n";
  EXPECT_TRUE(mesh::filesBeside(folder / "back.obj").empty());
}

}  // namespace
}  // namespace palpate::engine
