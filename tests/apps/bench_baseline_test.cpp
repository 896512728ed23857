// The regression guard, `palpate bench --baseline`, from the outside.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::runPalpate;
using support::TemporaryFolder;

const std::string kQuick = " --guard-seconds 0";

class BenchBaseline : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const auto file = folder.path() / "baseline.json";
    std::ofstream(file) << text;
    return file.string();
  }
  /// A file that this machine wrote, every ratio multiplied.
  std::string measured(double factor) {
    const std::string file = (folder.path() / "baseline.json").string();
    EXPECT_EQ(runPalpate("bench --write-baseline " + file + " --guard-triangles 2962" + kQuick).exit_code, 0);
    auto json = nlohmann::json::parse(std::ifstream(file));
    for (auto& kernel : json["kernels"]) kernel["ratio"] = kernel["ratio"].get<double>() * factor;
    return write(json.dump());
  }
  TemporaryFolder folder;
};

TEST_F(BenchBaseline, SaysYesToWhatItCouldDoBefore) {
  const auto result = runPalpate("bench --baseline " + measured(100.0) + " --json" + kQuick);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(nlohmann::json::parse(result.out)["slower"].empty());
}

TEST_F(BenchBaseline, NamesEveryKernelThatGotSlower) {
  const auto result = runPalpate("bench --baseline " + measured(0.01) + " --json" + kQuick);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["slower"].size(), json["kernels"].size());
  EXPECT_GT(json["kernels"][0]["change"].get<double>(), 1.3);
  EXPECT_NE(runPalpate("bench --baseline " + measured(0.01) + kQuick).out.find("SLOWER"), std::string::npos);
}

TEST_F(BenchBaseline, RefusesAFileThatIsNone) {
  for (const char* text : {"", "[1, 2]", "{\"triangles\": 2962, \"kernels\": []}",
                           "{\"triangles\": 2962, \"kernels\": [{\"name\": \"weld\", \"ratio\": -1}]}",
                           "{\"triangles\": 3, \"kernels\": [{\"name\": \"weld\", \"ratio\": 1}]}"}) {
    const auto result = runPalpate("bench --baseline " + write(text) + kQuick);
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_NE(result.err.find("baseline.json"), std::string::npos) << result.err;
  }
}

/// Wide enough for another processor and a busy machine: only what became several times slower is caught here. Vectors
/// of another width alone make some kernels several times slower: there is a baseline for each.
TEST_F(BenchBaseline, OfThisProjectHolds) {
#ifndef NDEBUG
  GTEST_SKIP() << "the kept baseline is one of optimised builds";
#endif
  const auto here = nlohmann::json::parse(std::ifstream(measured(1.0)))["machine"]["simd"].get<std::string>();
  for (const char* kept : {"baseline.json", "baseline_avx2.json"}) {
    const std::string file = std::string(PALPATE_SOURCE_DIR "/bench/") + kept;
    if (nlohmann::json::parse(std::ifstream(file))["machine"]["simd"] != here) continue;
    const auto result = runPalpate("bench --baseline " + file + " --tolerance 3" + kQuick);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return;
  }
  GTEST_SKIP() << "no baseline is kept for " << here;
}

TEST_F(BenchBaseline, IsNotTheDefault) { EXPECT_EQ(runPalpate("bench").exit_code, 2); }

}  // namespace
}  // namespace palpate
