// `palpate study hunt`: random bodies and paths, checked by code that shares nothing with the finger; failing paths are
// made short and written as cases.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/commands.h"
#include "lab/hunt/hunt.h"
#include "lab/hunt/kept_case.h"
#include "palpate/base/error.h"
#include "report/page/figures_text.h"

namespace palpate::app {

namespace {

struct HuntArguments {
  std::size_t ticks = 1000000;
  double seconds = 0.0;  ///< 0: by ticks
  std::uint64_t seed = 1;
  std::vector<double> radii_mm;
  std::vector<std::string> meshes;
  double unit_mm = 0.0, fit_mm = -1.0;
  std::string group;
  bool generated = false;
  std::vector<std::string> kinds;
  std::size_t bodies = 0;
  double scale = 1.0;
  std::size_t lumps = 0;
  std::size_t threads = 0;
  std::string out;
  std::size_t keep = 6;
  std::vector<std::string> replay;
  bool json = false;
};

/// A file whose body is smaller or larger than a finger can make sense of is scaled to the size of a torso's half.
constexpr double kMinDiagonalMm = 20.0, kMaxDiagonalMm = 10000.0, kFittedDiagonalMm = 400.0;

/// `fit_mm` below 0: only where the size makes no sense. 0: never.
void fit(lab::NamedBody& body, double fit_mm) {
  const double diagonal = mesh::boundingBox(body.mesh).diagonal().norm();
  if (!std::isfinite(diagonal) || !(diagonal > 0.0) || fit_mm == 0.0) return;
  if (fit_mm < 0.0 && diagonal >= kMinDiagonalMm && diagonal <= kMaxDiagonalMm) return;
  const double factor = (fit_mm > 0.0 ? fit_mm : kFittedDiagonalMm) / diagonal;
  for (Vec3& p : body.mesh.positions) p *= factor;
  if (fit_mm < 0.0)
    say(fmt::format("palpate: {}: {:.3g} mm across, scaled by {:.6g} (--fit-mm, --unit)\n", body.name, diagonal,
                    factor));
}

lab::NamedBody outsideBody(const std::string& name, const HuntArguments& arguments, const Progress& progress) {
  mesh::LoadOptions options;
  options.unit_mm = arguments.unit_mm;
  options.group = arguments.group;
  options.keep_wrong_indices = true;
  lab::NamedBody body{name, meshFrom(name, options, progress)};
  fit(body, arguments.fit_mm);
  return body;
}

void addBodyOptions(Command& command, HuntArguments& a) {
  command.add_option(
      "--mesh", a.meshes,
      "Your own body, repeatable; with --generated in addition to the generated ones. " + std::string(kMeshNamesHelp));
  addUnit(command, a.unit_mm);
  command.add_option("--group", a.group, "Use only this group or object of OBJ files");
  addNumber(
      command, "--fit-mm", a.fit_mm, between(0.0, 1e9, "mm"),
      "Scale each file's body to this diagonal; 0: never (default: to 400 mm if it is below 20 mm or above 10 m)");
  command.add_flag("--generated", a.generated, "Use generated bodies too, with --mesh");
  command.add_option("--kind", a.kinds, "Use only generated bodies of this kind, repeatable (docs/howto/hunt.md)");
  addSetting(command, "--bodies", a.bodies, between(0, 1e9),
             "Number of generated bodies; 0: one for every 20,000 ticks");
  addSetting(command, "--scale", a.scale, between(1e-6, 1e6),
             "Factor that scales everything: bodies, paths and fingers");
  addSetting(command, "--lumps", a.lumps, between(0, 64),
             "Lumps under the skin of each body, every second one mobile; a second finger follows the first");
}

/// `arguments` must outlive the command.
void addHuntOptions(Command& command, HuntArguments& a) {
  Option* ticks = addSetting(command, "--ticks", a.ticks, between(1, 1e12), "Ticks (of 1 ms) to hunt for");
  addNumber(command, "--seconds", a.seconds, between(1e-3, 1e7, "s"),
            "Hunt for this time, by the clock, instead of --ticks")
      ->excludes(ticks);
  addSetting(command, "--seed", a.seed, {{0.0}}, "Seed of bodies and paths; the same seed gives the same hunt");
  addNumber(command, "--radius-mm", a.radii_mm, between(0.0, 1000.0, "mm"),
            "Radius of the finger, repeatable (default: 0, 0.5, 2, 5 and 8)");
  addBodyOptions(command, a);
  addSetting(command, "--threads", a.threads, between(0, 1024), "Number of threads; 0: one per processor");
  namesFolderToWrite(command.add_option(
      "-o,--out", a.out,
      "Folder for failing cases, shortened: body.ply, path.csv, scene.toml (for palpate simulate), note.txt"));
  addSetting(command, "--keep", a.keep, between(0, 1e6), "Number of cases to write per fault");
  command.add_option("--replay", a.replay, "Check a written case again instead of hunting, repeatable")
      ->excludes("--mesh");
  command.add_flag("--json", a.json, "Print one JSON object");
}

/// Reads the meshes. Throws Error naming the file.
lab::HuntPlan makeHuntPlan(const HuntArguments& arguments, const Progress& progress) {
  lab::HuntPlan plan;
  plan.ticks = arguments.ticks;
  if (arguments.seconds > 0.0) plan.seconds = arguments.seconds;
  plan.seed = arguments.seed;
  if (!arguments.radii_mm.empty()) plan.radii_mm = arguments.radii_mm;
  for (const std::string& name : arguments.meshes) plan.meshes.push_back(outsideBody(name, arguments, progress));
  plan.generated = arguments.generated || arguments.meshes.empty() || !arguments.kinds.empty();
  plan.kinds = arguments.kinds;
  plan.bodies = arguments.bodies;
  plan.scale = arguments.scale;
  plan.lumps = arguments.lumps;
  plan.threads = arguments.threads;
  return plan;
}

/// Lines of the text report; the JSON has all of them.
constexpr std::size_t kMaxLines = 20;

std::size_t faultTicks(const lab::HuntResult& result, lab::Fault fault) {
  return result.fault_ticks[static_cast<std::size_t>(fault)];
}

Json failingJson(const lab::FailingPath& path, const std::string& file) {
  Json json;
  json["body"] = path.body;
  json["seed"] = path.seed;
  json["radius_mm"] = path.radius_mm;
  json["tick"] = path.finding.first_tick;
  json["kind"] = lab::nameOf(path.fault);
  json["file"] = file.empty() ? Json(nullptr) : Json(file);
  json["ticks"] = path.finding.ticks;
  json["what"] = path.finding.what;
  json["measured"] = path.finding.measured;
  json["bound"] = path.finding.bound;
  return json;
}

std::string failingText(const lab::FailingPath& path, const std::string& file) {
  return fmt::format("{:15} {:28} seed {:10} radius {:4} mm, tick {:4}: {} {:.6g} (bound {:.6g}), {} tick{}{}\n",
                     lab::nameOf(path.fault), path.body, path.seed, path.radius_mm, path.finding.first_tick,
                     path.finding.what, path.finding.measured, path.finding.bound, path.finding.ticks,
                     path.finding.ticks == 1 ? "" : "s", file.empty() ? "" : " -> " + file);
}

/// Failing paths that are worth a case: at most `keep` of a fault, those of new kinds of bodies first.
std::vector<std::size_t> chosen(const lab::HuntResult& result, std::size_t keep) {
  std::vector<std::size_t> picks;
  for (std::size_t f = 0; f < lab::kFaults; ++f) {
    std::vector<std::size_t> fresh, more;
    std::set<std::string> kinds;
    for (std::size_t i = 0; i < result.failing.size(); ++i) {
      const lab::FailingPath& path = result.failing[i];
      if (path.fault != static_cast<lab::Fault>(f)) continue;
      (kinds.insert(path.body.substr(0, path.body.find('#'))).second ? fresh : more).push_back(i);
    }
    fresh.insert(fresh.end(), more.begin(), more.end());
    picks.insert(picks.end(), fresh.begin(), fresh.begin() + static_cast<std::ptrdiff_t>(std::min(keep, fresh.size())));
  }
  return picks;
}

lab::KeptCase makeKeptCase(const lab::HuntPlan& plan, const lab::FailingPath& path) {
  const mesh::TriangleMesh mesh = lab::huntedMesh(plan, path.body);
  const contact::FingerSettings finger = lab::huntedFinger(path.radius_mm, plan.scale);
  std::vector<Vec3> tips;
  {
    lab::HuntWorld world = lab::buildHuntWorld(mesh);
    tips = lab::huntedTips(world.body, path.seed, path.radius_mm, plan.scale);
    tips.resize(std::min(tips.size(), path.ticks));
    if (plan.lumps > 0 && endingSignal() == 0) {  // the body stays: its lumps lie under its triangles
      lab::putLumps(world, path.body, plan.lumps);
      tips = lab::minimised(world, finger, std::move(tips), path.fault);
    }
  }
  // Making it short takes long: after a signal a case is kept as it was found.
  lab::SmallCase small = endingSignal() == 0 && plan.lumps == 0 ? lab::minimised(mesh, finger, tips, path.fault)
                                                                : lab::SmallCase{mesh, tips};
  lab::KeptCase kept{path.body,  path.seed,    path.radius_mm,        plan.scale,           plan.lumps,
                     path.fault, path.finding, std::move(small.tips), std::move(small.mesh)};
  kept.finding = lab::replay(kept).of(path.fault);
  return kept;
}

/// All but the failing paths.
Json huntJson(const lab::HuntPlan& plan, const lab::HuntResult& result) {
  const double ticks_per_s = result.seconds > 0.0 ? static_cast<double>(result.ticks) / result.seconds : 0.0;
  Json json;
  json["complete"] = endingSignal() == 0;
  json["ended_by"] = endingSignal() == 0 ? Json(nullptr) : Json(nameOfSignal(endingSignal()));
  json["ticks"] = result.ticks;
  json["bodies"] = result.bodies;
  json["falls"] = faultTicks(result, lab::Fault::fall);
  json["missed_contacts"] = faultTicks(result, lab::Fault::missed_contact);
  json["wrong_forces"] = faultTicks(result, lab::Fault::wrong_force);
  json["steps_over_bound"] = faultTicks(result, lab::Fault::step);
  json["held_in_air"] = faultTicks(result, lab::Fault::held_in_air);
  json["held_in_air_open"] = result.held_in_air_open_ticks;
  json["lump_forces"] = faultTicks(result, lab::Fault::lump_force);
  json["lump_steps"] = faultTicks(result, lab::Fault::lump_step);
  json["lumps_moved"] = faultTicks(result, lab::Fault::lump_moved);
  json["held_through_body"] = result.held_through_ticks;
  json["events"] = result.events;
  json["paths"] = result.paths;
  json["touching_ticks"] = result.touching_ticks;
  json["open_ticks"] = result.open_ticks;
  json["seed"] = plan.seed;
  json["scale"] = plan.scale;
  json["lumps"] = plan.lumps;
  json["radii_mm"] = plan.radii_mm;
  json["seconds"] = result.seconds;
  json["ticks_per_s"] = ticks_per_s;
  return json;
}

/// `files`: for each failing path the folder of its case, or nothing.
void printHunt(Json json, const std::vector<lab::FailingPath>& failing, const std::vector<std::string>& files,
               bool as_json) {
  if (as_json) {
    json["failing_paths"] = Json::array();
    for (std::size_t i = 0; i < failing.size(); ++i) json["failing_paths"].push_back(failingJson(failing[i], files[i]));
    return fmt::print("{}", jsonText(json));
  }
  std::string text = study::figuresText(json);
  for (std::size_t i = 0; i < std::min(failing.size(), kMaxLines); ++i) text += failingText(failing[i], files[i]);
  if (failing.size() > kMaxLines) text += fmt::format("... and {} more (--json has all)\n", failing.size() - kMaxLines);
  printReadable(text);
}

std::string replayText(const std::string& folder, const lab::KeptCase& kept, const lab::HuntReport& report) {
  std::string text = fmt::format("{}: {} ticks on {}, radius {} mm: {}\n", folder, report.ticks, kept.body,
                                 kept.radius_mm, report.clean() ? "nothing wrong" : "");
  for (std::size_t f = 0; f < lab::kFaults; ++f) {
    const lab::Finding& finding = report.findings[f];
    if (finding.ticks == 0) continue;
    text += fmt::format("  {} in {} ticks from tick {}: {} {:.6g} (bound {:.6g})\n",
                        lab::nameOf(static_cast<lab::Fault>(f)), finding.ticks, finding.first_tick, finding.what,
                        finding.measured, finding.bound);
  }
  return text;
}

/// Makes the first failing paths of each fault short, of different kinds of bodies as far as there are, and writes them
/// into --out. For each failing path its folder or nothing. Throws Error.
std::vector<std::string> writeCases(const lab::HuntPlan& plan, const lab::HuntResult& result,
                                    const HuntArguments& arguments, const Progress& progress) {
  std::vector<std::string> files(result.failing.size());
  const std::vector<std::size_t> picks = chosen(result, arguments.keep);
  for (std::size_t n = 0; n < picks.size(); ++n) {
    report(progress, "making cases short", static_cast<double>(n) / static_cast<double>(picks.size()));
    const lab::KeptCase kept = makeKeptCase(plan, result.failing[picks[n]]);
    const std::filesystem::path folder = std::filesystem::path(arguments.out) / lab::caseFolderName(kept);
    lab::writeCase(folder, kept);
    files[picks[n]] = folder.string();
  }
  return files;
}

/// Exit code of a hunt that found a fault: the command ran and answers "no".
[[noreturn]] void endWithFindings() { throw ExitWith(1); }

void runReplay(const HuntArguments& arguments) {
  bool found = false;
  for (const std::string& folder : arguments.replay) {
    const lab::KeptCase kept = lab::readCase(folder);
    for (const std::string& note : kept.notes) say("palpate: " + note + "\n");
    const lab::HuntReport report = lab::replay(kept);
    found = found || !report.clean();
    fmt::print("{}", replayText(folder, kept, report));
  }
  if (found) endWithFindings();
}

void runHunt(const HuntArguments& arguments) {
  ProgressLine progress;
  lab::HuntPlan plan = makeHuntPlan(arguments, progress.callback());
  const FinishesInOrder in_order;
  plan.stop = [] { return endingSignal() != 0; };
  const lab::HuntResult result = lab::hunt(plan, progress.display());
  std::vector<std::string> files(result.failing.size());
  if (!arguments.out.empty()) files = writeCases(plan, result, arguments, progress.display());
  progress.clear();
  printHunt(huntJson(plan, result), result.failing, files, arguments.json);
  if (!result.failing.empty()) endWithFindings();
}

}  // namespace

void addHuntCommand(Command& study) {
  const auto [command, arguments] = addCommand<HuntArguments>(
      study, "hunt",
      "Look for faults of the finger on random bodies and paths (exit code 0: none, 1: some, 2: wrong usage)",
      [](const HuntArguments& a) { a.replay.empty() ? runHunt(a) : runReplay(a); });
  addHuntOptions(command, arguments);
}

}  // namespace palpate::app
