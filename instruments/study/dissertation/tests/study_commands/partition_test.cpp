// `palpate study partition` and `palpate study bench partition` as a user runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {

using support::runPalpate;

namespace {

nlohmann::json jsonFrom(const std::string& arguments) {
  const support::CommandResult result = runPalpate(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST(PartitionCommand, DescribesTheTreeAndMissesNothingInTheBox) {
  for (const std::string tree : {"bsp", "octree"}) {
    for (const std::string assign : {"A", "B", "C"}) {
      const nlohmann::json json = jsonFrom("study partition back_2962 --tree " + tree + " --assign " + assign +
                                           " --threshold 128 --box 175,200,90,80 --json");
      EXPECT_EQ(json.at("triangles"), 2962);
      EXPECT_EQ(json.at("tree"), tree);
      EXPECT_EQ(json.at("assign"), assign);
      EXPECT_GT(json.at("leaves"), 10);
      EXPECT_GE(json.at("entries_per_triangle"), 1.0);
      const nlohmann::json& box = json.at("box");
      EXPECT_EQ(box.at("missed"), 0);
      EXPECT_GT(box.at("must"), 100);
      EXPECT_EQ(box.at("exact_triangles"), box.at("must"));
      EXPECT_GE(box.at("rendered_triangles"), box.at("must"));
      EXPECT_GE(box.at("rendered"), box.at("rendered_triangles"));
    }
  }
}

TEST(PartitionCommand, ComparesThePrintedTraversals) {
  const std::string box =
      "study partition back_2962 --tree bsp --threshold 128 --box=175,200,90,80 --json --traversal ";
  EXPECT_GT(jsonFrom(box + "else-if").at("box").at("missed"), 0);
  EXPECT_GE(jsonFrom(box + "half-space").at("box").at("rendered"), jsonFrom(box + "tight").at("box").at("must"));
  // A small sphere below the skin, inside a cell.
  const std::string small =
      "study partition back_2962 --tree bsp --threshold 128 --box=175,200,100,20 --json --traversal ";
  EXPECT_GT(jsonFrom(small + "sphere-corners").at("box").at("missed"), 0);
  EXPECT_EQ(jsonFrom(small + "sphere").at("box").at("missed"), 0);
}

TEST(PartitionCommand, SaysHowManyTrianglesThePrintedOctreeLoses) {
  EXPECT_GT(jsonFrom("study partition back_2962 --threshold 64 --octree-rule two-of-three --json").at("lost_triangles"),
            0);
  EXPECT_FALSE(jsonFrom("study partition back_2962 --json").contains("lost_triangles"));
}

TEST(PartitionCommand, TakesAQuarterOfTheLongestEdgeOrOfTheBox) {
  const std::string flat = "study partition flat100 --box 50,50,0 --json";
  EXPECT_NEAR(jsonFrom(flat).at("box").at("edges_mm").at(2).get<double>(), 25.0, 1e-6);
  EXPECT_EQ(jsonFrom(flat + " --box-size box").at("box").at("edges_mm").at(2), 0.0);  // E12
}

TEST(PartitionCommand, WritesColouredMeshes) {
  const support::TemporaryFolder folder;
  const auto result = runPalpate(
      "study partition back_2962 --threshold 128 --assign A --box 175,200,90 --leaf-colours leaves.ply "
      "--selection found.ply",
      folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* file : {"leaves.ply", "found.ply"}) {
    const std::string text = support::contentOf(folder.path() / file);
    EXPECT_TRUE(text.starts_with("ply")) << file;
    EXPECT_NE(text.find("property uchar red"), std::string::npos) << file;
  }
}

TEST(PartitionCommand, DrawsLeavesAndWhatTheBoxFinds) {
  const support::TemporaryFolder folder;
  const auto result =
      runPalpate("study partition back_2962 --threshold 256 --box 175,200,90 -o leaves.svg -o leaves.png --view back",
                 folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = support::contentOf(folder.path() / "leaves.svg");
  for (const char* text : {"leaves, a colour each", "boxes of the leaves", "triangles in the box", "meet the box",
                           "haptic detecting box", "threshold 256"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(support::contentOf(folder.path() / "leaves.png").substr(1, 3), "PNG");
}

TEST(PartitionCommand, NamesWhatIsWrong) {
  const auto expect_wrong = [](const std::string& arguments, const std::string& cause) {
    const support::CommandResult result = runPalpate("study partition " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_NE(result.err.find(cause), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  expect_wrong("nowhere.ply", "nowhere.ply");
  expect_wrong("no_such_name", "no_such_name");
  expect_wrong("back_2962 --tree quad", "bsp|octree");
  expect_wrong("back_2962 --threshold 0", "--threshold");
  expect_wrong("back_2962 --box 1,2", "x,y,z");
  expect_wrong("back_2962 --box 1,2,x", "--box: 'x' is not a number");
  expect_wrong("back_2962 --box 1,2,3,-4", "edge");
  expect_wrong("back_2962 --traversal else-if", "--tree bsp");
  expect_wrong("back_2962 --tree bsp --octree-rule two-of-three", "octree");
  expect_wrong("back_2962 --selection found.ply", "--box");
  expect_wrong("torso_many", "torso_N");
  expect_wrong("back_2962 -o leaves.jpg", ".png or .svg");
}

TEST(BenchPartitionCommand, PrintsTheFiguresOfTheBox) {
  const nlohmann::json json = jsonFrom("study bench partition --mesh back_2962 --ticks 300 --json");
  for (const char* key : {"hdb_query_us", "hybrid_us_per_tick", "bytes_per_triangle", "build_ns_per_triangle"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_GT(json.at("hdb_query_us").at("p50"), 0.0);
  EXPECT_GE(json.at("hdb_query_us").at("p99"), json.at("hdb_query_us").at("p50"));
  EXPECT_EQ(json.at("triangles"), 2962);
}

}  // namespace palpate
