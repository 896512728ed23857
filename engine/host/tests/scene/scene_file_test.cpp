#include "palpate/scene/scene_file.h"

#include <gtest/gtest.h>

#include <set>

#include "host/tests/scene/scene_text.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/scene_keys.h"
#include "support/error_message.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

TEST(SceneFile, HasOneMebibyteAtMost) {
  const support::TemporaryFolder folder;
  std::string text = "title = \"long\"\n#";
  text.resize(1'048'576, ' ');
  writeFile(folder / "scene.toml", text);
  EXPECT_EQ(load(folder / "scene.toml").title, "long");
  writeFile(folder / "scene.toml", text + " ");
  EXPECT_THROW(load(folder / "scene.toml"), Error);
}

TEST(SceneFile, TheSmallestSceneIsOneFingerWithAScript) {
  const Scene scene = parse(kFinger, "s.toml");
  EXPECT_EQ(scene.body.kind, BodyKind::trunk);
  EXPECT_EQ(scene.contact.finger.mu_static, 0.46);
  ASSERT_EQ(scene.fingers.size(), 1u);
  EXPECT_EQ(scene.fingers[0].steps[0].depth_mm, 8.0);
}

TEST(SceneFile, ReadsEveryKindOfValue) {
  const Scene scene = parse(R"(
title = "a scan"
seconds = 2
[body]
kind = "mesh"
file = "scan.obj"
unit = "cm"
repair = false
[[dysfunction]]
x_mm = 30
change_percent = -40
[[dysfunction]]
y_mm = -20.5
[output]
surfaces_at_s = [1, 2.5]
[safety]
passivity = false
[[finger]]
name = "thumb"
trajectory = "t.csv"
[[finger]]
name = "index"
at_mm = [0, 41]
script = [{ do = "drag", by_mm = [30, 0], seconds = 2 }, { do = "circle", radius_mm = 12, turns = -1.5 }]
)",
                            "folder/s.toml");
  EXPECT_EQ(scene.title, "a scan");
  EXPECT_EQ(scene.body.file, std::filesystem::path("folder/scan.obj"));
  EXPECT_EQ(millimetresOf(scene.body.unit), 10.0);
  EXPECT_FALSE(scene.body.repair);
  ASSERT_EQ(scene.dysfunctions.size(), 2u);
  EXPECT_EQ(scene.dysfunctions[0].change_percent, -40.0);
  EXPECT_EQ(scene.dysfunctions[1].y_mm, -20.5);
  EXPECT_EQ(scene.output.surfaces_at_s, (std::vector<double>{1.0, 2.5}));
  EXPECT_FALSE(scene.safety.passivity);
  EXPECT_EQ(scene.fingers[0].trajectory, std::filesystem::path("folder/t.csv"));
  EXPECT_EQ(scene.fingers[1].at_mm, Vec2(0, 41));
  EXPECT_EQ(scene.fingers[1].steps[0].by_mm, Vec2(30, 0));
  EXPECT_EQ(scene.fingers[1].steps[1].move, Move::circle);
  EXPECT_EQ(scene.fingers[1].steps[1].turns, -1.5);
}

TEST(SceneFile, ReadsForceLaws) {
  const auto law_of = [](const std::string& keys) { return parse("[tissue]\n" + keys + kFinger, "f/s.toml").tissue; };
  EXPECT_EQ(parse(kFinger, "s.toml").tissue.force_law.kind, tissue::ForceLaw::Kind::layered);
  const TissueSettings power = law_of("force_law = \"power\"\nexponent = 1.5\nreference_depth_mm = 6\n");
  EXPECT_EQ(power.force_law.kind, tissue::ForceLaw::Kind::power);
  EXPECT_EQ(power.force_law.exponent, 1.5);
  EXPECT_EQ(power.force_law.reference_depth_mm, 6.0);
  EXPECT_EQ(law_of("force_law = \"stiffening\"\nstiffening_ratio = 3\n").force_law.stiffening_ratio, 3.0);
  EXPECT_EQ(law_of("force_law = \"table\"\nforce_table = \"t.csv\"\n").force_table, std::filesystem::path("f/t.csv"));
}

