// `palpate recording replay`: runs a recording's poses through its scene again and compares the results bit for bit.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "cli/render/render_options.h"
#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::app {

namespace {

struct ReplayArguments {
  std::filesystem::path file;
  std::filesystem::path out;
  std::filesystem::path folder;
  std::filesystem::path film;
  TimeSpan span;
  bool verify = false;
  bool json = false;
};

trace::TickSpan resolveSpan(const ReplayArguments& arguments, const trace::RecordingFacts& facts) {
  const double rate = facts.header.ticks_per_s;
  const trace::TickSpan span = toTickSpan(arguments.span, rate);
  if (facts.samples == 0) throw Error::inFile(arguments.file.string(), "has no ticks");
  if (span.from > facts.last_tick) {
    throw Error::inFile(arguments.file.string(),
                        fmt::format("ends at {} s, before --from", static_cast<double>(facts.last_tick) / rate));
  }
  return span;
}

Json differenceJson(const engine::ReplayReport& report) {
  if (!report.first_difference) return nullptr;
  const engine::ReplayDifference& first = *report.first_difference;
  return {{"tick", first.tick},
          {"finger", first.finger},
          {"field", first.field},
          {"recorded", first.recorded},
          {"replayed", first.replayed}};
}

std::string textOf(const ReplayArguments& arguments, const engine::ReplayReport& report, double times_real_time) {
  std::string text = fmt::format("{}: {} samples replayed, {:.0f} times as fast as real time once the body was built\n",
                                 arguments.file.string(), report.ticks, times_real_time);
  for (const std::string& note : report.notes) text += "  note       " + note + "\n";
  for (const std::string& gap : report.gaps) text += "  unproven   " + gap + "\n";
  if (report.ticks == 0) return text + "  nothing    could be compared\n";
  if (!report.first_difference) return text + "  identical  every bit of contact, force and safety\n";
  const engine::ReplayDifference& first = *report.first_difference;
  return text + fmt::format("  different  {} samples, the first at tick {}, finger {}: {} was {}, is {}\n",
                            report.different, first.tick, first.finger, first.field, first.recorded, first.replayed);
}

std::optional<trace::ForcesCsvWriter> tableFor(const ReplayArguments& arguments, const trace::RecordingFacts& facts) {
  if (arguments.out.empty()) return std::nullopt;
  trace::ForcesCsvSettings settings;
  for (const trace::RecordingFinger& finger : facts.fingers) settings.finger_names.push_back(csvTextCell(finger.name));
  settings.ticks_per_s = facts.header.ticks_per_s;
  return std::optional<trace::ForcesCsvWriter>(std::in_place, arguments.out, settings);
}

/// Draws the recording as `palpate render` does, twenty-five pictures a second.
void draw(const ReplayArguments& arguments) {
  RenderOptions options;
  options.scene.scene = arguments.file.string();
  options.output = arguments.film;
  {
    const trace::RecordingReader recording(arguments.file);
    const trace::RecordingFacts& facts = recording.facts();
    const trace::TickSpan span = resolveSpan(arguments, facts);
    const std::uint64_t first = std::max(span.from, facts.first_tick);
    const std::uint64_t last = std::min(span.to, facts.last_tick);
    const double rate = facts.header.ticks_per_s;
    options.at_s = static_cast<double>(first) / rate;
    options.frames = std::max(1, static_cast<int>(static_cast<double>(last - first) / rate * options.frames_per_s));
  }
  drawPictures(options, !arguments.json);
}

void runReplay(const ReplayArguments& arguments) {
  ProgressLine progress;
  trace::RecordingReader recording(arguments.file);
  const trace::TickSpan span = resolveSpan(arguments, recording.facts());
  const FinishesInOrder in_order;  // the recording's files are in a folder that must be removed again
  const trace::ReadingWatch watch(throwIfInterrupted);
  const engine::CarriedFiles carried(recording);
  const std::filesystem::path folder = arguments.folder.empty() ? carried.folder() : arguments.folder;
  std::optional<trace::ForcesCsvWriter> table = tableFor(arguments, recording.facts());
  const auto started = Clock::now();
  const engine::ReplayReport report = engine::replay(
      recording, {span, folder},
      [&](std::span<const trace::Sample> samples) {
        if (!table) return;
        for (const trace::Sample& sample : samples) table->add(sample);
      },
      progress.callback());
  if (table) table->commit();
  const double times_real_time = recording.facts().seconds() / (secondsSince(started) - report.build_s);
  progress.clear();
  const Json json = {{"file", arguments.file.string()},
                     {"identical", report.identical()},
                     {"ticks", report.ticks},
                     {"different", report.different},
                     {"unproven", report.unproven},
                     {"times_real_time", times_real_time},
                     {"first_difference", differenceJson(report)},
                     {"notes", report.notes},
                     {"gaps", report.gaps}};
  printReadable(arguments.json ? jsonText(json) : textOf(arguments, report, times_real_time));
  if (!arguments.film.empty()) draw(arguments);
  if (arguments.verify && !report.identical()) throw ExitWith(1);
}

}  // namespace

void addReplayCommand(Command& recording) {
  const auto [command, a] = addCommand(recording, "replay", "Replay a recording and verify it bit by bit", runReplay);
  command.add_option("RECORDING", a.file, "Recording file")->required();
  command.add_flag("--verify", a.verify, "Return exit code 1 unless every bit is the same");
  addTimeSpan(command, a.span);
  namesFileToWrite(command.add_option("-o,--out", a.out, "Write the replayed forces as a table (CSV)"));
  command.add_option("--folder", a.folder, "Folder of the files that the scene names (default: where they were)");
  command.add_option("--render", a.film,
                     "Also draw it at 25 pictures per second: a film (FILE.webm, FILE.gif, FILE.mp4) or numbered "
                     "pictures (FILE.png); palpate render has more options");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
