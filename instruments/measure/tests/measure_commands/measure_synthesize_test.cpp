// `palpate measure synthesize` from the outside: its files are photographs with times, its truth is what was asked for.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "palpate/measure/photograph.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

TEST(MeasureSynthesize, WritesPhotographsWithTimesAndTheTruthThatWasAskedFor) {
  const support::TemporaryFolder folder;
  const CommandResult result = runPalpate(
      "measure synthesize -o back --seed 4 --megapixels 0.5 --tail long --half-major-mm 90 --ratio 1.5 "
      "--direction-deg 30 --drag-deg -60 --peak-mm 12 --contact-mm 5,-10 --missing 2 --strays 0 --tilt-deg 10",
      folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("90.0 x 60.0 mm (half axes), major axis at 30.0 degrees"), std::string::npos) << result.out;
  const auto before = measure::readPhotograph(folder / "back/before.jpg");
  const auto again = measure::readPhotograph(folder / "back/before2.jpg");
  const auto after = measure::readPhotograph(folder / "back/after.jpg");
  EXPECT_EQ(before.width_px, after.width_px);
  ASSERT_TRUE(before.taken_at_s && again.taken_at_s && after.taken_at_s);
  EXPECT_LT(*before.taken_at_s, *again.taken_at_s);
  EXPECT_LT(*again.taken_at_s, *after.taken_at_s);
  const auto truth = nlohmann::json::parse(contentOf(folder / "back/truth.json"));
  EXPECT_EQ(truth["ellipse_2_mm"]["half_major_mm"], 90.0);
  EXPECT_EQ(truth["drag_deg"], -60.0);
  EXPECT_EQ(truth["contact_mm"], (nlohmann::json{5.0, -10.0}));
  EXPECT_EQ(truth["camera"]["tilt_deg"], 10.0);
  EXPECT_EQ(truth["dots"].size(),
            truth["marks"]["columns"].get<std::size_t>() * truth["marks"]["rows"].get<std::size_t>() - 2);
}

TEST(MeasureSynthesize, SaysInJsonWhatItWrote) {
  const support::TemporaryFolder folder;
  const CommandResult result = runPalpate("measure synthesize -o a --megapixels 0.5 --peak-mm 0 --json", folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["files"].size(), 4u);
  EXPECT_EQ(json["truth"]["ellipse_2_mm"]["half_major_mm"], 0.0);
  EXPECT_FALSE(json["truth"].contains("dots"));
}

TEST(MeasureSynthesize, RefusesWhatCannotBePainted) {
  const support::TemporaryFolder folder;
  EXPECT_EQ(runPalpate("measure synthesize", folder.path()).exit_code, 2);
  EXPECT_EQ(runPalpate("measure synthesize -o a --tail longer", folder.path()).exit_code, 2);
  EXPECT_EQ(runPalpate("measure synthesize -o a --megapixels 400", folder.path()).exit_code, 2);
  EXPECT_EQ(runPalpate("measure synthesize -o a --contact-mm 5", folder.path()).exit_code, 2);
  EXPECT_EQ(runPalpate("measure synthesize -o /proc/nowhere --megapixels 0.5", folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace palpate
