// `palpate measure average`, `stiffness`, `stencil` and `session` from the outside. The whole way of a person is
// measure_page_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/maps/key_points.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::CommandResult;
using support::contentOf;

class MeasureTables : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CommandResult measure(const std::string& arguments) const {
    return support::runPalpate("measure " + arguments, folder_.path());
  }
  json runForJson(const std::string& arguments, int exit_code = 0) const {
    const CommandResult result = measure(arguments + " --json");
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return json::parse(result.out);
  }
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = measure(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << result.out;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(!result.err.empty() && result.err.find('\n') == result.err.size() - 1) << "one line: " << result.err;
    return result.err;
  }
  /// F = k d (d / 8)^0.6.
  static std::string forceRows(const std::string& first, double k) {
    std::string rows;
    for (int i = 1; i <= 12; ++i) rows += fmt::format("{},{},{:.5f}\n", first, i, k * i * std::pow(i / 8.0, 0.6));
    return rows;
  }

  support::TemporaryFolder folder_;
  const std::string header_ = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,drag_deg\n";
};

using MeasureAverage = MeasureTables;

TEST_F(MeasureAverage, SeveralFilesAreSeveralPeople) {
  put("a.csv", header_ + "P1,0,73,100,1.2,90,90\nP1,0,73,100,1.2,90,88\n");
  put("b.csv", header_ + "P1,0,73,81,1.2,90,91\n");
  const json found = runForJson("average a.csv b.csv -o keys.csv --plot keys.svg");
  const json& point = found["points"].at(0);
  EXPECT_NEAR(point["half_major_mm"]["value"].get<double>(), 90.0, 1e-9) << "each counts the same";
  EXPECT_EQ(point["subjects"], 2);
  EXPECT_EQ(point["presses"], 3);
  EXPECT_NE(point["remark"].get<std::string>().find("pulled up only"), std::string::npos);
  EXPECT_EQ(found["written"].size(), 2u);
  EXPECT_NEAR(maps::readKeyPoints(folder_ / "keys.csv").at(0).ellipse.half_major_mm, 90.0, 1e-6);
  EXPECT_NE(contentOf(folder_ / "keys.svg").find("95 % band"), std::string::npos);
}

