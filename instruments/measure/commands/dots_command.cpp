// `palpate measure dots BEFORE AFTER` (or a table of dots): one press measured, with all objections.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "cli/kit/body_place.h"
#include "cli/kit/choice_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/results_folder.h"
#include "measure/commands/commands.h"
#include "measure/commands/dots_report.h"
#include "measure/pages/photograph_overlay.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/made_folder.h"
#include "palpate/base/text.h"
#include "palpate/measure/key_row.h"
#include "palpate/measure/overlay.h"
#include "palpate/measure/tables/dot_table.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "report/charts/picture_file.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;
using measure::HeadTowards;
using measure::Measurement;

/// More, and a long tail's half axes are wrong by tens of percent.
constexpr double kMaxNullDriftMm = 0.3;
constexpr const char* kKeyFile = "key_points.csv";
constexpr const char* kReportFile = "measurement.json";
constexpr const char* kOverlayFile = "overlay.png";
constexpr const char* kDotFile = "dots.csv";

struct DotsArguments {
  std::vector<std::string> input;
  std::string again;  ///< a second picture before the press
  measure::MeasureSettings settings;
  std::optional<double> drift_mm;
  std::vector<double> contact;
  std::string name = "P1";
  std::string at;
  std::string output;
  std::string overlay;
  double overlay_width_px = 1240.0;
  bool overwrite = false;
  bool json = false;
};

/// A measurement with the pictures that the overlay needs.
struct Measuring {
  std::optional<measure::Photograph> before;
  std::optional<measure::Photograph> after;
  Measurement result;
  MeasuredPair pair;
};

bool isTable(const DotsArguments& arguments) {
  return arguments.input.size() == 1 && fs::path(arguments.input[0]).extension() == ".csv";
}

// --- where the results go -------------------------------------------------------------------------------------------

struct Outputs {
  fs::path folder;  ///< empty: no folder
  fs::path key_points;
  fs::path report;
  fs::path dots;
  fs::path overlay;
};

void refuseOccupied(const fs::path& folder) {
  std::vector<std::string> earlier;
  for (const char* name : {kKeyFile, kReportFile, kOverlayFile, kDotFile}) {
    if (fs::exists(folder / name)) earlier.emplace_back(name);
  }
  if (earlier.empty()) return;
  throw Error::inFile(folder.string(),
                      fmt::format("holds another measurement ({}): --overwrite replaces it, --out {} is free",
                                  fmt::join(earlier, ", "), freshFolder(folder).string()));
}

Outputs resolveOutputs(const DotsArguments& arguments) {
  Outputs outputs;
  const fs::path out = arguments.output;
  const std::string extension = out.extension().string();
  if (extension == ".csv") {
    outputs.key_points = out;
  } else if (extension == ".json") {
    outputs.report = out;
  } else if (extension == ".png" || extension == ".svg") {
    outputs.overlay = out;
  } else if (!out.empty()) {
    if (fs::exists(out) && !fs::is_directory(out)) throw Error::inFile(out.string(), "is a file, not a folder");
    if (!arguments.overwrite) refuseOccupied(out);
    outputs = {out, out / kKeyFile, out / kReportFile, out / kDotFile, out / kOverlayFile};
  }
  if (!out.empty()) outputs.folder.empty() ? requireWritableFile(out) : requireWritableFolder(out);
  if (!arguments.overlay.empty()) outputs.overlay = arguments.overlay;
  if (!outputs.overlay.empty()) checkPictureName(outputs.overlay);
  return outputs;
}

void writeOverlayPage(const Measuring& measuring, const fs::path& file, double width_px) {
  constexpr double kPageWidth = 1240.0;
  const figures::OverlayPage page{.overlay = buildOverlay(measuring.result),
                                  .before = measuring.before ? &*measuring.before : nullptr,
                                  .after = measuring.after ? &*measuring.after : nullptr,
                                  .width_px = kPageWidth};
  figures::writeOverlay(page, file, width_px / kPageWidth);
}

