// What a stranger's scene may not ask of a hand, from the outside: limits, notes, --unsafe-stiffness and what a
// recording keeps of it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::CommandResult;
using support::runPalpate;

const std::string kRequest = (support::testData() / "safety/wish_stiffness_cap.toml").string();

class SafetyLimits : public testing::Test {
 protected:
  CommandResult run(const std::string& arguments) const { return runPalpate(arguments, folder_.path()); }
  CommandResult simulate(const std::string& arguments) const {
    return run("simulate --no-pictures --no-plot --json " + kRequest + " " + arguments);
  }
  static json parseReport(const CommandResult& result) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  support::TemporaryFolder folder_;
};

TEST_F(SafetyLimits, ASceneCannotRequestPastTheCapOrTheWeakestKnownForce) {
  const CommandResult result = simulate("--out run --session");
  const json report = parseReport(result);
  EXPECT_NEAR(report["device"]["stiffness_factor"].get<double>(), 0.1333, 0.0002);
  EXPECT_EQ(report["device"]["force_n"], 3.3);
  EXPECT_FALSE(report["device"]["unsafe_stiffness"]);
  EXPECT_LE(report["fingers"][0]["device_force_peak_n"].get<double>(), 3.3 * (1.0 + 1e-12));
  const std::string notes = report["notes"].dump();
  EXPECT_NE(notes.find("stiffness_cap_n_per_mm = 5 is more than"), std::string::npos) << notes;
  EXPECT_NE(notes.find("nominal_force_n = 100 is more than"), std::string::npos) << notes;
  EXPECT_EQ(result.err.find("UNSAFE"), std::string::npos);
  EXPECT_EQ(run("recording info run/run.session").out.find("UNSAFE"), std::string::npos);
  EXPECT_NE(run("recording info run/run.session").out.find("all forces times 0.133"), std::string::npos);
}

TEST_F(SafetyLimits, ConsentOnTheCommandLineIsSaidInReportAndRecording) {
  const CommandResult result = simulate("--unsafe-stiffness --out run --session");
  const json report = parseReport(result);
  EXPECT_EQ(report["device"]["stiffness_factor"], 1.0);
  EXPECT_EQ(report["device"]["force_n"], 100.0);
  EXPECT_TRUE(report["device"]["unsafe_stiffness"]);
  EXPECT_GT(report["fingers"][0]["device_force_peak_n"].get<double>(), 10.0);
  EXPECT_NE(report["notes"].dump().find("UNSAFE (--unsafe-stiffness): up to 5 N/mm and 100 N"), std::string::npos);
  EXPECT_NE(result.err.find("palpate: UNSAFE"), std::string::npos) << result.err;

  const CommandResult info = run("recording info run/run.session");
  EXPECT_NE(info.out.find("UNSAFE"), std::string::npos) << info.out;
  EXPECT_TRUE(parseReport(run("recording info --json run/run.session"))["limits"][0]["unsafe_stiffness"]);
  if (support::hasProgramOf("recording report")) {
    EXPECT_EQ(parseReport(run("recording report --json run/run.session"))["unsafe_stiffness"].size(), 1u);
  }
  EXPECT_TRUE(parseReport(run("recording replay --verify --json run/run.session"))["identical"]);
  // The recording's own scene does not bring the consent along.
  EXPECT_EQ(support::contentOf(folder_ / "run/run.session").find("unsafe_stiffness = true"), std::string::npos);
}

TEST_F(SafetyLimits, ARecordingWithoutAWindowSaysIt) {
  const std::string scene = "recording new " + kRequest + " --seconds 0.3 --json -o ";
  const CommandResult unsafe = run(scene + "unsafe.session --unsafe-stiffness");
  EXPECT_NE(unsafe.err.find("palpate: UNSAFE"), std::string::npos) << unsafe.err;
  EXPECT_EQ(parseReport(unsafe)["safety_notes"].size(), 1u);
  EXPECT_NE(run("recording info unsafe.session").out.find("UNSAFE"), std::string::npos);
  EXPECT_EQ(parseReport(run(scene + "safe.session"))["safety_notes"].size(), 2u);
}

