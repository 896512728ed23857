#include "palpate/scene/scene_writer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "palpate/base/text.h"
#include "palpate/scene/scene_edit.h"
#include "palpate/scene/scene_file.h"
#include "support/places.h"

namespace palpate::scene {
namespace {

namespace fs = std::filesystem;

/// A person's file: comments everywhere, an odd layout, letters of two bytes before a value.
constexpr const char* kByHand = R"(# My back,  2024
title = "R\u00fccken äö"   # keep me

  # friction as measured
[friction]
static =   0.5     # of dry skin
# dynamic stays

[[dysfunction]]   # the first
x_mm = 3

# about the second
[[dysfunction]]
x_mm = 4
radius_mm = 7 # seven

[[finger]]
name = "a"
script = [
  { do = "lift" }, # up
]
)";
const std::string kText = kByHand;

/// The file after the changes, as patched; fails the test if it is not.
template <class Change>
std::string changed(const std::string& text, const Change& change) {
  Scene scene = parse(text, "scene.toml");
  change(scene);
  const auto patched = patchedScene(text, scene, "scene.toml");
  EXPECT_TRUE(patched);
  return patched.value_or("");
}

TEST(ScenePatch, LeavesAFileThatSaysTheSameAsItIs) {
  EXPECT_EQ(changed(kText, [](Scene&) {}), kText);
  for (const char* name : {"default.toml", "dissertation_contact.toml"}) {
    const fs::path file = support::sourceFolder() / "examples/scenes" / name;
    const std::string text = readFile(file, kMaxSceneBytes);
    EXPECT_EQ(patchedScene(text, load(file), file), text) << name;
  }
}

TEST(ScenePatch, TouchesOnlyTheLineOfAChangedKey) {
  std::string expected = kText;
  expected.replace(expected.find("0.5 "), 3, "0.75");
  EXPECT_EQ(changed(kText, [](Scene& s) { s.contact.finger.mu_static = 0.75; }), expected);
  expected = kText;
  const std::size_t from = expected.find("\"R");
  expected.replace(from, expected.find("   # keep") - from, "\"new\"");
  EXPECT_EQ(changed(kText, [](Scene& s) { s.title = "new"; }), expected);
}

TEST(ScenePatch, AddsAKeyToItsTableAndATableToTheEnd) {
  const std::string text = changed(kText, [](Scene& s) {
    s.seconds = 4;
    setKey(s, "friction", "dynamic", "0.25");
    setKey(s, "stiffness", "constant_n_per_mm", "0.8");
  });
  EXPECT_NE(text.find("# keep me\nseconds = 4\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# of dry skin\ndynamic = 0.25\n# dynamic stays\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("]\n\n[stiffness]\nconstant_n_per_mm = 0.8\n")) << text;
}

TEST(ScenePatch, AKeyBeforeTheFirstTableStaysBelowTheFilesOwnHead) {
  const std::string text = "# head\n\n# about friction\n[friction]\nstatic = 0.5\n";
  EXPECT_EQ(changed(text, [](Scene& s) { s.seconds = 2; }),
            "# head\n\nseconds = 2\n# about friction\n[friction]\nstatic = 0.5\n");
}

TEST(ScenePatch, TheRightOneOfSeveralTablesIsChangedAddedOrTakenAway) {
  std::string text = changed(kText, [](Scene& s) { s.dysfunctions.erase(s.dysfunctions.begin()); });
  EXPECT_EQ(text.find("x_mm = 3"), std::string::npos) << text;
  EXPECT_NE(text.find("# about the second\n[[dysfunction]]\nx_mm = 4\nradius_mm = 7 # seven"), std::string::npos)
      << text;
  text = changed(kText, [](Scene& s) { s.dysfunctions[1].radius_mm = 9; });
  EXPECT_NE(text.find("radius_mm = 9 # seven"), std::string::npos) << text;
  text = changed(kText, [](Scene& s) {
    s.dysfunctions.push_back(s.dysfunctions[1]);
    s.dysfunctions[2].x_mm = -8;
  });
  EXPECT_NE(text.find("# seven\n\n[[dysfunction]]\nx_mm = -8\nradius_mm = 7\n"), std::string::npos) << text;
  text = changed(kText, [](Scene& s) { s.dysfunctions.clear(); });
  EXPECT_NE(text.find("# about the second"), std::string::npos) << "lines of comment alone stay";
}

TEST(ScenePatch, AValueThatIsLeftOutAgainTakesItsLineAlong) {
  const std::string text = "[view]\nlook_at_mm = [\n 1, 2, # here\n 3 ]\nzoom = 2\n";
  EXPECT_EQ(changed(text, [](Scene& s) { s.view.look_at_mm.reset(); }), "[view]\nzoom = 2\n");
}

TEST(ScenePatch, AFileWithoutALastLineBreakIsNoTrap) {
  EXPECT_EQ(changed("seconds = 1", [](Scene& s) { s.title = "t"; }), "seconds = 1\ntitle = \"t\"\n");
}

TEST(ScenePatch, FilesOfAnotherFolderAreFoundFromThereToo) {
  const std::string text = "[body]\nkind = \"mesh\"\nfile = \"back.obj\" # mine\n";
  const Scene scene = parse(text, "/here/scene.toml");
  const auto moved = patchedScene(text, scene, "/there/scene.toml");
  ASSERT_TRUE(moved);
  EXPECT_NE(moved->find("file = \"/here/back.obj\" # mine"), std::string::npos) << *moved;
}

TEST(ScenePatch, SaysSoWhenATextCannotBePatched) {
  Scene scene;
  scene.contact.finger.mu_static = 0.9;
  EXPECT_FALSE(patchedScene("friction = [", scene, "s.toml"));
  EXPECT_FALSE(patchedScene("friction.stiffness_ratio = 1\n", scene, "s.toml"));
  EXPECT_TRUE(patchedScene("friction = { static = 0.8 } # inline\n", scene, "s.toml"));
}

}  // namespace
}  // namespace palpate::scene
