// `palpate lump` and the lumps of `palpate tissue solve` from the outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/tissue/layered_table.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;

class LumpCommand : public ::testing::Test {
 protected:
  CommandResult run(const std::string& arguments) const { return support::runPalpate(arguments, folder_.path()); }
  void refuses(const std::string& arguments, const std::string& words) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }

  const std::string layers_ = "--layer skin:2mm:150kPa --layer fat:8mm:10kPa --layer muscle:12mm:27kPa --no-drag ";
  support::TemporaryFolder folder_;
};

TEST_F(LumpCommand, ShowsWhatALumpAddsInALibraryPlaceAndInATable) {
  const CommandResult shown = run("lump show --diameter-mm 10 --depth-mm 3 --ratio 20 --json");
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  const auto json = nlohmann::json::parse(shown.out);
  EXPECT_NEAR(json["young_kpa"].get<double>(), 200.0, 1e-9);
  ASSERT_EQ(json["presses"].size(), 3u);
  EXPECT_NEAR(json["presses"][0]["share_percent"].get<double>(), 60.0, 3.0);
  EXPECT_NEAR(json["presses"][2]["share_percent"].get<double>(), 28.0, 2.0);

  ASSERT_EQ(run("tissue solve " + layers_ + "--depths 2:8:2 --field -o mine.json").exit_code, 0);
  EXPECT_TRUE(tissue::readLayeredTable(folder_ / "mine.json").field.has_value());
  const CommandResult mine = run("lump show --table mine.json --depth-mm 4 --diameter-mm 6");
  ASSERT_EQ(mine.exit_code, 0) << mine.err;
  EXPECT_NE(mine.out.find("8 mm"), std::string::npos);
}

TEST_F(LumpCommand, SolvesAPressOverALumpAndNoFieldUnlessAsked) {
  const CommandResult hard = run("tissue solve " + layers_ + "--depths 2,4 --lump 6mm:3mm:200kPa --json");
  const CommandResult none = run("tissue solve " + layers_ + "--depths 2,4 --json -o bare.json");
  ASSERT_EQ(hard.exit_code, 0) << hard.err;
  const auto with = nlohmann::json::parse(hard.out);
  const auto without = nlohmann::json::parse(none.out);
  EXPECT_GT(with["force_n"][1].get<double>(), 1.1 * without["force_n"][1].get<double>());
  EXPECT_GT(with["pressure_kpa"][1][0].get<double>(), 1.3 * without["pressure_kpa"][1][0].get<double>());
  refuses("lump show --table bare.json",
          "bare.json has no press field, which lumps require; make the table with palpate tissue solve --field");
}

TEST_F(LumpCommand, KnowsFlatLumps) {
  const auto extra_of = [&](const std::string& shape) {
    const CommandResult shown = run("lump show --depth-mm 3 --ratio 20 --json " + shape);
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    const auto json = nlohmann::json::parse(shown.out);
    EXPECT_EQ(json["bottom_mm"].get<double>(), shape.ends_with("2") ? 7.0 : 13.0) << shape;
    return json["presses"][1]["extra_n"].get<double>();
  };
  const double ball = extra_of("--half-axes-mm 5,5,5");
  EXPECT_EQ(ball, extra_of("--diameter-mm 10"));
  EXPECT_LT(extra_of("--half-axes-mm 5,5,2"), 0.8 * ball);
  refuses("lump show --half-axes-mm 5,5", "three numbers");
  refuses("lump show --half-axes-mm 5,4,3", "the first two half axes must be equal");

  const auto force_of = [&](const std::string& lump) {
    const CommandResult solved = run("tissue solve " + layers_ + "--depths 2 --json --lump " + lump);
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    return nlohmann::json::parse(solved.out)["force_n"][0].get<double>();
  };
  EXPECT_LT(force_of("6x3mm:3mm:200kPa"), 0.98 * force_of("6mm:3mm:200kPa"));
}

TEST_F(LumpCommand, RefusesInOneLine) {
  refuses("tissue solve " + layers_ + "--lump 6mm:3mm", "a lump is DIAMETER:DEPTH:MODULUS, such as 10mm:6mm:60kPa");
  refuses("tissue solve " + layers_ + "--lump 6mm:3mm:2s", "a lump is DIAMETER:DEPTH:MODULUS");
  refuses("lump show --depth-mm 2", "the top must be at least 0.5 mm below the skin layer");
  refuses("lump show --depth-mm 8 --thickness-mm 12", "reaches the bone");
  refuses("lump show --ratio 3 --young-kpa 30", "not both");
  refuses("lump check", "expected either --cases FILE or --solve SEED");
  refuses("lump check --cases nothing.json", "nothing.json");
}

}  // namespace
}  // namespace palpate