std::vector<std::string> write(const DotsArguments& arguments, const Outputs& outputs, const Measuring& measuring) {
  const FinishesInOrder in_order;  // a folder with half of the files would look like a measurement
  const MadeFolder made(outputs.folder);
  std::vector<std::string> written;
  const auto writes = [&](const fs::path& file, const auto& work) {
    if (file.empty()) return;
    work();
    written.push_back(file.string());
  };
  writes(outputs.overlay, [&] { writeOverlayPage(measuring, outputs.overlay, arguments.overlay_width_px); });
  writes(outputs.dots, [&] { writeFile(outputs.dots, formatDotTable(measuring.result)); });
  writes(outputs.key_points, [&] { writeFile(outputs.key_points, keyTable(measuring.result, measuring.pair)); });
  writes(outputs.report,
         [&] { writeFile(outputs.report, jsonDump(reportJson(measuring.result, measuring.pair), 1) + "\n"); });
  return written;
}

// --- arguments  ----------------------------------------------------------------------------------------------

/// "-100,55", or the words of an examiner on the body that has no name.
std::optional<Vec2> placeFrom(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const bool two_numbers = std::count(text.begin(), text.end(), ',') == 1 && text.find(' ') == std::string::npos;
  if (two_numbers || meansNumbers(text)) {
    const auto numbers = numbersFrom("--at", text, between(-kFarthestMm, kFarthestMm, "mm"));
    if (numbers.size() < 2 || numbers.size() > 3) throw UsageError("--at", "expected X,Y or a place such as 'T6'");
    return Vec2(numbers[0], numbers[1]);
  }
  const BodyPlace place = bodyPlaceFrom("--at", text);
  ProgressLine progress;
  const auto world = scene::build(scene::standardScene(), progress.callback());
  return Vec2(pointOn(*world, place).head<2>());
}

void check(const DotsArguments& arguments) {
  if (const std::string fault = measure::faultOfKeyName(arguments.name); !fault.empty()) {
    throw UsageError("--name", fault);
  }
  if (isTable(arguments)) {
    if (!arguments.again.empty()) throw UsageError("--null", "needs photographs, not a table of dots");
    return;
  }
  if (arguments.input.size() == 2) return;
  throw UsageError("measure dots", "expected two photographs, before and after, or one table of dots (.csv)");
}

measure::MeasureSettings settingsOf(const DotsArguments& arguments) {
  measure::MeasureSettings settings = arguments.settings;
  settings.drift_mm = arguments.drift_mm.value_or(settings.drift_mm);
  if (!arguments.contact.empty()) settings.contact_px = Vec2(arguments.contact[0], arguments.contact[1]);
  return settings;
}

void requireInside(const measure::MeasureSettings& settings, const measure::Photograph& picture) {
  if (!settings.contact_px) return;
  const Vec2& place = *settings.contact_px;
  if (place.x() >= 0.0 && place.y() >= 0.0 && place.x() < picture.width_px && place.y() < picture.height_px) return;
  throw Error(fmt::format("--contact: {:g},{:g} is outside the picture of {} x {} pixels", place.x(), place.y(),
                          picture.width_px, picture.height_px));
}

// --- measuring ------------------------------------------------------------------------------------------------------

measure::Photograph read(const std::string& file, MeasuredPair& pair) {
  measure::Photograph picture = measure::readPhotograph(file);
  for (const std::string& note : picture.notes) pair.notes.push_back(fmt::format("{}: {}", file, note));
  return picture;
}

/// The drift of two pictures of which neither is pressed, and what follows from it.
std::optional<measure::Finding> measureNull(const DotsArguments& arguments, Measuring& measuring,
                                            measure::MeasureSettings& settings) {
  if (arguments.again.empty()) return std::nullopt;
  const measure::Photograph again = read(arguments.again, measuring.pair);
  const auto drift = measure::nullDrift(*measuring.before, again, settings);
  if (!drift) {
    return measure::Finding{
        measure::Severity::warning, "null_unread",
        "How far the body moved by itself is unknown: the two pictures before show no common grid of dots."};
  }
  measuring.pair.null_drift_mm = drift;
  if (!arguments.drift_mm) settings.drift_mm = std::max(settings.drift_mm, *drift);
  if (*drift < kMaxNullDriftMm + 0.005) return std::nullopt;  // as it is printed
  return measure::Finding{
      measure::Severity::warning, "null_drift",
      fmt::format(
          "The body moved {:.2f} mm between the two pictures before, more than {} mm: hold the breath and repeat.",
          *drift, kMaxNullDriftMm)};
}

