// `palpate tissue realism` and `palpate tissue library`, as a machine reads them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/elements/stack_solver.h"
#include "palpate/tissue/layered_library.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

TEST(RealismCommand, JudgesOnePress) {
  const std::filesystem::path golden = support::testData() / "golden/fem_profiles.json";
  auto cases = nlohmann::json::parse(support::contentOf(golden));
  std::erase_if(cases.at("cases").get_ref<nlohmann::json::array_t&>(), [](const nlohmann::json& one) {
    return one.at("name") != "bony" || one.at("depth") != 2.0;  // thin and shallow: a second of work
  });
  const support::TemporaryFolder folder;
  std::ofstream(folder / "one.json") << cases;
  const auto result = support::runPalpate("tissue realism --json --cases one.json", folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json.at("cases").size(), 1u);
  EXPECT_EQ(json.at("cases").at(0).at("name"), "bony");
  EXPECT_LE(json.at("force_error_worst_from_2_mm").get<double>(), 0.1);
  EXPECT_LE(json.at("tangential_rms_worst").get<double>(), 0.03);
}

// RealismBars: minutes of solving, in the second circle (tests/circles.tsv).

TEST(RealismBars, AreMetOnSolvedPresses) {
  const std::filesystem::path cases = support::testData() / "golden/fem_profiles.json";
  const auto result = support::runPalpate("tissue realism --json --cases " + cases.string());
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
    const auto result = support::runPalpate("tissue realism --cases " + (folder / "cases.json").string());
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

/// Made-up people; on solved stacks, so that few of them are solved.
constexpr const char* kLivingRows =
    "SubID,Location,Thickness,Skin,Fat,Total_Stiff\n"
    "1,LL_A,12,1,1.65,0.006\n"
    "2,LL_A,12,1,1.65,0.004\n"
    "3,LL_A,12,1,1.65,\n";

TEST(RealismBars, LivingLimbsAreComparedHalfByHalf) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "001_MasterList_indentation_orig.csv") << kLivingRows;
  const auto result = support::runPalpate("tissue realism --json --living " + folder.path().string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("people"), 2);
  EXPECT_EQ(json.at("left_out"), 1);
  EXPECT_EQ(json.at("half"), "even");
  EXPECT_EQ(json.at("tests"), 1);
  const double even = json.at("thin_cover_ratio").get<double>();
  const double odd = json.at("fitted_half").at("thin_cover_ratio").get<double>();
  EXPECT_NEAR(even / odd, 1.5, 0.01) << "the same layers, a third softer";
  EXPECT_NEAR(json.at("median_error_percent").get<double>(), 100.0 * std::abs(even - 1.0), 0.1);
  const auto& body = json.at("default_body");
  EXPECT_GT(body.at("even").at("thin_cover_ratio").get<double>(),
            json.at("default_moduli_on_a_limb").at("even").at("thin_cover_ratio").get<double>());
  EXPECT_EQ(json.at("ratio_by_cover").size(), 5u);
  EXPECT_EQ(json.at("sites").size(), 8u);
  const auto text = support::runPalpate("tissue realism --living " + folder.path().string());
  EXPECT_NE(text.out.find("2 presses of a probe on the limbs of 2 people; 1 rows"), std::string::npos) << text.out;
}

TEST(RealismCommand, RefusesAListOfLivingLimbsWithFileAndLine) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "list.csv") << "SubID,Location,Thickness,Skin,Fat,Total_Stiff\n1,LL_A,12,1,x,0.006\n";
  const auto result = support::runPalpate("tissue realism --living " + (folder / "list.csv").string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("list.csv:2: "), std::string::npos) << result.err;
  EXPECT_EQ(support::runPalpate("tissue realism --living " + (folder / "nothing").string()).exit_code, 2);
  EXPECT_EQ(support::runPalpate("tissue realism --living a.csv --cases b.json").exit_code, 2);
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
