// `palpate measure synthesize`: photographs of a back that was never there, with the truth that they show; for tests,
// for teaching, and to test a way of taking pictures.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/kit/choice_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "measure/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/made_folder.h"
#include "palpate/measure/synthesis/synthetic_files.h"

namespace palpate::app {

namespace {

using measure::SyntheticCase;
using measure::TailFamily;

/// Values that are not given are drawn from the seed.
struct SynthesizeArguments {
  std::string folder;
  std::int64_t seed = 1;
  double megapixels = 2.0;
  double drift_mm = 0.3;
  std::optional<TailFamily> tail;
  std::optional<double> half_major_mm;
  std::optional<double> ratio;
  std::optional<double> direction_deg;
  std::optional<double> drag_deg;
  std::optional<double> peak_mm;
  std::optional<double> tail_power;
  std::optional<double> asymmetry_percent;
  std::vector<double> contact_mm;
  std::optional<double> tilt_deg;
  std::optional<double> roll_deg;
  std::optional<double> blur_px;
  std::optional<double> jitter_mm;
  std::optional<int> columns;
  std::optional<int> rows;
  std::optional<int> missing;
  std::optional<int> strays;
  bool json = false;
};

const Choices<TailFamily>& tails() {
  static const Choices<TailFamily> all = [] {
    Choices<TailFamily> choices;
    for (const TailFamily family :
         {TailFamily::compact, TailFamily::long_tail, TailFamily::half_space, TailFamily::windowed_half_space}) {
      choices.emplace_back(std::string(nameOf(family)), family);
    }
    return choices;
  }();
  return all;
}

template <class Value, class Request>
void applyRequest(Value& value, const std::optional<Request>& request, double factor = 1.0) {
  if (request) value = static_cast<Value>(*request * factor);
}

void changePress(const SynthesizeArguments& arguments, measure::Press& press) {
  applyRequest(press.half_major_mm, arguments.half_major_mm);
  applyRequest(press.ratio, arguments.ratio);
  applyRequest(press.direction_rad, arguments.direction_deg, kRadPerDeg);
  applyRequest(press.drag_rad, arguments.drag_deg, kRadPerDeg);
  applyRequest(press.peak_mm, arguments.peak_mm);
  applyRequest(press.tail_power, arguments.tail_power);
  applyRequest(press.asymmetry, arguments.asymmetry_percent, 0.01);
  if (!arguments.contact_mm.empty()) press.contact_mm = {arguments.contact_mm[0], arguments.contact_mm[1]};
  if (press.peak_mm > 0.0) return;
  press.dent_mm = 0.0;  // no press, so no stick in the picture
  press.stick = false;
}

void changeMarks(const SynthesizeArguments& arguments, measure::DotMarks& marks) {
  applyRequest(marks.missing, arguments.missing);
  applyRequest(marks.strays, arguments.strays);
  applyRequest(marks.jitter_mm, arguments.jitter_mm);
  if (!arguments.columns && !arguments.rows) return;
  applyRequest(marks.columns, arguments.columns);
  applyRequest(marks.rows, arguments.rows);
  marks.corner_mm = -0.5 * marks.spacing_mm * Vec2(marks.columns - 1, marks.rows - 1);
}

SyntheticCase caseFor(const SynthesizeArguments& arguments) {
  if (arguments.contact_mm.size() == 1) throw UsageError("--contact-mm", "expected two numbers, x,y");
  SyntheticCase made =
      measure::drawCase(static_cast<std::uint64_t>(arguments.seed),
                        {.megapixels = arguments.megapixels, .family = arguments.tail, .drift_mm = arguments.drift_mm});
  changePress(arguments, made.press);
  changeMarks(arguments, made.marks);
  applyRequest(made.camera.tilt_rad, arguments.tilt_deg, kRadPerDeg);
  applyRequest(made.camera.roll_rad, arguments.roll_deg, kRadPerDeg);
  applyRequest(made.look.blur_px, arguments.blur_px);
  return made;
}

void printResult(const SynthesizeArguments& arguments, const std::vector<std::filesystem::path>& files,
                 const SyntheticCase& made) {
  const measure::SyntheticTruth truth = computeTruth(made);
  const measure::KeyEllipse& ellipse = truth.at_2_mm;
  if (arguments.json) {
    Json json = {{"folder", arguments.folder}, {"files", Json::array()}};
    for (const auto& file : files) json["files"].push_back(file.filename().string());
    const Json written = Json::parse(measure::truthJson(made, truth));
    for (const auto& [name, value] : written.items()) {
      if (name != "dots") json["truth"][name] = value;
    }
    fmt::print("{}\n", jsonDump(json, 1));
    return;
  }
  for (const auto& file : files) fmt::print("-> {}\n", file.string());
  fmt::print("{} x {} px, {} tail, moved by {:.1f} mm at most, along {:.0f} degrees\n", made.width_px, made.height_px,
             nameOf(made.press.family), made.press.peak_mm, truth.drag_deg);
  if (ellipse.half_major_mm.value == 0.0) return fmt::print("nothing moves by 2 mm\n");
  fmt::print("ellipse of 2 mm: {:.1f} x {:.1f} mm (half axes), major axis at {:.1f} degrees\n",
             ellipse.half_major_mm.value, ellipse.half_minor_mm.value, ellipse.direction_deg.value);
}

void runSynthesize(const SynthesizeArguments& arguments) {
  const auto made = caseFor(arguments);
  const std::filesystem::path folder = arguments.folder;
  const MadeFolder made_folder(folder);
  ProgressLine progress;
  const auto files = writeSynthetic(folder, made, progress.callback());
  progress.clear();
  printResult(arguments, files, made);
}

void addPressOptions(Command& command, SynthesizeArguments& arguments) {
  const auto choose = [&arguments](const std::string& word) {
    for (const auto& [name, family] : tails()) {
      if (name == word) arguments.tail = family;
    }
  };
  restrictTo(choiceNames(tails()),
             command.add_option_function(
                 "--tail", choose,
                 "Fall-off of the motion: the half Gaussian, a long tail, an elastic half space, or one that ends"));
  addNumber(command, "--half-major-mm", arguments.half_major_mm, between(20.0, 300.0, "mm"),
            "Half major axis of the ellipse of 2 mm; for a half space, its reach along the drag");
  addNumber(command, "--ratio", arguments.ratio, between(1.0, 4.0), "Major over minor axis");
  addNumber(command, "--direction-deg", arguments.direction_deg, between(-180.0, 180.0, "degrees"),
            "Direction of the major axis, from the right towards the head");
  addNumber(command, "--drag-deg", arguments.drag_deg, between(-180.0, 180.0, "degrees"),
            "Direction of the drag, from the right towards the head");
  addNumber(command, "--peak-mm", arguments.peak_mm, between(0.0, 40.0, "mm"),
            "Motion of the skin under the stick; 0: nothing is pressed");
  addNumber(command, "--tail-power", arguments.tail_power, between(0.5, 5.0),
            "P of a long tail; a smaller P makes it longer");
  addNumber(command, "--asymmetry-percent", arguments.asymmetry_percent, between(-50.0, 50.0, "%"),
            "How much more the skin moves behind the stick than in front of it");
  addNumber(command, "--contact-mm", arguments.contact_mm, between(-200.0, 200.0, "mm"),
            "Position of the stick on the skin, x,y from the middle of the back")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
}

void addPictureOptions(Command& command, SynthesizeArguments& arguments) {
  addSetting(command, "--drift-mm", arguments.drift_mm, between(0.0, 20.0, "mm"),
             "Motion of the body between the pictures (sd): 0.3 with the breath held, 1.5 breathing");
  addNumber(command, "--tilt-deg", arguments.tilt_deg, between(0.0, 45.0, "degrees"),
            "Tilt of the camera from the vertical over the back");
  addNumber(command, "--roll-deg", arguments.roll_deg, between(-180.0, 180.0, "degrees"),
            "Roll of the camera about its line of sight");
  addNumber(command, "--blur-px", arguments.blur_px, between(0.0, 30.0, "px"), "Blur of the pictures (sd)");
  addNumber(command, "--jitter-mm", arguments.jitter_mm, between(0.0, 10.0, "mm"),
            "Displacement of marks at random (sd)");
  addNumber(command, "--columns", arguments.columns, between(1, 30), "Columns of dots; centres the grid");
  addNumber(command, "--rows", arguments.rows, between(1, 30), "Rows of dots");
  addNumber(command, "--missing", arguments.missing, between(0, 400), "Number of missing dots");
  addNumber(command, "--strays", arguments.strays, between(0, 200), "Number of stray marks in the same ink");
}

}  // namespace

void addMeasureSynthesizeCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "synthesize",
                 "Paint photographs of a dotted back before and after a press (before.jpg, before2.jpg, after.jpg) and "
                 "write the truth (truth.json); options not given are drawn from the seed",
                 runSynthesize);
  namesFolderToWrite(command.add_option("-o,--out", arguments.folder, "Folder to write to, created if missing"))
      ->required();
  addSetting(command, "--seed", arguments.seed, between(0, 1e15), "Seed of the body, grid, press and camera");
  addSetting(command, "--megapixels", arguments.megapixels, between(0.5, 48.0),
             "Size of the pictures, with sides 3 to 4");
  addPressOptions(command, arguments);
  addPictureOptions(command, arguments);
  command.add_flag("--json", arguments.json, "Print the files and the truth, without the dots, as one JSON object");
}

}  // namespace palpate::app
