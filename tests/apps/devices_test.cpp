// `palpate devices` and --device from the outside, on doubles of the makers' libraries (tests/device/doubles).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;

/// An environment variable for the commands of one test.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  ~Environment() { ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

std::string doubleOf(const std::string& kind, const std::string& file) {
  return std::string(PALPATE_BINARY_DIR) + "/tests/doubles/" + kind + "/" + file;
}
struct NoLibraries {
  Environment hd{"PALPATE_LIBHD", "/nowhere/libHD.so"};
  Environment dhd{"PALPATE_LIBDHD", "/nowhere/libdhd.so"};
};
struct BothDoubles {
  Environment hd{"PALPATE_LIBHD", doubleOf("openhaptics", "libHD.so")};
  Environment dhd{"PALPATE_LIBDHD", doubleOf("forcedimension", "libdhd.so")};
};

std::map<std::string, json> findings(const std::string& arguments) {
  const support::CommandResult result = support::runPalpate("devices --json " + arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, json> by_name;
  for (const json& finding : json::parse(result.out)) by_name[finding["name"]] = finding;
  return by_name;
}

TEST(Devices, ListsEveryBackEndWithItsReasonAndItsRemedy) {
  const NoLibraries none;
  const auto found = findings("");
  for (const char* name : {"mouse", "script", "playback"}) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name)["available"]) << name;
    EXPECT_EQ(found.at(name)["reason"], "") << name;
  }
  for (const char* name : {"openhaptics", "forcedimension"}) {
    const json& finding = found.at(name);
    EXPECT_FALSE(finding["available"]) << name;
    EXPECT_NE(finding["reason"].get<std::string>().find("cannot open shared object file"), std::string::npos);
    EXPECT_NE(finding["remedy"].get<std::string>().find("PALPATE_LIB"), std::string::npos);
    EXPECT_GE(finding["looked_for"].size(), 2u);
    EXPECT_TRUE(finding["measured"].is_null());
  }
}

TEST(Devices, WithoutJsonTheSameIsReadByAPerson) {
  const NoLibraries none;
  const support::CommandResult result = support::runPalpate("devices --doctor");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"openhaptics     not here", "because", "remedy", "not found", "/nowhere/libHD.so", "mouse           here"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  }
}

TEST(Devices, TheDoctorMeasuresWhatOpens) {
  const BothDoubles both;
  for (const char* name : {"openhaptics", "forcedimension"}) {
    const json finding = findings(std::string("--doctor --seconds 0.5 --device ") + name).at(name);
    EXPECT_TRUE(finding["available"]) << finding.dump(2);
    EXPECT_EQ(finding["capabilities"]["model"], std::string(name) == "openhaptics" ? "PHANTOM Omni" : "omega.3");
    const json& measured = finding["measured"];
    EXPECT_GT(measured["positions_per_s"], 20.0) << "of a double on a machine that may be busy";
    EXPECT_LT(measured["positions_per_s"], 2500.0);
    EXPECT_GT(measured["interval_us"]["p50"], 50.0);
    EXPECT_GT(measured["delay_us"]["p50"], 0.0);
    EXPECT_EQ(measured["trouble"], "");
  }
}

TEST(Devices, OneThatIsAskedForAndNotThereIsANo) {
  const NoLibraries none;
  const support::CommandResult result = support::runPalpate("devices --device openhaptics");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("not here"), std::string::npos) << result.out;
}

TEST(Devices, ANameThatNoBackEndHasIsWrongUsage) {
  const support::CommandResult result = support::runPalpate("devices --device openhaptic");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("did you mean 'openhaptics'?"), std::string::npos) << result.err;
}

TEST(Devices, SaysThatALicenceIsMissing) {
  const BothDoubles both;
  const Environment refusal("PALPATE_DOUBLE", "refusal=1536");
  const json finding = findings("").at("openhaptics");
  EXPECT_FALSE(finding["available"]);
  EXPECT_NE(finding["reason"].get<std::string>().find("invalid licence (0x600)"), std::string::npos)
      << finding["reason"];
}

class SimulateWithADevice : public testing::Test {
 protected:
  /// Two fingers hover over a torso's back for a moment.
  support::CommandResult simulate(const std::string& arguments) const {
    return support::runPalpate("simulate --no-pictures --no-plot --json " + arguments, folder_.path());
  }
  support::TemporaryFolder folder_;
};

TEST_F(SimulateWithADevice, HoldsAFingerInRealTime) {
  const BothDoubles both;
  const support::CommandResult result = simulate("--seconds 0.2 --realtime --device openhaptics --out run");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out);
  const std::string notes = report["notes"].dump();
  EXPECT_NE(notes.find("is held by openhaptics, PHANTOM Omni, at most 3.30 N"), std::string::npos) << notes;
}

TEST_F(SimulateWithADevice, TakesAnExtraDeviceForAMistake) {
  const BothDoubles both;
  const support::CommandResult result =
      simulate("--realtime --device openhaptics --device forcedimension --device script --device mouse --out run");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("4 devices for"), std::string::npos) << result.err;
}

TEST_F(SimulateWithADevice, RefusesHardwareWithoutTheClockAndHardwareThatIsNotThere) {
  {
    const BothDoubles both;
    const support::CommandResult result = simulate("--device forcedimension --out run");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("--realtime"), std::string::npos) << result.err;
  }
  const NoLibraries none;
  const support::CommandResult result = simulate("--realtime --device openhaptics --out run");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("cannot open shared object file"), std::string::npos) << result.err;
}

TEST_F(SimulateWithADevice, PlaysARecordedFingerAgain) {
  const auto peaks = [](const json& report) {
    std::vector<double> forces;
    for (const json& finger : report["fingers"]) forces.push_back(finger["force_n"]["peak"]);
    return forces;
  };
  const support::CommandResult first = simulate("--seconds 1 --out first");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string recording = "--device playback:first/forces.csv:";
  const support::CommandResult again =
      simulate("--seconds 1 " + recording + "middle " + recording + "index --out again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const std::vector<double> before = peaks(json::parse(first.out));
  const std::vector<double> after = peaks(json::parse(again.out));
  ASSERT_EQ(after.size(), 2u);
  EXPECT_GT(before[0], 0.05);
  EXPECT_NEAR(after[0], before[1], 1e-5) << "the fingers have changed places";
  EXPECT_NEAR(after[1], before[0], 1e-5);
}

/// The program of docs/remote.md, started before there is anybody to talk to.
TEST_F(SimulateWithADevice, IsMovedByAnotherProgram) {
  const std::string port = std::to_string(20000 + ::getpid() % 20000);
  const std::string example =
      "python3 " + std::string(PALPATE_SOURCE_DIR) + "/examples/remote_finger.py --seconds 2 --port ";
  int python = -1;
  std::thread program(
      [&] { python = std::system((example + port + " >'" + (folder_ / "example.txt").string() + "' 2>&1").c_str()); });
  const support::CommandResult result = simulate("--seconds 3 --realtime --device remote:" + port + " --out run");
  program.join();
  const std::string said = support::contentOf(folder_ / "example.txt");
  EXPECT_EQ(python, 0) << said;
  EXPECT_NE(said.find("answered "), std::string::npos) << said;
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_GT(report["fingers"][0]["depth_mm"]["peak"], 0.5) << "it pressed the skin";
}

}  // namespace
}  // namespace palpate
