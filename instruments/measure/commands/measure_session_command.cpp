// `palpate measure session DIR`: a person's folder from the protocol to the map and the scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/body_place.h"
#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "measure/commands/commands.h"
#include "measure/commands/dots_report.h"
#include "measure/pages/photograph_overlay.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/overlay.h"
#include "palpate/measure/person/person_folder.h"
#include "palpate/measure/photograph.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;
using measure::PersonWalk;
using measure::Protocol;
using measure::WalkedPress;
struct MeasureSessionArguments {
  std::string folder;
  bool init = false;
  std::string person;
  std::vector<std::string> points;
  std::vector<std::string> drags = {"up", "right"};
  Protocol protocol;
  measure::WalkDecisions decisions;
  bool json = false;
};

// --- a new folder

/// "T5" on the built-in body, or "X:Y" in mm.
Vec2 placeOfPoint(const std::string& words, std::shared_ptr<const scene::World>& world) {
  const auto numbers = split(words, ':');
  if (numbers.size() == 2) {
    const Limits limits = between(-kFarthestMm, kFarthestMm, "mm");
    return {numberFrom("--points", std::string(numbers[0]), limits),
            numberFrom("--points", std::string(numbers[1]), limits)};
  }
  if (!world) {
    ProgressLine progress;
    world = scene::build(scene::standardScene(), progress.callback());
  }
  const Vec3 place = pointOn(*world, bodyPlaceFrom("--points", words));
  return {std::round(10.0 * place.x()) / 10.0, std::round(10.0 * place.y()) / 10.0};
}

/// P1 to P5 of the dissertation; P6 and P7 were mirror images there.
std::vector<measure::ProtocolPoint> dissertationPoints() {
  constexpr std::size_t kMeasured = 5;
  std::vector<measure::ProtocolPoint> points;
  for (const maps::KeyPoint& key : maps::dissertationKeyPoints()) {
    if (points.size() < kMeasured) points.push_back({key.name, "", key.position_mm});
  }
  return points;
}

std::vector<measure::ProtocolPoint> parsePoints(const std::vector<std::string>& words) {
  if (words.empty()) return dissertationPoints();
  std::vector<measure::ProtocolPoint> points;
  std::shared_ptr<const scene::World> world;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      throw UsageError("--points", "'" + oneLine(word) + "' must be NAME=PLACE, such as P1=T5");
    }
    const std::string place = word.substr(equals + 1);
    points.push_back({word.substr(0, equals), place, placeOfPoint(place, world)});
  }
  return points;
}

void runInit(const MeasureSessionArguments& arguments) {
  if (const std::string fault = measure::faultOfPerson(arguments.person); !fault.empty()) {
    throw UsageError("--person", fault);
  }
  Protocol protocol = arguments.protocol;
  protocol.person = arguments.person;
  protocol.points = parsePoints(arguments.points);
  for (const std::string& word : arguments.drags) {
    const auto degrees = measure::dragNamed(word);
    if (!degrees) throw UsageError("--drags", "'" + oneLine(word) + "' must be up, down, left or right");
    protocol.drags.push_back({word, *degrees});
  }
  const FinishesInOrder in_order;
  const std::vector<std::string> written = beginPerson(arguments.folder, protocol);
  if (arguments.json) {
    return fmt::print("{}\n", jsonDump(Json{{"person", protocol.person}, {"written", written}}, 2));
  }
  fmt::print("{}: {} pictures wanted (checklist.md)\n", protocol.person, 4 * plannedPresses(protocol).size());
  for (const std::string& file : written) fmt::print("-> {}\n", file);
}

// --- measuring

