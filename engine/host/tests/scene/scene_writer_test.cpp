#include "palpate/scene/scene_writer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "palpate/base/text.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene_file.h"
#include "support/error_message.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

namespace fs = std::filesystem;

/// What stands in the text after it was read and written once more: equal to it, if nothing was lost.
std::string again(const std::string& text, const fs::path& name = "scene.toml") {
  return sceneAsToml(parse(text, name.string()), fs::absolute(name).parent_path());
}

TEST(SceneWriter, WhatWasWrittenReadsBackTheSame) {
  Scene scene = load(support::sourceFolder() / "examples/scenes/default.toml");
  const std::string text = sceneAsToml(scene);
  EXPECT_EQ(again(text), text);
  const Scene read = parse(text, "again.toml");
  EXPECT_EQ(read.title, scene.title);
  ASSERT_EQ(read.fingers.size(), scene.fingers.size());
  EXPECT_EQ(read.fingers[0].steps.size(), scene.fingers[0].steps.size());
  EXPECT_EQ(read.fingers[0].steps[2].by_mm, scene.fingers[0].steps[2].by_mm);
  EXPECT_EQ(read.dysfunctions.at(0).change_percent, 60.0);
}

TEST(SceneWriter, KeepsEveryDigitAndEveryLetter) {
  Scene scene = load(support::sourceFolder() / "examples/scenes/default.toml");
  scene.title = "a \"quoted\" back\\slash, \xc3\xa4";
  scene.contact.finger.mu_static = 0.1 + 0.2;
  scene.contact.finger.mu_dynamic = 0.1;
  scene.dysfunctions.push_back({-1.0 / 3.0, 1e-9, 12.5, -100, 0});
  const Scene read = parse(sceneAsToml(scene), "again.toml");
  EXPECT_EQ(read.title, scene.title);
  EXPECT_EQ(read.contact.finger.mu_static, 0.1 + 0.2);
  EXPECT_EQ(read.dysfunctions.at(1).x_mm, -1.0 / 3.0);
  EXPECT_EQ(read.dysfunctions.at(1).y_mm, 1e-9);
}

TEST(SceneWriter, WritesOnlyWhatDiffersFromTheDefaults) {
  const std::string text = sceneAsToml(parse("[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n", "s.toml"));
  EXPECT_EQ(text, "\n[[finger]]\nname = \"a\"\nscript = [\n  { do = \"lift\", seconds = 1, height_mm = 10 },\n]\n");
}

TEST(SceneWriter, KeepsWhichErrataAreLiteral) {
  for (const char* words : {"corrected", "literal", "E14", "E14,E29"}) {
    Scene scene = load(support::sourceFolder() / "examples/scenes/default.toml");
    scene.fidelity = parseFidelity(words);
    EXPECT_EQ(wordsOf(parse(sceneAsToml(scene), "s.toml").fidelity), words);
  }
}

TEST(SceneWriter, NamesFilesRelativeToItsFolderWhereTheyLieInIt) {
  const support::TemporaryFolder folder;
  Scene scene = load(support::sourceFolder() / "examples/scenes/default.toml");
  scene.body.kind = BodyKind::mesh;
  scene.body.file = folder / "meshes" / "back.obj";
  scene.ellipses.key_points = "/elsewhere/keys.csv";
  const fs::path file = folder / "saved.toml";
  save(scene, file);
  const std::string text = readFile(file, 100000);
  EXPECT_NE(text.find("file = \"meshes/back.obj\""), std::string::npos) << text;
  const Scene read = load(file);
  EXPECT_EQ(fs::absolute(read.body.file).lexically_normal(), (folder / "meshes/back.obj").lexically_normal());
  EXPECT_EQ(read.ellipses.key_points, "/elsewhere/keys.csv");
}

TEST(SceneWriter, SaysWhichFileCannotBeWritten) {
  const std::string message = support::thrownMessage([] { save({}, "/dev/null/folder/scene.toml"); });
  EXPECT_NE(message.find("/dev/null/folder/scene.toml"), std::string::npos) << message;
}

}  // namespace
}  // namespace palpate::scene
