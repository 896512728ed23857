// `palpate recording plot forces.csv`: what a recorded or simulated run felt, as a picture over time.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "palpate/base/error.h"
#include "palpate/trace/forces_table.h"
#include "report/charts/picture_file.h"
#include "report/commands.h"
#include "report/plot/forces_plot.h"

namespace palpate::app {

namespace {

constexpr const char* kStatesWord = "states";

struct PlotArguments {
  std::filesystem::path table;
  std::filesystem::path output = "plot.png";
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  std::vector<std::string> fingers;  ///< empty: all
  std::vector<std::string> columns = {"force", "depth", "lag", kStatesWord};
  std::string title;
  double png_scale = 1.5;
};

RunStrip* findStrip(std::vector<RunStrip>& strips, std::string_view finger) {
  const auto found = std::ranges::find(strips, finger, &RunStrip::finger);
  return found == strips.end() ? nullptr : &*found;
}

std::string joinFingerNames(const std::vector<RunStrip>& strips) {
  std::string names;
  for (const RunStrip& strip : strips) names += (names.empty() ? "" : ", ") + strip.finger();
  return names;
}

/// The requested strips, in the order of the table. Throws Error for one that is not in it, and where no row lies
/// between the two times.
std::vector<RunStrip> chosen(const PlotArguments& arguments, std::vector<RunStrip> strips, const std::string& known) {
  for (const std::string& finger : arguments.fingers) {
    if (findStrip(strips, finger) != nullptr) continue;
    throw Error::inFile(arguments.table.string(), fmt::format("has no finger \"{}\"; it has {}", finger, known));
  }
  std::erase_if(strips, [&](const RunStrip& strip) {
    const bool named = arguments.fingers.empty() || std::ranges::count(arguments.fingers, strip.finger()) > 0;
    return !named || strip.steps().empty();
  });
  return strips;
}

std::vector<RunStrip> readStrips(const PlotArguments& arguments) {
  std::vector<RunStrip> strips;
  double first_s = std::numeric_limits<double>::infinity();
  double last_s = -first_s;
  trace::forEachForcesRow(arguments.table, [&](const trace::ForcesRow& row) {
    first_s = std::min(first_s, row.time_s);
    last_s = std::max(last_s, row.time_s);
    RunStrip* strip = findStrip(strips, row.finger);
    if (strip == nullptr) strip = &strips.emplace_back(std::string(row.finger));
    if (row.time_s >= arguments.from_s && row.time_s <= arguments.to_s) strip->add(feltIn(row));
  });
  const std::string known = joinFingerNames(strips);
  strips = chosen(arguments, std::move(strips), known);
  if (!strips.empty()) return strips;
  throw Error::inFile(arguments.table.string(),
                      fmt::format("has no rows between --from and --to; it covers {} to {} s", first_s, last_s));
}

ForcesPlot makeForcesPlot(const PlotArguments& arguments) {
  ForcesPlot plot{.title = arguments.title.empty() ? arguments.table.filename().string() : arguments.title,
                  .felts = {},
                  .states = false};
  for (const std::string& column : arguments.columns) {
    if (column == kStatesWord) {
      plot.states = true;
    } else {
      plot.felts.push_back(*choiceNamed<Felt>(column));
    }
  }
  return plot;
}

void runPlot(const PlotArguments& arguments) {
  checkPictureName(arguments.output);
  if (!(arguments.from_s < arguments.to_s)) throw Error("plot: --from must be below --to");
  const std::vector<RunStrip> strips = readStrips(arguments);
  const figures::Figure figure = forcesFigure(makeForcesPlot(arguments), strips);
  writePicture(figure, arguments.output, arguments.png_scale);
  fmt::print("{}: {} -> {}\n", arguments.table.string(), joinFingerNames(strips), arguments.output.string());
}

std::vector<std::string> columnNames() {
  std::vector<std::string> words;
  for (const auto& [word, felt] : makeChoices<Felt>()) words.push_back(word);
  words.emplace_back(kStatesWord);
  return words;
}

}  // namespace

void addPlotCommand(Command& recording) {
  const auto [command, a] =
      addCommand(recording, "plot", "Plot a table of forces over time: force, depth, lag, states", runPlot);
  command.add_option("TABLE", a.table, "forces.csv of `palpate simulate` or of the window")->required();
  namesFileToWrite(command.add_option("-o,--out", a.output, "Picture to write: .png or .svg"))->capture_default_str();
  addNumber(command, "--from", a.from_s, between(-1e9, 1e9, "s"), "Begin at this time (default: with the first row)");
  addNumber(command, "--to", a.to_s, between(-1e9, 1e9, "s"), "End at this time (default: with the last row)");
  command.add_option("--finger", a.fingers, "Only this finger, by its name; repeatable")->allow_extra_args(false);
  restrictTo(
      columnNames(),
      command
          .add_option(
              "--columns", a.columns,
              "Panels from the top: force (N), device (N, after the safety limits), depth (mm), lag (mm, from the "
              "tip to the skin that friction holds), speed (mm/s), states (stick, slip, status bits)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->capture_default_str());
  command.add_option("--title", a.title, "Title above the plot (default: the table's name)");
  addSetting(command, "--png-scale", a.png_scale, between(0.2, 8.0), "PNG: pixels per CSS pixel");
}

}  // namespace palpate::app