/// Measures as measurePictures does, and leaves overlay and report next to the pictures.
measure::PressOutcome measureWithOverlay(const fs::path& folder, const Protocol& protocol,
                                         const measure::PlannedPress& planned, const measure::PressPictures& pictures,
                                         const Progress& progress) {
  const measure::Photograph before = measure::readPhotograph(pictures.before);
  const measure::Photograph after = measure::readPhotograph(pictures.after);
  const measure::PressMeasured measured = measurePress(protocol, planned, pictures, before, after, progress);
  const MeasuredPair pair{.name = planned.name,
                          .files = {pictures.before.string(), pictures.after.string()},
                          .place_mm = planned.place_mm,
                          .null_drift_mm = measured.outcome.null_drift_mm};
  const FinishesInOrder in_order;
  const figures::OverlayPage page{.overlay = buildOverlay(measured.measurement), .before = &before, .after = &after};
  figures::writeOverlay(page, folder / (planned.name + "_overlay.png"));
  writeFile(folder / (planned.name + ".json"), jsonDump(reportJson(measured.measurement, pair), 1) + "\n");
  return measured.outcome;
}

// --- text

const char* pressStatus(const WalkedPress& press) {
  if (!press.outcome) return "missing";
  if (press.decision == measure::Decision::repeat) return "to repeat";
  if (press.outcome->accepted) return "accepted";
  return press.counts() ? "accepted by you" : "refused";
}

std::string pressText(const WalkedPress& press) {
  std::string text = fmt::format("{:<14}{:<16}", press.planned.name, pressStatus(press));
  if (!press.missing.empty()) return text + fmt::format("{}\n", fmt::join(press.missing, ", "));
  if (const auto fields = split(press.outcome->row, ','); fields.size() > 5) {
    const auto number = [&](std::size_t i) { return parseNumber(fields[i]).value_or(0.0); };
    text += fmt::format("{:.1f} mm, ratio {:.2f}, {:.0f} degrees", number(3), number(4), number(5));
  }
  if (press.outcome->null_drift_mm) text += fmt::format(", null {:.2f} mm", *press.outcome->null_drift_mm);
  text += press.fresh ? "  (new)\n" : "\n";
  for (const std::string& line : press.outcome->refusals) text += fmt::format("{:<14}refused: {}\n", "", line);
  for (const std::string& line : press.outcome->warnings) text += fmt::format("{:<14}warning: {}\n", "", line);
  return text;
}

std::string walkText(const PersonWalk& walk) {
  std::string text = fmt::format("{}: {} presses\n\n", walk.protocol.person, walk.presses.size());
  for (const WalkedPress& press : walk.presses) text += pressText(press);
  text += "\npoint     pulled    count  of\n";
  for (const measure::PointProgress& one : walk.progress()) {
    text += fmt::format("{:<10}{:<10}{:>5}{:>4}{}\n", one.point, one.drag, one.counting, one.enough,
                        one.counting < one.enough ? "  more are needed" : "");
  }
  for (const std::string& name : walk.strangers) text += fmt::format("note: {} belongs to no press\n", name);
  return text;
}

std::string resultText(const measure::PersonResult& result) {
  const auto sd = [](const measure::Estimate& estimate) {
    return std::isfinite(estimate.sd) ? fmt::format(" +- {:.2g}", estimate.sd) : std::string();
  };
  std::string text = "\n";
  for (const measure::PointMean& point : result.averages.points) {
    text += fmt::format("{:<10}{:.1f}{} mm, ratio {:.2f}{}, {:.0f}{} degrees{}\n", point.name,
                        point.mean.half_major_mm.value, sd(point.mean.half_major_mm), point.mean.major_over_minor.value,
                        sd(point.mean.major_over_minor), point.mean.direction_deg.value, sd(point.mean.direction_deg),
                        point.mean.hardly_determined ? ", direction hardly determined" : "");
    if (const std::string remark = dragRemark(point); !remark.empty()) text += fmt::format("{:<10}{}\n", "", remark);
  }
  for (const std::string& file : result.written) text += fmt::format("-> {}\n", file);
  return text;
}

// --- JSON

Json pressJson(const WalkedPress& press) {
  Json json = {{"name", press.planned.name},
               {"state", pressStatus(press)},
               {"counts", press.counts()},
               {"new", press.fresh},
               {"missing", press.missing}};
  if (press.outcome) {
    json["refusals"] = press.outcome->refusals;
    json["warnings"] = press.outcome->warnings;
    json["null_drift_mm"] = orNull(press.outcome->null_drift_mm);
    json["row"] = press.outcome->row;
  }
  return json;
}

