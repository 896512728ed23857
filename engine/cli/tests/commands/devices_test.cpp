// `palpate devices` and --device from the outside, on doubles of the makers' libraries
// (engine/host/tests/device/doubles).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "host/tests/device/doubles/double_library.h"
#include "support/places.h"
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

struct NoLibraries {
  Environment hd{"PALPATE_LIBHD", "/nowhere/libHD.so"};
  Environment dhd{"PALPATE_LIBDHD", "/nowhere/libdhd.so"};
  Environment haply{"PALPATE_HAPLY", "127.0.0.1:1"};
};
struct BothDoubles {
  Environment hd{"PALPATE_LIBHD", doubles::libraryOf("openhaptics")};
  Environment dhd{"PALPATE_LIBDHD", doubles::libraryOf("forcedimension")};
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
  for (const char* name : {"mouse", "script", "playback", "hand"}) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name)["available"]) << name;
    EXPECT_EQ(found.at(name)["reason"], "") << name;
  }
  EXPECT_NE(found.at("haply")["reason"].get<std::string>().find("Connection refused"), std::string::npos);
  EXPECT_NE(found.at("haply")["remedy"].get<std::string>().find("systemctl start"), std::string::npos);
  EXPECT_NE(found.at("plugin")["remedy"].get<std::string>().find("PALPATE_DEVICE_PLUGINS"), std::string::npos);
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

TEST(Devices, TheDoctorSaysWhyItMeasuredNothing) {
  for (const char* name : {"script", "mouse"}) {
    const support::CommandResult result = support::runPalpate(std::string("devices --doctor --device ") + name);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("  measured   nothing: it is not hardware"), std::string::npos) << result.out;
    const json finding = findings(std::string("--doctor --device ") + name).begin()->second;
    EXPECT_TRUE(finding["measured"].is_null());
    EXPECT_NE(finding["not_measured"], "");
  }
  const support::CommandResult plain = support::runPalpate("devices --device hand");
  EXPECT_EQ(plain.out.find("measured"), std::string::npos) << plain.out;
  const json asked = findings("--device hand").begin()->second;
  EXPECT_EQ(asked["not_measured"], "not asked for: --doctor measures");
}

/// The first finding about the device. On a machine that does something else it may say so: then once more.
json measuredFinding(const std::string& words) {
  json finding;
  for (int i = 0; i < 5; ++i) {
    finding = findings("--doctor --seconds 0.5 --device " + words).begin()->second;
    if (finding.dump().find("overloaded") == std::string::npos) break;
  }
  return finding;
}