TEST(SceneFile, AForceTableAndItsLawNeedEachOther) {
  EXPECT_EQ(messageFor("[tissue]\nforce_law = \"table\"\n" + kFinger),
            "s.toml:1: [tissue] law \"table\" requires a force_table");
  EXPECT_EQ(messageFor("[tissue]\nforce_table = \"t.csv\"\n" + kFinger),
            "s.toml:1: [tissue] has a force_table but its force_law is not \"table\"");
}

TEST(SceneFile, ReadsTheDetectingBoxAsContactSource) {
  EXPECT_EQ(parse(kFinger, "s.toml").contact.source, ContactSource::surface);
  const Scene scene = parse(R"(
[contact]
source = "hdb"
[partition]
tree = "bsp"
assign = "A"
threshold = 200
hdb_edge_mm = 80
query = "coherent"
traversal = "half-space"
refresh_s = 0.03
)" + kFinger,
                            "s.toml");
  EXPECT_EQ(scene.contact.source, ContactSource::hdb);
  EXPECT_EQ(scene.partition.build.tree, hdb::TreeKind::Bsp);
  EXPECT_EQ(scene.partition.build.assignment, hdb::Assignment::Cut);
  EXPECT_EQ(scene.partition.build.threshold, 200u);
  EXPECT_EQ(scene.partition.hdb_edge_mm, 80.0);
  EXPECT_EQ(scene.partition.query, hdb::HdbQuery::coherent);
  EXPECT_EQ(scene.partition.traversal, hdb::LiteralTraversal::HalfSpace);
  EXPECT_EQ(scene.partition.refresh_s, 0.03);
}

TEST(SceneFile, SuggestsTheNearestKey) {
  support::expectEach(
      messageWithFinger,
      {{"[friction]\nstatik = 0.5\n", "s.toml:2: unknown key 'statik' in [friction]; did you mean 'static'?"},
       {"[[dysfunction]]\nradius_cm = 2\n",
        "s.toml:2: unknown key 'radius_cm' in [[dysfunction]]; did you mean 'radius_mm'?"},
       {"[fricton]\nstatic = 0.5\n", "s.toml:1: unknown key 'fricton'; did you mean 'friction'?"},
       {"[output]\nbanana = 1\n", "s.toml:2: unknown key 'banana' in [output]; known: surfaces_at_s, forces"}});
  EXPECT_EQ(messageFor("[[finger]]\nname = \"a\"\nscript = [{ do = \"press\", by_mm = [1, 2] }]\n"),
            "s.toml:3: unknown key 'by_mm' in [[finger]] script press; known: do, seconds, depth_mm");
}

TEST(SceneFile, NamesWrongTypesAndRanges) {
  support::expectEach(
      messageWithFinger,
      {{"[friction]\nstatic = \"0.46\"\n", "s.toml:2: [friction] static must be a number, not a text"},
       {"[friction]\nstatic = -1\n", "s.toml:2: [friction] static = -1 is out of range: 0 to 5"},
       {"[stiffness]\nconstant_n_per_mm = 0\n",
        "s.toml:2: [stiffness] constant_n_per_mm = 0 is out of range: above 0 and at most 100"},
       {"[stiffness]\nconstant_n_per_mm = nan\n", "s.toml:2: [stiffness] constant_n_per_mm must be finite"},
       {"[contact]\nforce_shading = 1\n", "s.toml:2: [contact] force_shading must be true or false, not a number"},
       {"[body]\nkind = \"tors\"\n",
        "s.toml:2: [body] kind must be \"trunk\" or \"torso\" or \"back\" or \"mesh\", not \"tors\"; did you mean "
        "\"torso\"?"},
       {"title = 5\n", "s.toml:1: title must be a text in quotes, not a number"},
       {"[output]\nsurfaces_at_s = 3\n", "s.toml:2: [output] surfaces_at_s must be a list of numbers, not a number"},
       {"[output]\nsurfaces_at_s = [1, \"2\"]\n", "s.toml:2: [output] surfaces_at_s must be a number, not a text"}});
  EXPECT_EQ(messageFor("[[finger]]\nname = \"a\"\nat_mm = [1, 2, 3]\nscript = [{ do = \"hold\" }]\n"),
            "s.toml:3: [[finger]] at_mm must be 2 numbers, not 3");
  EXPECT_EQ(messageFor("[dysfunction]\nx_mm = 1\n" + kFinger),
            "s.toml:1: [[dysfunction]] must be written with two brackets");
}

