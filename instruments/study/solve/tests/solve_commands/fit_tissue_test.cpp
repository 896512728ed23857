// `palpate tissue fit` from the outside: measured curves in, laws and tables out.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "palpate/tissue/user_profile.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::CommandResult;
using support::contentOf;

/// Rows of k, p and noise of so much of each force, after the words of a first column.
std::string powerRows(const std::string& first, double k, double p, unsigned seed, double noise = 0.05) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::string rows;
  for (int i = 1; i <= 40; ++i) {
    const double depth = 0.25 * i;
    const double force = 8.0 * k * std::pow(depth / 8.0, p) * (1.0 + noise * normal(engine));
    rows += first + std::to_string(depth) + "," + std::to_string(force) + "\n";
  }
  return rows;
}

class FitCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    write("one.csv", "depth_mm,force_n\n" + powerRows("", 0.4, 1.6, 1));
    write("places.csv", "place,depth_mm,force_n\n" + powerRows("T6,", 0.2, 1.5, 2) + powerRows("L3,", 0.4, 1.8, 3) +
                            powerRows("L5,", 0.6, 1.7, 4));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CommandResult fit(const std::string& arguments) const {
    return support::runPalpate("tissue fit " + arguments, folder_.path());
  }
  json runForJson(const std::string& arguments) const {
    const CommandResult result = fit(arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  /// A scene with these keys is felt.
  void expectScene(const std::string& keys) const {
    write("scene.toml", keys +
                            "[body]\nkind = \"torso\"\n[[finger]]\nname = \"index\"\nat = \"T6\"\nscript = [{ do = "
                            "\"press\", depth_mm = 4, seconds = 0.05 }]\n");
    const auto simulated =
        support::runPalpate("simulate scene.toml --seconds 0.05 --no-pictures -o out --overwrite", folder_.path());
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err << keys;
  }
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = fit(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(!result.err.empty() && result.err.find('\n') == result.err.size() - 1) << "one line: " << result.err;
    return result.err;
  }

  support::TemporaryFolder folder_;
};

using FitForce = FitCommand;

TEST_F(FitForce, FindsTheExponentOfANoisyPowerCurve) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const double p = 1.0 + 0.35 * seed;
    write("noisy.csv", powerRows("", 0.5, p, seed));
    const json found = runForJson("force noisy.csv");
    EXPECT_NEAR(found["p"].get<double>(), p, 0.05);
    EXPECT_NEAR(found["k_n_per_mm"].get<double>(), 0.5, 0.03);
    if (p < 2.2) {
      EXPECT_EQ(found["best"], "power") << "steeper ones look like a cube";
    }
    EXPECT_LT(found["p_standard_error"].get<double>(), 0.05);
  }
}

TEST_F(FitForce, TellsEveryFormAndTheKeysOfAScene) {
  const CommandResult result = fit("force one.csv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"one.csv: 40 rows, 10 mm deep", "linear", "power", "stiffening", "cubic", "measured",
        "force_law = \"power\"\nexponent = 1.", "[stiffness]\nsource = \"constant\"", "constant_n_per_mm = 0.3"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << result.out;
  }
}

TEST_F(FitForce, WritesATableThatASceneReads) {
  const json found = runForJson("force one.csv --form measured -o law.csv");
  EXPECT_EQ(found["written"].at(0), "law.csv");
  EXPECT_NE(found["scene"].get<std::string>().find("force_table = \"law.csv\""), std::string::npos);
  const tissue::ForceTable table = tissue::readForceTable(folder_ / "law.csv");
  ASSERT_GT(table.rows, 10u);
  for (std::uint32_t i = 0; i < table.rows; ++i) {
    const double force = 3.2 * std::pow(table.depth_mm[i] / 8.0, 1.6);
    EXPECT_NEAR(table.effective_mm[i], force, 0.12 * force) << table.depth_mm[i];
  }
  expectScene(found["scene"].get<std::string>());
}

