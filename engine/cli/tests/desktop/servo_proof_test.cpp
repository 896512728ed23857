// The servo thread while a real window fills the screen and leaves it again: the phase of the servo proof
// (engine/view/tests/viewer/servo_proof_test.cpp) that needs a desktop. PALPATE_HEAVY=1 runs it for five seconds beside
// an idle run and prints both; the short check is in window_test.cpp.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "desktop.h"
#include "palpate/base/stopwatch.h"
#include "palpate/mesh/files/save.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::desktop {
namespace {

constexpr auto kPhase = std::chrono::seconds(5);
constexpr const char* kFilled = "1400x900";

/// The number after a word of the report: "late p50 0.0 p99 1.2 p99.9 30.5".
double numberAfter(const std::string& report, const std::string& word) {
  const std::size_t at = report.find(word);
  return at == std::string::npos ? -1.0 : std::atof(report.c_str() + at + word.size());
}

/// Presses, disturbs for a phase, quits; what the servo reports of all that.
template <class Disturb>
std::string runForServoReport(const Desktop& desktop, const std::filesystem::path& folder, const Disturb& disturb) {
  Program program(desktop, folder, {"sheet.ply", "--no-state"});
  EXPECT_TRUE(program.hand("mousemove 790 380 mousedown 1"));
  EXPECT_TRUE(program.until([](const auto& v) { return std::atof(v.at("depth").c_str()) > 5.0; }));
  for (const auto end = Clock::now() + kPhase; Clock::now() < end;) disturb(program);
  EXPECT_GT(program.number("depth"), 5.0) << "still pressed";
  program.hand("mouseup 1 key ctrl+q");
  const std::string all = program.rest();
  const std::size_t at = all.find("servo: ");
  return at == std::string::npos ? all : all.substr(at);
}

TEST(ServoProof, GoesOnWhileTheScreenIsFilledAndLeft) {
  if (std::getenv("PALPATE_HEAVY") == nullptr) GTEST_SKIP() << "PALPATE_HEAVY=1 measures it";
  if (!whyNoDesktop().empty()) GTEST_SKIP() << whyNoDesktop();
  const support::TemporaryFolder folder;
  mesh::save(folder / "sheet.ply", zoo::wavyGrid(40, 200.0, 3.0));
  const Desktop desktop;
  const std::string idle = runForServoReport(desktop, folder.path(),
                                             [](Program& program) { program.until([](const auto&) { return true; }); });
  const std::string filled = runForServoReport(desktop, folder.path(), [](Program& program) {
    program.hand("key F11");
    ASSERT_TRUE(program.until([](const auto& v) { return v.at("size") == kFilled; }));
    program.hand("key F11");
    ASSERT_TRUE(program.until([](const auto& v) { return v.at("size") != kFilled; }));
  });
  std::cout << "idle window: " << idle << "full screen and back: " << filled;
  EXPECT_LT(numberAfter(filled, "p99.9 "), 4.0 * numberAfter(idle, "p99.9 ") + 1000.0);
}

}  // namespace
}  // namespace palpate::desktop