TEST(Devices, TheDoctorMeasuresWhatOpens) {
  const BothDoubles both;
  for (const char* name : {"openhaptics", "forcedimension"}) {
    const json finding = measuredFinding(name);
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

TEST(Devices, TheDoctorMeasuresAServiceAndAPlugin) {
  doubles::reset(doubles::controlOf("haply"));
  doubles::controlOf("haply").by_hand = false;
  const Environment haply("PALPATE_HAPLY", doubles::haplyWords());
  for (const std::string& words : {std::string("haply"), "plugin:" + doubles::libraryOf("plugin")}) {
    const json finding = measuredFinding(words);
    EXPECT_TRUE(finding["available"]) << finding.dump(2);
    EXPECT_FALSE(finding["version"].get<std::string>().empty());
    EXPECT_GT(finding["capabilities"]["max_force_n"], 1.0);
    EXPECT_GT(finding["measured"]["positions_per_s"], 20.0) << "of a double on a machine that may be busy";
    EXPECT_EQ(finding["measured"]["trouble"], "");
  }
}

TEST(Devices, ListsThePluginsOfTheFoldersAndWhyOneDoesNotLoad) {
  const support::TemporaryFolder folder;
  std::filesystem::copy_file(doubles::libraryOf("plugin"), folder / "good.so");
  std::filesystem::copy_file(doubles::libraryOf("forcedimension"), folder / "odd.so");
  const Environment folders("PALPATE_DEVICE_PLUGINS", folder.path().string());
  const support::CommandResult result = support::runPalpate("devices");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& words : {"double: a double (plugin:" + (folder / "good.so").string() + ")",
                                   (folder / "odd.so").string() + " is not a plugin"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
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
  EXPECT_NE(notes.find("is moved by openhaptics, PHANTOM Omni, at most 3.30 N"), std::string::npos) << notes;
}

TEST_F(SimulateWithADevice, ASimulatedHandFeelsTheSceneTheSameTwice) {
  const auto felt = [&](const std::string& device, const std::string& out) {
    const support::CommandResult result = simulate("--seconds 2 --device " + device + " --out " + out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  };
  const json once = felt("hand", "once");
  const json again = felt("hand", "again");
  EXPECT_EQ(once["hash"], again["hash"]);
  EXPECT_GT(once["fingers"][0]["force_n"]["peak"].get<double>(), 0.05) << "the hand came down to the skin";
  EXPECT_NE(once["notes"].dump().find("simulated touch_x, stylus_x, at most 7.90 N"), std::string::npos);
  EXPECT_NE(felt("hand:stylus_z,omni", "other")["hash"], once["hash"]);
}

TEST_F(SimulateWithADevice, ASimulatedHandRunsByTheClockToo) {
  const support::CommandResult result = simulate("--seconds 1.5 --realtime --device hand --out run");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["ticks"].get<int>() + report["overruns"].get<int>(), 1500);
  for (const char* key : {"p50", "p99", "p99_9", "max"}) EXPECT_TRUE(report["realtime"]["lateness_us"].contains(key));
}

TEST_F(SimulateWithADevice, ASimulatedHandThatIsMisspeltIsNamed) {
  const support::CommandResult result = simulate("--device hand:stylus_q,omni --out run");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("did you mean 'stylus_"), std::string::npos) << result.err;
}

TEST(Devices, IdentifiesASimulatedDeviceThatIsLetGo) {
  const support::CommandResult result = support::runPalpate("devices --identify --device hand:premium_1_5 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  EXPECT_TRUE(found["simulated"]);
  EXPECT_NEAR(found["mass_kg"].get<double>(), 0.075, 0.001);
  EXPECT_NEAR(found["device_damping_n_s_per_mm"].get<double>(), 0.2e-3, 0.01e-3);
  EXPECT_NEAR(found["device_friction_n"].get<double>(), 0.04, 0.002);
  EXPECT_NEAR(found["delay_ticks"].get<double>(), 1.0, 0.2);
  EXPECT_EQ(found["rounds"].size(), 3u);
  const std::string lines = found["safety"];
  for (const char* key : {"device_damping_n_s_per_mm = ", "device_friction_n = 0.04", "delay_ticks = "}) {
    EXPECT_NE(lines.find(key), std::string::npos) << lines;
  }
}

TEST(Devices, ThereIsNothingToIdentifyWhereNothingTakesAForce) {
  const NoLibraries none;
  const support::CommandResult nothing = support::runPalpate("devices --identify");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("--device hand"), std::string::npos) << nothing.err;
  const support::CommandResult file = support::runPalpate("devices --identify --device playback");
  EXPECT_EQ(file.exit_code, 2);
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

/// With the program of docs/reference/remote.md, started before there is anybody to talk to.
class SimulateWithAProgram : public SimulateWithADevice {
 protected:
  void expectItPresses(const std::string& more_words) {
    const std::string port = std::to_string(20000 + ::getpid() % 20000);
    const std::string example =
        "python3 " + support::sourceFolder().string() + "/examples/remote_finger.py --seconds 2 --port " + port;
    const std::string log = (folder_ / "example.txt").string();
    int python = -1;
    std::thread program([&] { python = std::system((example + more_words + " >'" + log + "' 2>&1").c_str()); });
    const support::CommandResult result = simulate("--seconds 3 --realtime --device remote:" + port + " --out run");
    program.join();
    const std::string said = support::contentOf(log);
    EXPECT_EQ(python, 0) << said;
    EXPECT_NE(said.find("answered "), std::string::npos) << said;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json report = json::parse(result.out);
    EXPECT_GT(report["fingers"][0]["depth_mm"]["peak"], 0.5) << "it pressed the skin";
  }
};

TEST_F(SimulateWithAProgram, MovesAFinger) { expectItPresses(""); }

TEST_F(SimulateWithAProgram, MovesAFingerWithASignatureThatIsNotOurs) {
  const std::string key = (folder_ / "remote.key").string();
  std::ofstream(key) << "0f1e2d3c4b5a69788796a5b4c3d2e1f0\n";
  std::filesystem::permissions(key, std::filesystem::perms::owner_read);
  ::setenv("PALPATE_REMOTE_KEY_FILE", key.c_str(), 1);
  expectItPresses(" --key-file '" + key + "'");
  ::unsetenv("PALPATE_REMOTE_KEY_FILE");
}

}  // namespace
}  // namespace palpate
