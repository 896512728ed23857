// `palpate measure dots` from the outside, on synthetic photographs whose truth is known: what it prints and writes,
// its exit codes, and what it says to wrong input.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/photograph.h"
#include "palpate/measure/synthesis/synthetic_pair.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using support::CommandResult;
using support::contentOf;
using support::runPalpate;

constexpr double kTaken = 1715941230.0;  // 17 May 2024

/// One pair for all tests; one megapixel is painted and read in half the time of two.
class MeasureDots : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    measure::SyntheticPair pair =
        renderPair(measure::drawCase(3, {.megapixels = 1.0, .family = measure::TailFamily::compact, .drift_mm = 0.2}));
    pair.before.taken_at_s = kTaken;
    pair.after.taken_at_s = kTaken + 5.5;
    folder() = fs::temp_directory_path() / ("palpate_measure_dots_" + std::to_string(getpid()));
    fs::create_directories(folder());
    measure::writeJpeg(folder() / "before.jpg", pair.before, 92);
    measure::writeJpeg(folder() / "after.jpg", pair.after, 92);
    truth() = std::move(pair.truth);
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }

  static fs::path& folder() {
    static fs::path path;
    return path;
  }
  static measure::SyntheticTruth& truth() {
    static measure::SyntheticTruth value;
    return value;
  }
  CommandResult dots(const std::string& arguments) const {
    return runPalpate("measure dots " + arguments, results_.path());
  }
  std::string before() const { return (folder() / "before.jpg").string(); }
  std::string after() const { return (folder() / "after.jpg").string(); }
  std::string pair() const { return before() + " " + after(); }
  void write(const std::string& name, const std::string& text) const { writeFile(results_ / name, text); }

  support::TemporaryFolder results_;
};

TEST_F(MeasureDots, WritesAFolderThatTheMapsAndPeopleCanRead) {
  const CommandResult result = dots(pair() + " -o P1 --name P1 --at -12,73.5");
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("P1: accepted\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("time      5.5 s between the pictures"), std::string::npos) << result.out;
  const auto keys = maps::readKeyPoints(results_ / "P1/key_points.csv");
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].position_mm, Vec2(-12.0, 73.5));
  const double true_axis = truth().at_2_mm.half_major_mm.value;
  EXPECT_NEAR(keys[0].ellipse.half_major_mm, true_axis, 0.06 * true_axis);
  const measure::Photograph overlay = measure::readPhotograph(results_ / "P1/overlay.png");
  EXPECT_EQ(overlay.width_px, 1240);
  const auto report = nlohmann::json::parse(contentOf(results_ / "P1/measurement.json"));
  EXPECT_TRUE(report["accepted"]);
  EXPECT_EQ(report["dots"].size(), report["grid"]["dots"].get<std::size_t>());
  EXPECT_NEAR(report["fit"]["at_2_mm"]["half_major_mm"]["value"], keys[0].ellipse.half_major_mm, 1e-3);
  EXPECT_NEAR(std::remainder(report["fit"]["drag_deg"]["value"].get<double>() - truth().drag_deg, 360.0), 0.0, 5.0);
}

TEST_F(MeasureDots, ItsOwnTableOfDotsGivesTheSame) {
  ASSERT_EQ(dots(pair() + " -o pictures").exit_code, 0);
  const CommandResult result = dots("pictures/dots.csv -o table");
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const auto from_pictures = maps::readKeyPoints(results_ / "pictures/key_points.csv").front();
  const auto from_table = maps::readKeyPoints(results_ / "table/key_points.csv").front();
  EXPECT_NEAR(from_table.ellipse.half_major_mm, from_pictures.ellipse.half_major_mm, 0.05);
  EXPECT_TRUE(fs::exists(results_ / "table/overlay.png"));
}

TEST_F(MeasureDots, SwappedPicturesAreRefusedAndNoMapReadsThem) {
  const CommandResult result = dots(after() + " " + before() + " -o swapped");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.out.find("P1: REFUSED, not to be used\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("before.jpg was taken"), std::string::npos) << result.out;
  EXPECT_TRUE(maps::readKeyPoints(results_ / "swapped/key_points.csv").empty());
  EXPECT_NE(contentOf(results_ / "swapped/key_points.csv").find("# refused: "), std::string::npos);
  EXPECT_TRUE(fs::exists(results_ / "swapped/overlay.png"));
  EXPECT_FALSE(nlohmann::json::parse(contentOf(results_ / "swapped/measurement.json"))["accepted"]);
}

TEST_F(MeasureDots, NothingPressedIsRefusedWithWhatToDo) {
  const CommandResult result = dots(before() + " " + before());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("refused: Nothing was dragged"), std::string::npos) << result.out;
}

