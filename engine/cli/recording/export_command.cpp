// `palpate recording export`: a recording as files that other programs read.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_export.h"
#include "cli/recording/recording_text.h"
#include "cli/simulate/run_recorder.h"
#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/engine/recorded_pressure.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::app {

namespace {

struct ExportArguments {
  std::filesystem::path file;
  std::filesystem::path csv;
  std::filesystem::path json;
  std::filesystem::path scene;
  std::filesystem::path npz;
  std::filesystem::path ply;
  std::filesystem::path attachments;
  std::filesystem::path folder;
  std::optional<double> at_s;
  std::optional<std::size_t> taxels;
  std::optional<double> pad_mm;
  bool raw = false;
  TimeSpan span;
};

/// Replays the recording for its pressure patterns; the user gets a note where the replay differs.
std::optional<engine::RecordedPressure> replayPressure(trace::RecordingReader& recording,
                                                       const ExportArguments& arguments, const Progress& progress,
                                                       std::string& text) {
  if (!arguments.taxels) return std::nullopt;
  const engine::CarriedFiles carried(recording);
  engine::ReplaySettings settings;
  settings.span = toTickSpan(arguments.span, recording.facts().header.ticks_per_s);
  settings.folder = arguments.folder.empty() ? carried.folder() : arguments.folder;
  const contact::PressurePad pad{*arguments.taxels, arguments.pad_mm.value_or(contact::PressurePad().size_mm)};
  auto pressure = engine::recordedPressure(recording, settings, pad, progress);
  for (const std::string& note : pressure.replay.notes) text += "  note: " + note + "\n";
  for (const std::string& gap : pressure.replay.gaps) text += "  note: " + gap + "\n";
  if (pressure.replay.different > 0) {
    text += fmt::format("  note: the pressures are of forces that differ from the recorded ones in {} of {} samples\n",
                        pressure.replay.different, pressure.replay.ticks);
  }
  return pressure;
}

std::uint64_t writeCsv(trace::RecordingReader& recording, const ExportArguments& arguments,
                       const engine::RecordedPressure* pressure, const Progress& progress) {
  const trace::RecordingFacts& facts = recording.facts();
  trace::ForcesCsvSettings settings;
  for (const trace::RecordingFinger& finger : facts.fingers)
    settings.finger_names.push_back(csvTextCell(finger.name, arguments.raw ? CsvText::raw : CsvText::safe));
  settings.ticks_per_s = facts.header.ticks_per_s;
  trace::ForcesCsvWriter table(arguments.csv, settings, OutputFile::Unfinished::remove, pressureColumns(pressure));
  std::uint64_t rows = 0;
  recording.forEachTick(toTickSpan(arguments.span, settings.ticks_per_s), [&](std::span<const trace::Sample> samples) {
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
void writeJson(trace::RecordingReader& recording, const ExportArguments& arguments) {
  Json json = factsJson(recording.facts());
  Json worlds = Json::array();
  for (std::uint64_t i = 0; i < recording.facts().worlds; ++i) {
    const trace::RecordingWorld world = recording.world(recording.facts().first_world + i);
    worlds.push_back({{"body", world.body},
                      {"triangles", world.triangles},
                      {"hash", fmt::format("{:016x}", world.hash)},
                      {"scene", world.scene}});
  }
  Json events = Json::array();
  for (const trace::RecordingEvent& event :
       recording.events(toTickSpan(arguments.span, recording.facts().header.ticks_per_s))) {
    events.push_back({{"tick", event.tick},
                      {"finger", event.finger ? Json(*event.finger) : Json(nullptr)},
                      {"kind", event.kind},
                      {"text", event.text}});
  }
  json["world_list"] = worlds;
  json["event_list"] = events;
  writeFile(arguments.json, jsonText(json));
}

/// The skin as the recorded fingers deform it at a moment.
std::string writePly(trace::RecordingReader& recording, const ExportArguments& arguments, const Progress& progress) {
  const double rate = recording.facts().header.ticks_per_s;
  const double time_s = arguments.at_s ? *arguments.at_s : static_cast<double>(deepestTick(recording)) / rate;
  const servo::TickSamples frame = recordedFrames(recording, {time_s}).front();
  const engine::CarriedFiles carried(recording);
  const std::filesystem::path folder = arguments.folder.empty() ? carried.folder() : arguments.folder;
  const auto world = worldToSee(recording, frame.front().world, folder, {}, progress);
  requireFitting(frame, *world);
  writeSurface(arguments.ply, *world, frame);
  const std::string note =
      engine::noteOfAnotherWorld(recording.world(frame.front().world), frame.front().world, *world);
  return fmt::format("skin at {:.3f} s -> {}\n", static_cast<double>(frame.front().tick) / rate,
                     arguments.ply.string()) +
         (note.empty() ? note : "  note: " + note + "\n");
}

void requireSomething(const ExportArguments& a) {
  for (const std::filesystem::path* request : {&a.csv, &a.json, &a.scene, &a.npz, &a.ply, &a.attachments}) {
    if (!request->empty()) return;
  }
  throw Error("export: nothing to write; use --csv, --npz, --json, --scene, --ply FILE or --attachments FOLDER");
}

void runExport(const ExportArguments& arguments) {
  requireSomething(arguments);
  if (arguments.raw && arguments.csv.empty()) throw Error("export: --raw requires --csv FILE");
  if (arguments.at_s && arguments.ply.empty()) throw Error("export: --at requires --ply FILE");
  if (arguments.taxels && arguments.npz.empty() && arguments.csv.empty()) {
    throw Error("export: --pressure requires --npz FILE or --csv FILE");
  }
  if (arguments.pad_mm && !arguments.taxels) throw Error("export: --pad-mm requires --pressure");
  const FinishesInOrder in_order;  // the recording's files are in a folder that must be removed again
  const trace::ReadingWatch watch(throwIfInterrupted);
  ProgressLine progress;
  trace::RecordingReader recording(arguments.file);
  std::string text;
  const auto felt = replayPressure(recording, arguments, progress.callback(), text);
  const engine::RecordedPressure* const pressure = felt ? &*felt : nullptr;
  if (!arguments.csv.empty()) {
    text += fmt::format("{} rows -> {}\n", writeCsv(recording, arguments, pressure, progress.callback()),
                        arguments.csv.string());
  }
  if (!arguments.npz.empty()) {
    const trace::TickSpan span = toTickSpan(arguments.span, recording.facts().header.ticks_per_s);
    text += fmt::format("{} rows -> {}\n", writeNpz(recording, span, arguments.npz, pressure, progress.callback()),
                        arguments.npz.string());
  }
  if (!arguments.ply.empty()) text += writePly(recording, arguments, progress.callback());
  if (!arguments.attachments.empty()) {
    const trace::TickSpan span = toTickSpan(arguments.span, recording.facts().header.ticks_per_s);
    text += fmt::format("{} pictures, sound notes and the like -> {}\n",
                        writeAttachments(recording, span, arguments.attachments), arguments.attachments.string());
  }
  if (!arguments.json.empty()) {
    writeJson(recording, arguments);
    text += fmt::format("header, worlds and events -> {}\n", arguments.json.string());
  }
  if (!arguments.scene.empty()) {
    writeFile(arguments.scene, recording.world(recording.facts().first_world).scene);
    text += fmt::format("scene -> {}\n", arguments.scene.string());
  }
  progress.clear();
  printReadable(text);
}

}  // namespace

void addExportCommand(Command& recording) {
  const auto [command, a] =
      addCommand(recording, "export", "Export a recording as CSV, NPZ, JSON, TOML, PLY or its attachments", runExport);
  command.add_option("RECORDING", a.file, "Recording file")->required();
  command.add_option("--csv", a.csv, "Every tick, in the format of forces.csv");
  command.add_flag("--raw", a.raw,
                   "With --csv: write names that begin like a formula (= + - @) unchanged, for programs; otherwise an "
                   "apostrophe is put before them");
  command.add_option("--json", a.json, "Everything except the ticks: header, fingers, worlds, events");
  command.add_option("--scene", a.scene, "Scene at the start of the recording (TOML)");
  command.add_option("--npz", a.npz, "Every column of every tick as arrays for NumPy: numpy.load(FILE)['index.tick']");
  addNumber(command, "--pressure", a.taxels, between(contact::kMinTaxels, contact::kMaxTaxels),
            "Taxels along a side of a pad on each fingertip; its pressures (kPa) are added to --npz "
            "('index.pressure_kpa') and --csv (such a table cannot be played back)");
  addNumber(command, "--pad-mm", a.pad_mm, between(1.0, 100.0, "mm"), "Edge length of that pad (default: 16)");
  command.add_option("--ply", a.ply, "Deformed skin at one moment, with displacement and strain");
  addNumber(command, "--at", a.at_s, between(0.0, 1e9, "s"),
            "Moment of --ply (default: where the fingers press deepest)");
  command.add_option("--attachments", a.attachments, "Folder for the pictures and sound notes attached to it");
  command.add_option("--folder", a.folder, "Folder of the files that the scene names (default: where they were)");
  addTimeSpan(command, a.span);
}

}  // namespace palpate::app
