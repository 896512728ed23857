// `palpate recording plot` from the outside: which panels a table of forces gets, and which tables it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "palpate/servo/limiter.h"
#include "palpate/trace/forces_csv.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;

/// A press of two fingers, 0.6 s long: the right one presses harder and slips in the second half.
std::string pressedTable(int ticks = 600, double spike_n = 0.0) {
  trace::ForcesCsvSettings settings;
  settings.finger_names = {"left", "right"};
  std::string text = std::string(trace::forcesCsvHeader()) + "\n";
  for (int k = 0; k < ticks; ++k) {
    for (std::uint32_t finger = 0; finger < 2; ++finger) {
      trace::Sample sample;
      sample.tick = static_cast<std::uint64_t>(k);
      sample.finger = finger;
      sample.contact.depth_mm = 3.0 * (finger + 1.0) * std::sin(3.0 * k / ticks);
      sample.contact.force = {0.0, 0.0, 0.5 * sample.contact.depth_mm};
      sample.contact.touch = finger == 1 && k > ticks / 2 ? contact::Touch::slip : contact::Touch::stick;
      if (k == ticks / 3) sample.contact.force.z() += spike_n;
      if (finger == 1 && k % 100 == 7) sample.safety = servo::kClamped;
      trace::appendForcesRow(text, settings, sample);
    }
  }
  return text;
}

class PlotCommand : public ::testing::Test {
 protected:
  void SetUp() override { write("forces.csv", pressedTable()); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CommandResult plot(const std::string& arguments) const {
    return support::runPalpate("recording plot " + arguments, folder_.path());
  }
  /// Every text of the plot on a line of its own: the description of an SVG repeats them.
  std::string readSvgTexts(const std::string& arguments) const {
    const CommandResult result = plot(arguments + " -o plot.svg");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string svg = contentOf(folder_ / "plot.svg");
    const std::size_t begin = svg.find("<desc>") + 6;
    return "\n" + svg.substr(begin, svg.find("</desc>") - begin);
  }
  static bool has(const std::string& texts, const std::string& text) {
    return texts.find("\n" + text + "\n") != std::string::npos;
  }
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = plot(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(!result.err.empty() && result.err.find('\n') == result.err.size() - 1) << "one line: " << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plot.png"));
    return result.err;
  }

  support::TemporaryFolder folder_;
};

TEST_F(PlotCommand, HasForceDepthLagAndStatesWithUnits) {
  const std::string texts = readSvgTexts("forces.csv");
  for (const char* text : {"forces.csv", "force (N)", "depth (mm)", "lag of the skin (mm)", "time (s)", "left", "right",
                           "left sticks", "right slips", "right force clamped"}) {
    EXPECT_TRUE(has(texts, text)) << text;
  }
  EXPECT_FALSE(has(texts, "left force clamped")) << "only what was";
}

TEST_F(PlotCommand, ShowsWhatIsAskedFor) {
  const std::string depth = readSvgTexts("forces.csv --columns depth,speed --finger right --title Monday");
  for (const char* text : {"depth (mm)", "speed (mm/s)", "Monday", "right"}) EXPECT_TRUE(has(depth, text)) << text;
  for (const char* text : {"force (N)", "left", "right slips"}) EXPECT_FALSE(has(depth, text)) << text;
  const std::string part = readSvgTexts("forces.csv --from 0.1 --to 0.25 --columns states");
  EXPECT_TRUE(has(part, "right sticks"));
  EXPECT_TRUE(has(part, "0.25") || has(part, "0.24")) << part;
  EXPECT_FALSE(has(part, "0.5")) << "the axis ends where it was asked to";
  ASSERT_EQ(plot("forces.csv").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "plot.png").substr(1, 3), "PNG");
}

TEST_F(PlotCommand, ASpikeOfOneTickIsSeenInALongRun) {
  write("long.csv", pressedTable(9000, 40.0));
  const std::string texts = readSvgTexts("long.csv --columns force --finger left");
  EXPECT_TRUE(has(texts, "40")) << "the axis reaches to the spike: " << texts;
  EXPECT_NE(texts.find("the least and the greatest of 8 ticks"), std::string::npos);
}

TEST_F(PlotCommand, NamesTheLineOfWhatItCannotRead) {
  write("path.csv", "t_s,x_mm,y_mm,z_mm\n0,1,2,3\n");
  EXPECT_EQ(runForError("path.csv"),
            "palpate: path.csv:1: must be a table of forces: column 2 is 'x_mm'; expected finger\n");
  std::string text = pressedTable();
  write("cut.csv", text.substr(0, text.size() - 30));
  EXPECT_NE(runForError("cut.csv").find("cut.csv:1201: the table ends in this row, after "), std::string::npos);
  text.replace(text.find(",stick,"), 7, ",stock,");
  write("typo.csv", text);
  EXPECT_EQ(runForError("typo.csv"), "palpate: typo.csv:2: state must be free, stick or slip; got 'stock'\n");
  write("empty.csv", std::string(trace::forcesCsvHeader()) + "\n");
  EXPECT_EQ(runForError("empty.csv"), "palpate: empty.csv: has no rows\n");
  EXPECT_NE(runForError("missing.csv").find("missing.csv"), std::string::npos);
}

TEST_F(PlotCommand, NamesWhatIsWrongOnTheCommandLine) {
  EXPECT_EQ(runForError("forces.csv --finger middle"),
            "palpate: forces.csv: has no finger \"middle\"; it has left, right\n");
  EXPECT_EQ(runForError("forces.csv --from 5"),
            "palpate: forces.csv: has no rows between --from and --to; it covers 0 to 0.599 s\n");
  EXPECT_EQ(runForError("forces.csv --from 2 --to 1"), "palpate: plot: --from must be below --to\n");
  EXPECT_EQ(runForError("forces.csv -o plot.jpg"), "palpate: plot.jpg: a plot's name must end in .png or .svg\n");
  EXPECT_NE(runForError("forces.csv --columns force,weight").find("--columns"), std::string::npos);
}

}  // namespace
}  // namespace palpate
