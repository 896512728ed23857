// The regression guard, `palpate study bench --baseline`, from the outside.
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
    EXPECT_EQ(runPalpate("study bench --write-baseline " + file + " --guard-triangles 2962" + kQuick).exit_code, 0);
    auto json = nlohmann::json::parse(std::ifstream(file));
    for (auto& kernel : json["kernels"]) kernel["ratio"] = kernel["ratio"].get<double>() * factor;
    return write(json.dump());
  }
  TemporaryFolder folder;
};

TEST_F(BenchBaseline, SaysYesToWhatItCouldDoBefore) {
  const auto result = runPalpate("study bench --baseline " + measured(100.0) + " --json" + kQuick);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(nlohmann::json::parse(result.out)["slower"].empty());
}

TEST_F(BenchBaseline, NamesEveryKernelThatGotSlower) {
  const auto result = runPalpate("study bench --baseline " + measured(0.01) + " --json" + kQuick);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["slower"].size(), json["kernels"].size());
  EXPECT_GT(json["kernels"][0]["change"].get<double>(), 1.3);
  EXPECT_NE(runPalpate("study bench --baseline " + measured(0.01) + kQuick).out.find("SLOWER"), std::string::npos);
}

TEST_F(BenchBaseline, RefusesAFileThatIsNone) {
  for (const char* text : {"", "[1, 2]", "{\"triangles\": 2962, \"kernels\": []}",
                           "{\"triangles\": 2962, \"kernels\": [{\"name\": \"weld\", \"ratio\": -1}]}",
                           "{\"triangles\": 3, \"kernels\": [{\"name\": \"weld\", \"ratio\": 1}]}"}) {
    const auto result = runPalpate("study bench --baseline " + write(text) + kQuick);
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_NE(result.err.find("baseline.json"), std::string::npos) << result.err;
  }
}

TEST_F(BenchBaseline, OfSeveralFilesTakesTheOneForVectorsAsWideAsHere) {
  auto json = nlohmann::json::parse(std::ifstream(measured(100.0)));
  const auto here = json["machine"]["simd"].get<std::string>();
  json["machine"]["simd"] = "of another width";
  const std::string other = (folder.path() / "other.json").string();
  std::ofstream(other) << json.dump();
  const std::string fitting = measured(100.0);
  const auto result = runPalpate("study bench --baseline " + other + " " + fitting + " --json" + kQuick);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["baseline"], fitting);
  const auto none = runPalpate("study bench --baseline " + other + kQuick);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no baseline for " + here), std::string::npos) << none.err;
}

TEST_F(BenchBaseline, IsNotTheDefault) { EXPECT_EQ(runPalpate("study bench").exit_code, 2); }

}  // namespace
}  // namespace palpate
