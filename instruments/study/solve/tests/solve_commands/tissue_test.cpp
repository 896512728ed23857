// `palpate tissue` from the outside: what it says and draws of tables, and which it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::CommandResult;
using support::contentOf;

/// A dent of half a Gaussian's kind with a force of p = 1.5, made here and not by the library.
json tableOf(double fat_mm, double width_mm, double deepest_mm = 10.0) {
  json table = {{"palpate_layered_table", 1},
                {"stack",
                 {{"poisson", 0.48},
                  {"layers",
                   {{{"name", "skin"}, {"thickness_mm", 2.0}, {"young_kpa", 150.0}},
                    {{"name", "fat"}, {"thickness_mm", fat_mm}, {"young_kpa", 10.0}}}}}},
                {"indenter_radius_mm", 8.0}};
  std::vector<double> radii(61);
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = static_cast<double>(i);
  table["radii_mm"] = radii;
  for (const double depth : {0.25 * deepest_mm, 0.5 * deepest_mm, deepest_mm}) {
    std::vector<double> down, outward;
    for (const double r : radii) {
      down.push_back(std::exp(-r * r / (width_mm * width_mm)));
      outward.push_back(-0.01 * r * std::exp(-r / width_mm));
    }
    table["shapes"].push_back({{"depth_mm", depth},
                               {"surface_mm", depth},
                               {"force_n", 0.1 * std::pow(depth, 1.5)},
                               {"contact_radius_mm", 4.0},
                               {"down", down},
                               {"outward", outward}});
  }
  return table;
}

class TissueCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    write("thin.json", tableOf(4.0, 10.0));
    write("fat.json", tableOf(20.0, 18.0, 8.0));
  }
  void write(const std::string& name, const json& table) const { std::ofstream(folder_ / name) << table.dump(); }
  CommandResult tissue(const std::string& arguments) const {
    return support::runPalpate("tissue " + arguments, folder_.path());
  }
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = tissue(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "");
    return result.err;
  }
  /// Every text of the picture on a line of its own.
  std::string readSvgTexts(const std::string& arguments) const {
    const CommandResult result = tissue(arguments + " -o shown.svg");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string svg = contentOf(folder_ / "shown.svg");
    const std::size_t begin = svg.find("<desc>") + 6;
    return "\n" + svg.substr(begin, svg.find("</desc>") - begin);
  }

  support::TemporaryFolder folder_;
};

TEST_F(TissueCommand, ShowsTheNumbersOfATable) {
  const CommandResult result = tissue("show thin.json --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json shown = json::parse(result.out)["tables"].at(0);
  EXPECT_EQ(shown["name"], "thin");
  EXPECT_EQ(shown["total_mm"], 6.0);
  ASSERT_EQ(shown["shapes"].size(), 3u);
  const json& deepest = shown["shapes"][2];
  EXPECT_EQ(deepest["depth_mm"], 10.0);
  EXPECT_NEAR(deepest["secant_n_per_mm"].get<double>(), 0.1 * std::sqrt(10.0), 1e-9);
  EXPECT_NEAR(deepest["half_radius_mm"].get<double>(), 10.0 * std::sqrt(std::log(2.0)), 0.02);
  EXPECT_NEAR(deepest["tenth_radius_mm"].get<double>(), 10.0 * std::sqrt(std::log(10.0)), 0.02);
  EXPECT_NEAR(deepest["drawn_in_mm"].get<double>(), 10.0 * 0.1 / std::exp(1.0), 0.01);
  EXPECT_EQ(deepest["pushed_out_mm"], 0.0);
  EXPECT_TRUE(shown["drag"].is_null());
}

TEST_F(TissueCommand, ShowsThemForPeople) {
  const CommandResult result = tissue("show thin.json fat.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("thin: 2 x 150 + 4 x 10 (mm x kPa), 6 mm in all, sphere of 8 mm"), std::string::npos);
  EXPECT_NE(result.out.find("fat: 2 x 150 + 20 x 10"), std::string::npos);
  EXPECT_NE(result.out.find("N/mm"), std::string::npos);
}

TEST_F(TissueCommand, DrawsATableByDepth) {
  const std::string texts = readSvgTexts("show thin.json");
  for (const char* text : {"thin", "2.5 mm", "5 mm", "10 mm", "force (N)", "height of the skin (mm)",
                           "away from the axis (mm)", "radius of half the depth (mm)", "depth (mm)"}) {
    EXPECT_NE(texts.find("\n" + std::string(text) + "\n"), std::string::npos) << text << texts;
  }
  ASSERT_EQ(tissue("show thin.json -o shown.png").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "shown.png").substr(1, 3), "PNG");
}

TEST_F(TissueCommand, ComparesStacksAtTheDepthThatTheyShare) {
  const std::string texts = readSvgTexts("show thin.json fat.json --title Fat");
  EXPECT_NE(texts.find("The skin at 8 mm."), std::string::npos) << texts;
  EXPECT_NE(texts.find("fat: 2 x 150 + 20 x 10."), std::string::npos);
  EXPECT_NE(texts.find("\nFat\n"), std::string::npos);
  EXPECT_EQ(texts.find("\n2.5 mm\n"), std::string::npos) << "depths are no series here";
  EXPECT_NE(readSvgTexts("show thin.json fat.json --depth 3").find("The skin at 3 mm."), std::string::npos);
}

TEST_F(TissueCommand, NamesWhatItCannotShow) {
  EXPECT_EQ(runForError("show thin.json fat.json --depth 9"),
            "palpate: fat.json: has no shape at --depth 9; it covers 2 to 8 mm\n");
  EXPECT_EQ(runForError("show thin.json -o shown.jpg"), "palpate: shown.jpg: a plot's name must end in .png or .svg\n");
  EXPECT_NE(runForError("show none.json").find("none.json"), std::string::npos);
  json broken = tableOf(4.0, 10.0);
  broken["shapes"][1].erase("down");
  write("broken.json", broken);
  EXPECT_EQ(runForError("show broken.json"), "palpate: broken.json:1: has no \"down\"\n");
  EXPECT_NE(runForError("show").find("TABLE"), std::string::npos);
}

TEST_F(TissueCommand, ListsModuliWithTheirSources) {
  const CommandResult text = tissue("moduli");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  for (const char* words : {"skin", "fat", "muscle", "10.1186/s12891-017-1733-8", "represent no individual", "oiled"}) {
    EXPECT_NE(text.out.find(words), std::string::npos) << words;
  }
  const json listed = json::parse(tissue("moduli --json").out);
  double muscle_kpa = 0.0;
  for (const json& modulus : listed["moduli"]) {
    if (modulus["tissue"] == "muscle" && modulus["default"].get<bool>()) muscle_kpa = modulus["low_kpa"].get<double>();
  }
  EXPECT_EQ(muscle_kpa, 27.0);
  EXPECT_EQ(listed["friction_presets"][0]["kinetic"], 0.44);
}

}  // namespace
}  // namespace palpate