TEST_F(SafetyLimits, NoSceneFileGivesTheConsent) {
  std::string text = readFile(kRequest, 10000);
  text.replace(text.find("[safety]"), 8, "[safety]\nunsafe_stiffness = true");
  writeFile(folder_ / "scene.toml", text);
  const CommandResult result = run("simulate --no-pictures --no-plot scene.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("unsafe_stiffness"), std::string::npos) << result.err;
}

TEST_F(SafetyLimits, TrainingAndServersTakeNoConsent) {
  for (const char* command : {"train", "serve"}) {
    const CommandResult help = run(std::string(command) + " --help");
    EXPECT_EQ(help.out.find("--unsafe-stiffness"), std::string::npos) << command;
  }
  for (const char* command : {"simulate", "run", "recording new"}) {
    const CommandResult help = run(std::string(command) + " --help");
    EXPECT_NE(help.out.find("--unsafe-stiffness"), std::string::npos) << command;
  }
}

TEST_F(SafetyLimits, OfAHeldDeviceAreReportedAsTheyHeld) {
  std::string text = readFile(kRequest, 10000);
  text.replace(text.find("delay_ticks = 3"), 15, "delay_ticks = 1");
  writeFile(folder_ / "scene.toml", text);
  const json report =
      parseReport(run("simulate --no-pictures --no-plot --json scene.toml --out run --session --device hand:touch_x"));
  const double factor = report["device"]["stiffness_factor"];
  EXPECT_NEAR(factor, 0.2, 1e-6) << "1 N/mm of the Touch X";
  EXPECT_EQ(report["device"]["force_n"], 7.9);
  const std::string notes = report["notes"].dump();
  EXPECT_NE(notes.find("all forces times 0.20"), std::string::npos) << notes;
  const json limits = parseReport(run("recording info --json run/run.session"))["limits"][0];
  EXPECT_EQ(limits["stiffness_factor"], factor) << "one truth";
  EXPECT_EQ(limits["force_n"], report["device"]["force_n"]);
  EXPECT_EQ(limits["stiffness_n_per_mm"], report["device"]["stiffness_n_per_mm"]);
}

TEST_F(SafetyLimits, TheDeviceThatOpenedDecidesNotTheOneThatTheSceneNames) {
  std::string text = readFile(kRequest, 10000);
  text.replace(text.find("[safety]"), 8, "[safety]\ndevice = \"premium_3_0\"\npassivity = false");
  text.replace(text.find("delay_ticks = 3"), 15, "delay_ticks = 1");
  writeFile(folder_ / "scene.toml", text);
  const json report =
      parseReport(run("simulate --no-pictures --no-plot --json scene.toml --device hand:omni --out run --session"));
  EXPECT_EQ(report["device"]["force_n"], 3.3);
  EXPECT_NEAR(report["device"]["stiffness_factor"].get<double>(), 0.1, 1e-6) << "0.5 N/mm of the Omni";
  EXPECT_NE(report["notes"].dump().find("passivity = false: on a device it stays on"), std::string::npos);
}

TEST_F(SafetyLimits, TheDoctorMeasuresASimulatedHandLikeAnyDevice) {
  const CommandResult result = run("devices --doctor --seconds 0.3 --device hand:stylus_z,omni --json");
  const json finding = parseReport(result)[0];
  EXPECT_TRUE(finding["available"]);
  EXPECT_EQ(finding["not_measured"], "");
  EXPECT_EQ(finding["capabilities"]["max_force_n"], 3.3);
  EXPECT_EQ(finding["capabilities"]["force_limit_n"], 3.3);
  ASSERT_FALSE(finding["measured"].is_null());
  EXPECT_GT(finding["measured"]["positions_per_s"], 50.0);
  EXPECT_LT(finding["measured"]["positions_per_s"], 1100.0) << "a position a tick";
  EXPECT_NEAR(finding["measured"]["delay_us"]["p50"].get<double>(), 1000.0, 50.0);
  EXPECT_EQ(finding["measured"]["with_position_share"], 1.0);
  const CommandResult text = run("devices --doctor --seconds 0.2 --device hand");
  EXPECT_NE(text.out.find("simulated touch_x, stylus_x"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("positions"), std::string::npos) << text.out;
}

}  // namespace
}  // namespace palpate
