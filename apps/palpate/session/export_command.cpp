// `palpate export`: a session as files that other programs read.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/palpate/common/commands.h"
#include "apps/palpate/common/progress_line.h"
#include "apps/palpate/session/session_text.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::app {

namespace {

using Json = nlohmann::ordered_json;

struct ExportArguments {
  std::filesystem::path file;
  std::filesystem::path csv;
  std::filesystem::path json;
  std::filesystem::path scene;
  TimeSpan span;
};

std::uint64_t writeCsv(trace::SessionReader& session, const ExportArguments& arguments, const Progress& progress) {
  const trace::SessionFacts& facts = session.facts();
  trace::ForcesCsvSettings settings;
  for (const trace::SessionFinger& finger : facts.fingers) settings.finger_names.push_back(finger.name);
  settings.ticks_per_s = facts.header.ticks_per_s;
  trace::ForcesCsvWriter table(arguments.csv, settings);
  std::uint64_t rows = 0;
  session.forEachTick(ticksOf(arguments.span, settings.ticks_per_s), [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) table.add(sample);
    rows += samples.size();
    if (rows % 20000 < samples.size()) {
      report(progress, "writing the table", static_cast<double>(rows) / static_cast<double>(facts.samples));
    }
    return true;
  });
  table.commit();
  return rows;
}

/// Everything but the ticks.
void writeJson(trace::SessionReader& session, const ExportArguments& arguments) {
  Json json = factsJson(session.facts());
  Json worlds = Json::array();
  for (std::uint64_t i = 0; i < session.facts().worlds; ++i) {
    const trace::SessionWorld world = session.world(session.facts().first_world + i);
    worlds.push_back({{"body", world.body},
                      {"triangles", world.triangles},
                      {"hash", fmt::format("{:016x}", world.hash)},
                      {"scene", world.scene}});
  }
  Json events = Json::array();
  for (const trace::SessionEvent& event : session.events(ticksOf(arguments.span, session.facts().header.ticks_per_s))) {
    events.push_back({{"tick", event.tick},
                      {"finger", event.finger ? Json(*event.finger) : Json(nullptr)},
                      {"kind", event.kind},
                      {"text", event.text}});
  }
  json["world_list"] = worlds;
  json["event_list"] = events;
  writeFile(arguments.json, json.dump(2) + "\n");
}

void runExport(const ExportArguments& arguments) {
  if (arguments.csv.empty() && arguments.json.empty() && arguments.scene.empty()) {
    throw Error("export: say what to write: --csv, --json or --scene FILE");
  }
  ProgressLine progress;
  trace::SessionReader session(arguments.file);
  std::string text;
  if (!arguments.csv.empty()) {
    text += fmt::format("{} rows -> {}\n", writeCsv(session, arguments, progress.callback()), arguments.csv.string());
  }
  if (!arguments.json.empty()) {
    writeJson(session, arguments);
    text += fmt::format("header, worlds and events -> {}\n", arguments.json.string());
  }
  if (!arguments.scene.empty()) {
    writeFile(arguments.scene, session.world(session.facts().first_world).scene);
    text += fmt::format("scene -> {}\n", arguments.scene.string());
  }
  progress.clear();
  fmt::print("{}", text);
}

}  // namespace

void addExportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  ExportArguments& a = *arguments;
  CLI::App& command = *app.add_subcommand("export", "Write a recorded session as files that other programs read");
  command.add_option("SESSION", a.file, "Session file")->required();
  command.add_option("--csv", a.csv, "Every tick, as forces.csv has it");
  command.add_option("--json", a.json, "Everything but the ticks: header, fingers, worlds, events");
  command.add_option("--scene", a.scene, "The scene that it began with (TOML)");
  addTimeSpan(command, a.span);
  command.callback([=] { runExport(*arguments); });
}

}  // namespace palpate::app