TEST_F(MeasureDots, WritesTheOneFileThatIsNamed) {
  ASSERT_EQ(dots(pair() + " -o P1.csv --overlay P1.svg").exit_code, 0);
  EXPECT_EQ(maps::readKeyPoints(results_ / "P1.csv").size(), 1u);
  EXPECT_TRUE(contentOf(results_ / "P1.svg").starts_with("<?xml"));
  const auto entries = std::distance(fs::directory_iterator(results_.path()), fs::directory_iterator());
  EXPECT_EQ(entries, 2);
}

TEST_F(MeasureDots, PrintsEverythingAsOneObject) {
  const CommandResult result = dots(pair() + " --json --null " + before() + " -o it.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_NEAR(report["null_drift_mm"], 0.0, 1e-6);
  EXPECT_EQ(report["settings"]["drift_mm"], 0.4);
  EXPECT_EQ(report["files"], nlohmann::json::array({"it.json"}));
  EXPECT_EQ(report["seconds_between"], 5.5);
}

TEST_F(MeasureDots, ABodyThatMovesByItselfIsWarnedOfAndAllowedFor) {
  // The same picture, 8 px (2 mm and more) aside.
  measure::Photograph moved = measure::readPhotograph(before());
  std::rotate(moved.rgb.begin(), moved.rgb.end() - 3 * 8, moved.rgb.end());
  measure::writeJpeg(results_ / "again.jpg", moved, 92);
  const auto report = nlohmann::json::parse(dots(pair() + " --json --null again.jpg").out);
  const double drift = report["null_drift_mm"];
  EXPECT_NEAR(drift, 8.0 / truth().px_per_mm, 0.4);
  EXPECT_EQ(report["settings"]["drift_mm"].get<double>(), drift);
  EXPECT_EQ(report["findings"].back()["code"], "null_drift");
  const auto asked = nlohmann::json::parse(dots(pair() + " --json --null again.jpg --drift-mm 0.5").out);
  EXPECT_EQ(asked["settings"]["drift_mm"], 0.5);
}

TEST_F(MeasureDots, AnEarlierMeasurementIsNotOverwritten) {
  fs::create_directories(results_ / "P1");
  write("P1/key_points.csv", "what was there before\n");
  const CommandResult result = dots(pair() + " -o P1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "palpate: P1: holds another measurement (key_points.csv): --overwrite replaces it, --out P1-2 is free\n");
  EXPECT_EQ(contentOf(results_ / "P1/key_points.csv"), "what was there before\n");
  EXPECT_EQ(dots(pair() + " -o P1 --overwrite").exit_code, 0);
}

TEST_F(MeasureDots, WrongInputIsSaidInOneLine) {
  write("text.jpg", "no picture\n");
  write("cut.jpg", contentOf(folder() / "before.jpg").substr(0, 50000));
  write("dots.csv", "picture,x_px,y_px\nbefore,1,2\nlater,3,4\n");
  measure::writePhotograph(results_ / "small.png",
                           {.name = {}, .width_px = 300, .height_px = 200, .rgb = std::vector<std::uint8_t>(180000)});
  const std::initializer_list<std::pair<std::string, std::string>> cases = {
      {"text.jpg " + after(), "text.jpg: is text, not a picture, despite its name; expected a JPEG, PNG or TIFF"},
      {before() + " cut.jpg", "cut.jpg: is cut off: the end of the picture is missing; copy the file again"},
      {before() + " none.jpg", "none.jpg: no such file"},
      {before() + " small.png", "small.png: is 300 x 200 pixels, "},
      {before(), "measure dots: expected two photographs, before and after, or one table of dots (.csv)"},
      {"dots.csv", "dots.csv:3: picture 'later' must be before or after"},
      {"dots.csv --null " + before(), "--null: needs photographs, not a table of dots"},
      {pair() + " --spacing-mm 2", "--spacing-mm: 2 is out of range: 5 to 100 mm"},
      {pair() + " --contact 99999,5", "--contact: 99999,5 is outside the picture"},
      {pair() + " --name a,b", "--name: has a comma"},
      {pair() + " --at 1,2,3,4", "--at: expected X,Y or a place such as 'T6'"},
      {pair() + " --overlay it.jpg", "it.jpg: a plot's name must end in .png or .svg"},
      {pair() + " -o text.jpg", "text.jpg: is a file, not a folder"},
  };
  for (const auto& [arguments, words] : cases) {
    const CommandResult result = dots(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(result.err.starts_with("palpate: " + words)) << arguments << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST_F(MeasureDots, PlacesAreNumbersOrWords) {
  ASSERT_EQ(dots(pair() + " -o T6.csv --at T6 --name T6").exit_code, 0);
  const auto key = maps::readKeyPoints(results_ / "T6.csv").front();
  EXPECT_EQ(key.name, "T6");
  EXPECT_LT(std::abs(key.position_mm.x()), 10.0);  // on the midline
  EXPECT_NEAR(key.position_mm.y(), 40.0, 30.0);    // below T5, which is at 73
}

}  // namespace
}  // namespace palpate
