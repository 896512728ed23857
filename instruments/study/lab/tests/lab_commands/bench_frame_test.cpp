// `palpate study bench frame` from the outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace palpate {
namespace {

using support::runPalpate;

TEST(BenchFrameCommand, SplitsAPictureIntoDeformationUploadAndDrawing) {
  const auto result = runPalpate("study bench frame --triangles 3000 --width 160 --height 90 --seconds 0 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["triangles"], 3000);
  for (const char* step : {"deform_ms", "upload_ms", "draw_ms", "first_frame_ms"}) {
    EXPECT_GT(json[step].get<double>(), 0.0) << step;
  }
  const double sum = json["deform_ms"].get<double>() + json["upload_ms"].get<double>() + json["draw_ms"].get<double>();
  EXPECT_NEAR(json["fps"].get<double>(), 1000.0 / sum, 1e-6 * 1000.0 / sum);
  EXPECT_GT(json["uploaded_vertices"].get<double>(), 0.0);
  const double covered = json["covered"].get<double>();
  EXPECT_TRUE(covered > 0.1 && covered < 0.9) << covered;
}

TEST(BenchFrameCommand, NamesTheStereoModesItKnows) {
  const auto result = runPalpate("study bench frame --stereo cinema");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("sbs-half"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace palpate