Json walkJson(const PersonWalk& walk, const std::optional<measure::PersonResult>& result) {
  Json json = {{"person", walk.protocol.person}, {"complete", walk.complete()}};
  json["presses"] = Json::array();
  for (const WalkedPress& press : walk.presses) json["presses"].push_back(pressJson(press));
  json["progress"] = Json::array();
  for (const measure::PointProgress& one : walk.progress()) {
    json["progress"].push_back(
        {{"point", one.point}, {"drag", one.drag}, {"counting", one.counting}, {"enough", one.enough}});
  }
  json["strangers"] = walk.strangers;
  json["written"] = result ? result->written : std::vector<std::string>();
  return json;
}

void runWalk(const MeasureSessionArguments& arguments) {
  const fs::path folder = arguments.folder;
  if (!fs::exists(folder / measure::kProtocolFile)) {
    throw Error::inFile(arguments.folder,
                        fmt::format("has no {}: begin with --init --person CODE", measure::kProtocolFile));
  }
  ProgressLine progress;
  const auto measure_press = [&](const Protocol& protocol, const measure::PlannedPress& planned,
                                 const measure::PressPictures& pictures, const Progress& said) {
    return measureWithOverlay(folder, protocol, planned, pictures, said);
  };
  const PersonWalk walk = walkPerson(folder, measure_press, arguments.decisions, progress.callback());
  std::optional<measure::PersonResult> result;
  if (walk.complete()) {
    const FinishesInOrder in_order;
    result = writePerson(walk, progress.display());
  }
  progress.clear();
  if (arguments.json) {
    fmt::print("{}\n", jsonDump(walkJson(walk, result), 2));
  } else {
    fmt::print("{}{}", walkText(walk), result ? resultText(*result) : std::string());
  }
  if (!walk.complete()) throw ExitWith(1);
}

void addInitOptions(Command& command, MeasureSessionArguments& a) {
  Option* init = command.add_flag("--init", a.init, "Begin a new folder: write protocol.toml, stencil and checklist");
  const auto of_init = [&](Option* option) { option->needs(init); };
  of_init(command.add_option("--person", a.person, "Code of the person, with a digit, such as P07; never a name"));
  of_init(command
              .add_option("--points", a.points,
                          "Points to measure, NAME=PLACE,...: P1=T5,P4=-100:5 (default: P1 to P5 of the dissertation)")
              ->delimiter(',')
              ->allow_extra_args(false)
              ->type_name("NAME=PLACE"));
  of_init(command.add_option("--drags", a.drags, "Drag directions: up, down, left, right; two at right angles")
              ->delimiter(',')
              ->allow_extra_args(false)
              ->capture_default_str());
  of_init(addSetting(command, "--presses", a.protocol.presses, between(1, 99), "Presses of each drag at each point"));
  of_init(addSetting(command, "--enough", a.protocol.enough, between(1, 99),
                     "Presses that must count, of each drag at each point"));
  of_init(
      addSetting(command, "--spacing-mm", a.protocol.spacing_mm, between(5.0, 100.0, "mm"), "Spacing of the stencil"));
}

}  // namespace

void addMeasureSessionCommand(Command& parent) {
  const auto [command, a] = addCommand<MeasureSessionArguments>(
      parent, "session", "Measure the new pictures in a person's folder and, when complete, write the map and scene",
      [](const MeasureSessionArguments& given) { given.init ? runInit(given) : runWalk(given); });
  command.add_option("folder", a.folder, "Folder with protocol.toml and the pictures (docs/howto/measure-a-person.md)")
      ->required();
  addInitOptions(command, a);
  command.add_option("--accept", a.decisions.accept, "Presses to count although they were refused: P1_up_1,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("PRESS");
  command
      .add_option("--repeat", a.decisions.repeat, "Presses to repeat: they do not count until they have new pictures")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("PRESS");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
