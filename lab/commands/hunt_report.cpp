#include "lab/commands/hunt_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/kit/interruption.h"
#include "lab/hunt/minimise.h"

namespace palpate::app {

namespace {

/// Lines of the text report; the JSON has all of them.
constexpr std::size_t kMostLines = 20;

double ticksPerSecond(const lab::HuntResult& result) {
  return result.seconds > 0.0 ? static_cast<double>(result.ticks) / result.seconds : 0.0;
}

std::size_t ticksOf(const lab::HuntResult& result, lab::Fault fault) {
  return result.fault_ticks[static_cast<std::size_t>(fault)];
}

nlohmann::ordered_json failingJson(const lab::FailingPath& path, const std::string& file) {
  nlohmann::ordered_json json;
  json["body"] = path.body;
  json["seed"] = path.seed;
  json["radius_mm"] = path.radius_mm;
  json["tick"] = path.finding.first_tick;
  json["kind"] = lab::nameOf(path.fault);
  json["file"] = file.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(file);
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

/// Which failing paths are worth a case: at most `keep` of a fault, those of new kinds of bodies first.
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

lab::KeptCase caseOf(const lab::HuntPlan& plan, const lab::FailingPath& path) {
  const mesh::TriangleMesh mesh = lab::huntedMesh(plan, path.body);
  const contact::FingerSettings finger = lab::huntedFinger(path.radius_mm, plan.scale);
  std::vector<Vec3> tips;
  {
    lab::HuntWorld world = lab::buildHuntWorld(mesh);
    tips = lab::huntedTips(world.body, path.seed, path.radius_mm, plan.scale);
  }
  tips.resize(std::min(tips.size(), path.ticks));
  // Making it short takes long: after a signal a case is kept as it was found.
  lab::SmallCase small =
      endAskedBy() == 0 ? lab::minimised(mesh, finger, tips, path.fault) : lab::SmallCase{mesh, tips};
  lab::KeptCase kept{path.body,  path.seed,    path.radius_mm,        plan.scale,
                     path.fault, path.finding, std::move(small.tips), std::move(small.mesh)};
  kept.finding = lab::replay(kept).of(path.fault);
  return kept;
}

}  // namespace

nlohmann::ordered_json huntJson(const lab::HuntPlan& plan, const lab::HuntResult& result,
                                const std::vector<std::string>& files) {
  nlohmann::ordered_json json;
  json["complete"] = endAskedBy() == 0;
  json["ended_by"] =
      endAskedBy() == 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(nameOfSignal(endAskedBy()));
  json["ticks"] = result.ticks;
  json["bodies"] = result.bodies;
  json["falls"] = ticksOf(result, lab::Fault::fall);
  json["missed_contacts"] = ticksOf(result, lab::Fault::missed_contact);
  json["wrong_forces"] = ticksOf(result, lab::Fault::wrong_force);
  json["steps_over_bound"] = ticksOf(result, lab::Fault::step);
  json["held_in_air"] = ticksOf(result, lab::Fault::held_in_air);
  json["held_through_body"] = result.held_through_ticks;
  json["events"] = result.events;
  json["failing_paths"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < result.failing.size(); ++i)
    json["failing_paths"].push_back(failingJson(result.failing[i], files[i]));
  json["paths"] = result.paths;
  json["touching_ticks"] = result.touching_ticks;
  json["seed"] = plan.seed;
  json["scale"] = plan.scale;
  json["radii_mm"] = plan.radii_mm;
  json["seconds"] = result.seconds;
  json["ticks_per_s"] = ticksPerSecond(result);
  return json;
}

std::string huntText(const lab::HuntResult& result, const std::vector<std::string>& files) {
  std::string text =
      fmt::format("ticks             {} ({} in contact) on {} bodies along {} paths, {:.0f} ticks/s\n", result.ticks,
                  result.touching_ticks, result.bodies, result.paths, ticksPerSecond(result));
  if (endAskedBy() != 0) text += fmt::format("ended by {}, before it was done\n", nameOfSignal(endAskedBy()));
  text += fmt::format("falls             {}\n", ticksOf(result, lab::Fault::fall));
  text += fmt::format("missed contacts   {}\n", ticksOf(result, lab::Fault::missed_contact));
  text += fmt::format("wrong forces      {}\n", ticksOf(result, lab::Fault::wrong_force));
  text += fmt::format("steps over bound  {}\n", ticksOf(result, lab::Fault::step));
  text += fmt::format("held in air       {}\n", ticksOf(result, lab::Fault::held_in_air));
  text += fmt::format("held through body {}\n", result.held_through_ticks);
  text += fmt::format("events            {}\n", result.events);
  for (std::size_t i = 0; i < std::min(result.failing.size(), kMostLines); ++i)
    text += failingText(result.failing[i], files[i]);
  if (result.failing.size() > kMostLines)
    text += fmt::format("... and {} more (--json has all)\n", result.failing.size() - kMostLines);
  return text;
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

std::vector<std::string> writeCases(const lab::HuntPlan& plan, const lab::HuntResult& result,
                                    const HuntArguments& arguments, const Progress& progress) {
  std::vector<std::string> files(result.failing.size());
  const std::vector<std::size_t> picks = chosen(result, arguments.keep);
  for (std::size_t n = 0; n < picks.size(); ++n) {
    report(progress, "making cases short", static_cast<double>(n) / static_cast<double>(picks.size()));
    const lab::KeptCase kept = caseOf(plan, result.failing[picks[n]]);
    const std::filesystem::path folder = std::filesystem::path(arguments.out) / lab::folderNameOf(kept);
    lab::writeCase(folder, kept);
    files[picks[n]] = folder.string();
  }
  return files;
}

}  // namespace palpate::app