TEST(SceneFile, NeedsNoFingersForAWorldButForARun) {
  const Scene scene = parse("title = \"nobody\"\n", "s.toml");
  EXPECT_TRUE(scene.fingers.empty());
  EXPECT_EQ(support::thrownMessage([&] { requireFingers(scene); }), "s.toml: has no [[finger]]; add at least one");
  EXPECT_NO_THROW(requireFingers(parse(kFinger, "s.toml")));
}

TEST(SceneFile, NamesWhatIsMissingOrContradicts) {
  support::expectEach(messageWithFinger,
                      {{"[body]\nkind = \"mesh\"\n", "s.toml:1: [body] of kind \"mesh\" requires a file"},
                       {"[body]\nfile = \"a.obj\"\n", "s.toml:1: [body] has a file but is not of kind \"mesh\""},
                       {"[friction]\nstatic = 0.3\n", "s.toml:1: [friction] dynamic must not be above static"}});
  EXPECT_EQ(messageFor("[[finger]]\ntrajectory = \"a.csv\"\nscript = [{ do = \"hold\" }]\n"),
            "s.toml:1: [[finger]] takes a trajectory or a script, not both");
  EXPECT_EQ(messageFor("[[finger]]\nname = \"a,b\"\nscript = [{ do = \"hold\" }]\n"),
            "s.toml:1: [[finger]] name may contain only letters, digits, '-' and '_'");
  EXPECT_EQ(messageFor(kFinger + kFinger), "s.toml:4: a [[finger]] named 'index' already exists; names must be unique");
  EXPECT_EQ(messageFor("[[finger]]\nname = \"a\"\nscript = [{ seconds = 1 }]\n"),
            "s.toml:3: [[finger]] script needs do = \"press\" or \"hold\" or \"drag\" or \"circle\" or \"lift\"");
}

TEST(SceneFile, AFingerOverAPlacePressesItAndLifts) {
  for (const char* place : {"at = \"T6 right 30 mm\"", "at_mm = [30, 41]"}) {
    const Scene scene = parse(std::string("[[finger]]\n") + place + "\n", "s.toml");
    ASSERT_EQ(scene.fingers.size(), 1u);
    EXPECT_EQ(scene.fingers[0].name, "index");
    ASSERT_EQ(scene.fingers[0].steps.size(), 2u);
    EXPECT_EQ(scene.fingers[0].steps[0].move, Move::press);
    EXPECT_EQ(scene.fingers[0].steps[1].move, Move::lift);
  }
  EXPECT_TRUE(parse("[[finger]]\nradius_mm = 8\n", "s.toml").fingers[0].hasAutomaticPath());
}

TEST(SceneFile, FingersWithoutANameHaveThoseOfAHandThatAreFree) {
  const Scene scene = parse("[[finger]]\n[[finger]]\nname = \"index\"\n[[finger]]\n", "s.toml");
  EXPECT_EQ(scene.fingers[0].name, "middle");
  EXPECT_EQ(scene.fingers[1].name, "index");
  EXPECT_EQ(scene.fingers[2].name, "ring");
  std::string eight;
  for (int i = 0; i < 8; ++i) eight += "[[finger]]\n";
  EXPECT_EQ(parse(eight, "s.toml").fingers[7].name, "finger8");
}

