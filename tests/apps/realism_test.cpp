// `palpate realism` and `palpate tissue library`, as a machine reads them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/elements/stack_solver.h"
#include "palpate/tissue/layered_library.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

TEST(RealismCommand, MeetsItsBarsOnSolvedPresses) {
  const std::filesystem::path cases = std::filesystem::path(PALPATE_TEST_DATA) / "golden/fem_profiles.json";
  const auto result = support::runPalpate("realism --json --cases " + cases.string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("cases").size(), 16u);
  EXPECT_EQ(json.at("left_out").size(), 4u);
  EXPECT_LE(json.at("normal_rms_worst").get<double>(), 0.015);
  EXPECT_LE(json.at("vector_rms_worst").get<double>(), 0.02);
  EXPECT_LE(json.at("force_error_worst").get<double>(), 0.1);
  EXPECT_LE(json.at("force_error_worst_from_2_mm").get<double>(), 0.1);
  EXPECT_LE(json.at("tangential_rms_worst").get<double>(), 0.03);
  EXPECT_GT(json.at("gaussian_worst").at("normal_rms").get<double>(), 0.05);
  EXPECT_GT(json.at("literal_worst").at("normal_rms").get<double>(), 0.7);
}

TEST(RealismCommand, SaysWhatIsWrongWithAFileOfCases) {
  const support::TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    std::ofstream(folder / "cases.json") << text;
    const auto result = support::runPalpate("realism --cases " + (folder / "cases.json").string());
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_NE(complaint("{").find("cases.json: not JSON"), std::string::npos);
  EXPECT_NE(complaint(R"({"r": [0, 1]})").find("\"cases\" must be a list"), std::string::npos);
  EXPECT_NE(complaint(R"({"r": [0, 1], "cases": [{"layers_mm_kPa": [[2, -1]]}]})").find("case 1"), std::string::npos);
  const std::string short_list = R"("depth": 2, "u0": 2, "force_N": 1, "uz": [1], "ur": [0])";
  EXPECT_NE(complaint(R"({"r": [0, 1], "cases": [{"layers_mm_kPa": [[9, 30]], )" + short_list + "}]}")
                .find("uz and ur must have 2 numbers"),
            std::string::npos);
}

TEST(TissueLibraryCommand, ListsPlacesThatGetSofterWithThickness) {
  const auto result = support::runPalpate("tissue library --json --fat-mm 8");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto places = nlohmann::json::parse(result.out).at("places");
  ASSERT_GE(places.size(), 6u);
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_LT(places[i].at("secant_n_per_mm").get<double>(), places[i - 1].at("secant_n_per_mm").get<double>());
  }
}

TEST(TissueLibrary, IsWhatTheSolverGives) {
  const double thickness = tissue::libraryThicknesses()[2];
  const double share = tissue::libraryFatShares()[1];
  elements::StackSettings settings;
  settings.press.depths_mm = {2, 5, 8};
  const auto solution = elements::solveStack(tissue::libraryStack(thickness, share), settings);
  const tissue::LayeredNode fresh = tissue::nodeOf(solution.press.table);
  const auto nodes = tissue::libraryNodes(share * (thickness - 2.0));
  const tissue::LayeredTissue shipped(nodes);
  for (std::size_t i = 0; i < fresh.depths_mm.size(); ++i) {
    EXPECT_NEAR(shipped.secantAt(thickness, fresh.depths_mm[i]) / fresh.secants[i], 1.0, 1e-3);
    const tissue::PressCurves curves = shipped.pressAt(thickness, fresh.depths_mm[i]);
    for (const double r : {2.0, 6.0, 12.0, 20.0}) {
      const auto down = [&](const tissue::PressCurves& of) {
        const double q = r / of.radius_mm;
        return tissue::curveAt(of.down, tissue::kPressBend, q * q).value;
      };
      EXPECT_NEAR(down(curves), down(fresh.presses[i]), 0.01) << r;
    }
  }
  EXPECT_NEAR(shipped.tangentialAt(thickness), fresh.tangential_over_normal, 1e-3);
}

}  // namespace
}  // namespace palpate
