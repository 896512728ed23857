// How far ./run's later build is, as the start page says it.
#include "cli/run/other_programs.h"

#include <gtest/gtest.h>

namespace palpate::app {
namespace {

using Kind = viewer::ActivityState::Kind;

constexpr std::string_view kLog =
    "Installing: libpq-dev\n"
    "build-later: teach\n"
    "[1/60] Building CXX object instruments/teach/CMakeFiles/palpate_teach.dir/Unity/unity_0_cxx.cxx.o\n"
    "[37/60] Linking CXX executable palpate-teach\n";

TEST(OtherPrograms, TellsTheStepsOfTheFamilyThatIsBeingBuilt) {
  const viewer::ActivityState teach = stateOfBuild(kLog, "teach");
  EXPECT_EQ(teach.kind, Kind::being_built);
  EXPECT_EQ(teach.done, 37);
  EXPECT_EQ(teach.of, 60);
  const viewer::ActivityState measure = stateOfBuild(kLog, "measure");
  EXPECT_EQ(measure.kind, Kind::being_built);
  EXPECT_EQ(measure.of, 0) << "its turn has not come";
}

TEST(OtherPrograms, OffersNothingWhoseBuildHasFailed) {
  EXPECT_EQ(stateOfBuild(std::string(kLog) + "build-later: failed\n", "teach").kind, Kind::missing);
}

TEST(OtherPrograms, TakesNoOtherLineForSteps) {
  for (const char* line : {"[1/", "[/2]", "[1 /2]", "[99999999999/2]", "[1/2", "warning: [1/2]"}) {
    EXPECT_EQ(stateOfBuild(std::string("build-later: teach\n") + line, "teach").of, 0) << line;
  }
}

}  // namespace
}  // namespace palpate::app