TEST_F(FitForce, FitsEveryPlaceAndAllTogether) {
  const json found = runForJson("force places.csv");
  ASSERT_EQ(found["curves"].size(), 3u);
  EXPECT_EQ(found["curves"][1]["curve"], "L3");
  const json& power = found["curves"][1]["fits"][1];
  EXPECT_EQ(power["form"], "power");
  EXPECT_NEAR(power["numbers"]["exponent"]["value"].get<double>(), 1.8, 0.05);
  EXPECT_NEAR(found["spread"]["exponent"]["median"].get<double>(), 1.7, 0.05);
  EXPECT_NEAR(found["p"].get<double>(), 1.67, 0.06) << "one shape for all";
  const json alone = runForJson("force places.csv --curve L3");
  EXPECT_EQ(alone["curves"].size(), 1u);
  EXPECT_NEAR(alone["p"].get<double>(), 1.8, 0.05);
}

TEST_F(FitForce, DrawsRowsLawsAndMisses) {
  for (const char* file : {"one.csv", "places.csv"}) {
    ASSERT_EQ(fit(std::string("force ") + file + " --plot fit.svg").exit_code, 0);
    const std::string svg = contentOf(folder_ / "fit.svg");
    EXPECT_NE(svg.find("measured"), std::string::npos);
    EXPECT_NE(svg.find("(mm)"), std::string::npos);
  }
}

TEST_F(FitForce, NamesTheLineOfWhatItCannotRead) {
  write("typo.csv", "depth_mm,force_n\n1,2\n2,three\n");
  EXPECT_EQ(runForError("force typo.csv"), "palpate: typo.csv:3: force_n is not a number: 'three'\n");
  write("short.csv", "1,2\n2,3\n");
  EXPECT_EQ(runForError("force short.csv"),
            "palpate: short.csv: the curve has 2 depths below the skin; at least 4 are required\n");
  EXPECT_EQ(runForError("force places.csv --curve L4"),
            "palpate: places.csv: unknown curve 'L4'; did you mean 'L3'?\n");
  EXPECT_EQ(runForError("force one.csv --plot fit.jpg"), "palpate: fit.jpg: a plot's name must end in .png or .svg\n");
  EXPECT_NE(runForError("force one.csv --form cubik").find("did you mean 'cubic'?"), std::string::npos);
  EXPECT_NE(runForError("force none.csv").find("none.csv"), std::string::npos);
}

class FitProfile : public FitCommand {
 protected:
  void SetUp() override { write("skin.csv", places(0.0, 0.0)); }

  /// Two depths with a bulge, from a radius on.
  static std::string places(double from_mm, double noise_mm) {
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    std::string text = "depth_mm,r_mm,down_mm,outward_mm\n";
    for (const double depth : {3.0, 9.0}) {
      for (double r = from_mm; r <= 60.0; r += 0.5) {
        const double down = depth * (1.2 * std::exp(-r * r / 64.0) - 0.2 * std::exp(-r * r / 400.0));
        const double outward = -0.05 * depth * r / 10.0 * std::exp(0.5 - r * r / 200.0);
        text += std::to_string(depth) + "," + std::to_string(r) + "," +
                std::to_string(down + noise_mm * normal(engine)) + "," +
                std::to_string(outward + noise_mm * normal(engine)) + "\n";
      }
    }
    return text;
  }
};