TEST_F(MeasureAverage, TellsTheTissueFromTheDragAndSaysSo) {
  put("a.csv", header_ + "P1,0,73,100,1.44,90,90\nP1,0,73,100,1.44,0,0\n");
  const CommandResult result = measure("average a.csv");
  EXPECT_NE(result.out.find("the tissue's"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("stretches the ellipse along itself by 1.44"), std::string::npos) << result.out;
  EXPECT_EQ(runForJson("average a.csv --by point,drag -o keys.csv")["points"].at(0)["drags"].size(), 2u);
  EXPECT_EQ(maps::readKeyPoints(folder_ / "keys.csv").size(), 2u);
}

TEST_F(MeasureAverage, SaysWhatItCannotUse) {
  put("a.csv", header_ + "P1,0,73,100,1.2,90,90\n");
  EXPECT_EQ(runForError("average a.csv --drag left"), "palpate: no press was dragged left\n");
  EXPECT_NE(runForError("average a.csv --drag uphill").find("neither up, down, left, right nor degrees"),
            std::string::npos);
  EXPECT_NE(runForError("average a.csv --mirror P4").find("must be FROM:TO"), std::string::npos);
  EXPECT_NE(runForError("average a.csv --mirror P4:P6").find("unknown point 'P4'"), std::string::npos);
  EXPECT_EQ(runForError("average a.csv --plot a.jpg"), "palpate: a.jpg: a plot's name must end in .png or .svg\n");
  EXPECT_NE(runForError("average none.csv").find("none.csv"), std::string::npos);
}

using MeasureStiffness = MeasureTables;

TEST_F(MeasureStiffness, WritesKeyPointsAndTheKeysOfAScene) {
  put("f.csv", "place,x_mm,y_mm,depth_mm,force_n\n" + forceRows("T5,0,73", 0.4) + forceRows("L2,0,-173", 0.7));
  const json found = runForJson("stiffness f.csv -o keys.csv --plot f.svg");
  EXPECT_NEAR(found["places"].at(1)["stiffness_n_per_mm"].get<double>(), 0.7, 0.005);
  EXPECT_EQ(found["places"].at(0)["best"], "power");
  EXPECT_NE(contentOf(folder_ / "f.svg").find("N/mm at 8 mm"), std::string::npos);
  put("scene.toml", found["scene"].get<std::string>() +
                        "[body]\nkind = \"torso\"\n[[finger]]\nname = \"index\"\nat_mm = [0, 73]\nscript = [{ do = "
                        "\"press\", depth_mm = 8, seconds = 0.05 }, { do = \"hold\", seconds = 0.05 }]\n");
  const auto felt = support::runPalpate("simulate scene.toml --no-pictures -o out", folder_.path());
  EXPECT_EQ(felt.exit_code, 0) << felt.err;
}

TEST_F(MeasureStiffness, ARefusedPlaceEndsWithOneAndIsNotWritten) {
  put("f.csv", "place,x_mm,y_mm,depth_mm,force_n\n" + forceRows("good,0,73", 0.4) + forceRows("bad,0,-173", -0.7));
  const json found = runForJson("stiffness f.csv -o keys.csv", 1);
  EXPECT_EQ(found["places"].at(1)["refused"], true);
  EXPECT_NE(found["places"].at(1)["reason"].get<std::string>().find("pulls"), std::string::npos);
  EXPECT_EQ(maps::readKeyPoints(folder_ / "keys.csv").size(), 1u);
}

using MeasureStencil = MeasureTables;

TEST_F(MeasureStencil, WritesASheetOrItsTiles) {
  EXPECT_EQ(measure("stencil -o s.svg").out, "-> s.svg\n");
  EXPECT_NE(contentOf(folder_ / "s.svg").find("width=\"420mm\""), std::string::npos);
  EXPECT_EQ(measure("stencil -o s.svg --page tiled-a4").out,
            "-> s-r1c1.svg\n-> s-r1c2.svg\n-> s-r2c1.svg\n-> s-r2c2.svg\n");
  EXPECT_EQ(runForError("stencil -o s.pdf"), "palpate: s.pdf: a stencil's name must end in .svg\n");
  EXPECT_NE(runForError("stencil -o s.svg --page a4").find("a4 has 210 x 297; use a2, tiled-a4"), std::string::npos);
}

using MeasureSession = MeasureTables;

TEST_F(MeasureSession, ANewFolderTakesPlacesInWordsAndNoNames) {
  const json begun = runForJson("session P07 --init --person P07 --points P1=T5,P2=-40:12.5 --presses 2");
  EXPECT_EQ(begun["written"].size(), 3u);
  const std::string protocol = contentOf(folder_ / "P07/protocol.toml");
  EXPECT_NE(protocol.find("at = \"T5\""), std::string::npos);
  EXPECT_NE(protocol.find("x_mm = -40\ny_mm = 12.5"), std::string::npos);
  EXPECT_NE(runForError("session P07 --init --person P07 --points P1=0:0").find("is not replaced"), std::string::npos);
  EXPECT_NE(runForError("session Q --init --person Anna").find("and no name"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "Q"));
  EXPECT_NE(runForError("session Q").find("begin with --init"), std::string::npos);
  EXPECT_NE(runForError("session Q --init --person P1 --points T5").find("NAME=PLACE"), std::string::npos);
}

TEST_F(MeasureSession, AnEmptyFolderIsIncompleteAndSaysWhatIsMissing) {
  runForJson("session P07 --init --person P07 --points P1=0:73 --presses 1 --enough 1");
  const json walked = runForJson("session P07", 1);
  EXPECT_EQ(walked["complete"], false);
  ASSERT_EQ(walked["presses"].size(), 2u);
  EXPECT_EQ(walked["presses"].at(0)["state"], "missing");
  EXPECT_EQ(walked["presses"].at(0)["missing"].at(1), "P1_up_1_after");
  EXPECT_EQ(walked["written"].size(), 0u);
  const CommandResult text = measure("session P07");
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_NE(text.out.find("more are needed"), std::string::npos);
  EXPECT_NE(runForError("session P07 --accept P1_up_1").find("was not measured"), std::string::npos);
}

TEST_F(MeasureSession, APictureThatIsNoneIsWrongInputByName) {
  runForJson("session P07 --init --person P07 --points P1=0:73 --presses 1 --enough 1");
  put("P07/P1_up_1_before.jpg", "not a picture");
  put("P07/P1_up_1_after.jpg", "not a picture");
  EXPECT_NE(runForError("session P07").find("P1_up_1_before.jpg"), std::string::npos);
}

}  // namespace
}  // namespace palpate