TEST(SceneFile, NamesTheLineOfWhatIsNotToml) {
  EXPECT_EQ(messageFor("title = \"a\"\n[friction\n").substr(0, 9), "s.toml:2:");
  EXPECT_EQ(messageFor("title = \"a\"\ntitle = \"b\"\n").substr(0, 9), "s.toml:2:");
  EXPECT_EQ(messageFor("title = \"a\\nb\"\n" + kFinger), "s.toml:1: title must be one line of plain text");
  const std::string cut_short = messageFor("[output]\nforces = fal\n" + kFinger);
  EXPECT_EQ(cut_short.find("s.toml:2: "), 0u);
  EXPECT_EQ(cut_short.find('\n'), std::string::npos) << "the parser quotes the line end";
  EXPECT_THROW(load("no/such.toml"), Error);
}

TEST(SceneFile, AMeshIsToldApartFromAScene) {
  try {
    load("scan.OBJ");
    ADD_FAILURE() << "a mesh is not a scene";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "scan.OBJ: is a mesh, not a scene; name it in a scene with file = \"...\" in [body]");
  }
}

/// A value of the wrong type for each kind of key.
std::string wrongValueFor(const KeyRow& row) {
  const bool takes_text = row.takes.starts_with("text") || row.takes.starts_with("file") || row.takes.starts_with("\"");
  return takes_text ? "7" : "\"8 mm\"";
}

TEST(SceneFile, EveryKeyRefusesAWrongTypeByNameAndLine) {
  for (const KeyRow& row : describeKeys()) {
    if (row.table.starts_with("script")) continue;
    const std::string header = row.table.empty() ? "#" : row.table;
    const std::string message = messageFor(header + "\n" + row.key + " = " + wrongValueFor(row) + "\n");
    EXPECT_EQ(message.find("s.toml:2: " + (row.table.empty() ? "" : row.table + " ") + row.key + " must be"), 0u)
        << row.table << " " << row.key << ": " << message;
  }
}

TEST(SceneFile, EveryKeyWithARangeRefusesWhatIsFarOutside) {
  for (const KeyRow& row : describeKeys()) {
    if (row.table.starts_with("script") || !row.takes.starts_with("number,")) continue;
    const std::string header = row.table.empty() ? "#" : row.table;
    const std::string message = messageFor(header + "\n" + row.key + " = -1e200\n");
    EXPECT_NE(message.find(row.key + " = -1e+200 is out of range: "), std::string::npos) << message;
  }
}

TEST(SceneFile, EveryDefaultInTheTableIsAcceptedWhenWrittenOut) {
  for (const KeyRow& row : describeKeys()) {
    if (row.table.starts_with("script") || row.table == "[[finger]]" || row.fallback.empty()) continue;
    const std::string named = row.table == "[[device]]" ? "name = \"remote\"\n" : "";
    const std::string toml =
        (row.table.empty() ? "" : row.table + "\n" + named) + row.key + " = " + row.fallback + "\n" + kFinger;
    EXPECT_EQ(messageFor(toml), "no error") << toml;
  }
}

TEST(SceneFile, PrintsARowOfEveryKeyAndCountsThem) {
  const std::vector<KeyRow> rows = describeKeys();
  EXPECT_EQ(rows.size(), kSceneKeys);
  const std::string page = keysAsMarkdown();
  for (const KeyRow& row : rows) EXPECT_NE(page.find("\n| `" + row.key + "` | "), std::string::npos) << row.key;
  EXPECT_NE(page.find("\n### `[body]`\n\nThe body that is touched.\n\n| key | takes | default | meaning |\n"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::scene