void measurePhotographs(const DotsArguments& arguments, Measuring& measuring) {
  ProgressLine progress;
  progress.show("reading the pictures", 0.0);
  measuring.before = read(arguments.input[0], measuring.pair);
  measuring.after = read(arguments.input[1], measuring.pair);
  measure::MeasureSettings settings = settingsOf(arguments);
  requireInside(settings, *measuring.before);
  throwIfInterrupted();
  const auto null_finding = measureNull(arguments, measuring, settings);
  measuring.result = measurePair(*measuring.before, *measuring.after, settings, progress.callback());
  if (null_finding) measuring.result.findings.push_back(*null_finding);
  if (measuring.before->taken_at_s && measuring.after->taken_at_s) {
    measuring.pair.seconds_between = *measuring.after->taken_at_s - *measuring.before->taken_at_s;
  }
}

void measureTable(const DotsArguments& arguments, Measuring& measuring) {
  ProgressLine progress;
  measuring.result = measureDots(measure::readDotTable(arguments.input[0]), settingsOf(arguments), progress.callback());
}

void run(const DotsArguments& arguments) {
  check(arguments);
  const Outputs outputs = resolveOutputs(arguments);
  Measuring measuring;
  measuring.pair.name = arguments.name;
  measuring.pair.files = arguments.input;
  measuring.pair.place_mm = placeFrom(arguments.at);
  isTable(arguments) ? measureTable(arguments, measuring) : measurePhotographs(arguments, measuring);
  const std::vector<std::string> written = write(arguments, outputs, measuring);
  if (arguments.json) {
    auto report = reportJson(measuring.result, measuring.pair);
    report["files"] = written;
    fmt::print("{}\n", jsonDump(report, 2));
  } else {
    fmt::print("{}", reportText(measuring.result, measuring.pair));
    if (!written.empty()) fmt::print("  -> {}\n", fmt::join(written, ", "));
  }
  if (!measuring.result.accepted()) throw ExitWith(1);
}

void addMeasureOptions(Command& command, DotsArguments& a) {
  addSetting(command, "--spacing-mm", a.settings.spacing_mm, between(5.0, 100.0, "mm"),
             "Spacing of the stencil, from dot to dot; the pictures do not show it");
  command.add_option("--null", a.again, "Second picture before the press, to measure how far the body moves by itself");
  addNumber(command, "--drift-mm", a.drift_mm, between(0.01, 20.0, "mm"),
            "How far the body may have moved between the pictures (sd) (default: 0.4, or what --null found)");
  addNumber(command, "--contact", a.contact, between(-1e5, 1e5, "px"),
            "Marked contact in the first picture, X,Y from its top left pixel")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  addChoice(command, "--up", a.settings.head,
            Choices<HeadTowards>{{"top", HeadTowards::top},
                                 {"left", HeadTowards::left},
                                 {"bottom", HeadTowards::bottom},
                                 {"right", HeadTowards::right}},
            "Edge of the pictures towards the head");
  command.add_flag("--partial", a.settings.partial,
                   "Accept an ellipse that extends beyond the dots, with its uncertainty");
}

void addOutputOptions(Command& command, DotsArguments& a) {
  command.add_option("--name", a.name, "Name of the key point; not the name of a person")->capture_default_str();
  command.add_option("--at", a.at,
                     "Position of the contact on the body: X,Y in mm (seen along z), or a place such as 'T6'");
  command.add_option("-o,--out", a.output,
                     "Folder for key_points.csv, measurement.json, overlay.png and dots.csv; or one file: .csv (key "
                     "points), .json, .png, .svg (overlay) (default: only print)");
  command.add_option("--overlay", a.overlay, "Overlay to write: .png or .svg (default: as --out says)");
  addSetting(command, "--overlay-width", a.overlay_width_px, between(600.0, 8000.0, "px"),
             "Width of the overlay as PNG");
  command.add_flag("--overwrite", a.overwrite, "Replace an earlier measurement in the folder");
  command.add_flag("--json", a.json, "Print everything as one JSON object");
}

}  // namespace

void addMeasureDotsCommand(Command& parent) {
  const auto [command, arguments] = addCommand(parent, "dots",
                                               "Measure the key ellipse of one press from photographs of dots before "
                                               "and after; exit code 1: refused, with the reason",
                                               run);
  command
      .add_option("input", arguments.input,
                  "Photographs BEFORE and AFTER (JPEG, PNG, TIFF), or one table of dots (.csv: "
                  "picture,x_px,y_px[,area_px])")
      ->required()
      ->expected(1, 2);
  addMeasureOptions(command, arguments);
  addOutputOptions(command, arguments);
}

}  // namespace palpate::app