TEST_F(FitProfile, WritesATableOfLayeredTissue) {
  write("force.csv", "depth_mm,force_n\n" + powerRows("", 0.4, 1.6, 1, 0.0));
  const json found =
      runForJson("profile --data skin.csv --forces force.csv --layer skin:2:150 --layer fat:8:10 -o t.json");
  EXPECT_LT(found["rms_worst"].get<double>(), 0.002);
  EXPECT_EQ(found["written"].at(0), "t.json");
  const json table = json::parse(contentOf(folder_ / "t.json"));
  EXPECT_EQ(table["stack"]["layers"][1]["young_kpa"], 10.0);
  ASSERT_EQ(table["shapes"].size(), 2u);
  EXPECT_NEAR(table["shapes"][1]["force_n"].get<double>(), 3.2 * std::pow(9.0 / 8.0, 1.6), 0.02);
  EXPECT_NEAR(table["shapes"][1]["surface_mm"].get<double>(), 9.0, 0.01);
  EXPECT_NEAR(table["shapes"][1]["down"][20].get<double>(), 1.2 * std::exp(-100.0 / 64.0) - 0.2 * std::exp(-0.25),
              0.01);
  EXPECT_NEAR(table["shapes"][1]["outward"][20].get<double>(), -0.05, 0.003);
  EXPECT_EQ(support::runPalpate("tissue show t.json", folder_.path()).exit_code, 0) << "others read it";
}

TEST_F(FitProfile, SeesThroughNoise) {
  write("noisy.csv", places(9.0, 0.1));
  const json found = runForJson("profile noisy.csv -o t.json");
  EXPECT_EQ(found["chosen"], "two_gaussians");
  EXPECT_FALSE(found["depths"][1]["fits"][2]["surface_measured"].get<bool>());
  const json numbers = found["depths"][1]["fits"][2]["numbers"];
  EXPECT_NEAR(numbers["narrow_mm"]["value"].get<double>(), 8.0, 0.8);
  const json table = json::parse(contentOf(folder_ / "t.json"));
  EXPECT_NEAR(table["shapes"][1]["down"][20].get<double>(), 1.2 * std::exp(-100.0 / 64.0) - 0.2 * std::exp(-0.25),
              0.02);
}

TEST_F(FitProfile, WritesAProfileThatASceneReads) {
  const CommandResult result = fit("profile --data skin.csv --profile own.csv --plot fit.svg");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(contentOf(folder_ / "fit.svg").find("one curve for all depths"), std::string::npos);
  const std::size_t keys = result.out.find("[deformation]");
  ASSERT_NE(keys, std::string::npos) << result.out;
  expectScene(result.out.substr(keys, result.out.find("->") - keys));
}

TEST_F(FitProfile, WritesATableThatASceneTakesForItsLayers) {
  write("force.csv", "depth_mm,force_n\n" + powerRows("", 0.4, 1.6, 1, 0.0));
  const CommandResult result =
      fit("profile skin.csv --forces force.csv --layer skin:2:150 --layer fat:20:10 -o t.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::size_t keys = result.out.find("[tissue]");
  ASSERT_NE(keys, std::string::npos) << result.out;
  expectScene(result.out.substr(keys, result.out.find("\none curve") - keys));
  EXPECT_NE(fit("profile skin.csv -o t.json").out.find("needs --forces and --layer"), std::string::npos);
}

TEST_F(FitProfile, NamesTheLineOfWhatItCannotRead) {
  write("typo.csv", "depth_mm,r_mm,down_mm\n1,0,x\n");
  EXPECT_EQ(runForError("profile typo.csv"), "palpate: typo.csv:2: down_mm is not a number: 'x'\n");
  write("short.csv", "depth_mm,r_mm,down_mm\n1,0,1\n1,5,0\n");
  EXPECT_EQ(runForError("profile short.csv"),
            "palpate: short.csv: depth 1 mm: 2 different radii; at least 6 are required\n");
  EXPECT_NE(runForError("profile skin.csv --layer skin").find("expected NAME:THICKNESS:MODULUS"), std::string::npos);
  write("two.csv", "curve,depth_mm,force_n\na,1,1\nb,1,1\n");
  EXPECT_EQ(runForError("profile skin.csv --forces two.csv"),
            "palpate: two.csv: holds several curves; expected one, for a table of tissue\n");
}

}  // namespace
}  // namespace palpate
