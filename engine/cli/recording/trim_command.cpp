// `palpate recording trim`: a part of a recording as a recording.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/json.h"
#include "palpate/trace/recording_edit.h"

namespace palpate::app {

namespace {

struct TrimArguments {
  std::filesystem::path file;
  std::filesystem::path out;
  TimeSpan span;
  bool exact = false;
  bool json = false;
};

std::string joinNotAtRest(const trace::Trimmed& trimmed) {
  std::string names;
  for (const std::string& name : trimmed.not_at_rest) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::string textOf(const TrimArguments& arguments, const trace::Trimmed& trimmed, double ticks_per_s) {
  const trace::Copied& copied = trimmed.copied;
  std::string text = fmt::format("{}: {} samples, {:.3f} to {:.3f} s\n", arguments.out.string(), copied.samples,
                                 static_cast<double>(copied.first_tick) / ticks_per_s,
                                 static_cast<double>(copied.last_tick) / ticks_per_s);
  if (trimmed.earlier_ticks > 0) {
    text += fmt::format(
        "  note  it begins {:.3f} s earlier, where every finger was last at rest, so that all of it can be replayed "
        "(--exact begins at --from)\n",
        static_cast<double>(trimmed.earlier_ticks) / ticks_per_s);
  }
  if (!trimmed.not_at_rest.empty()) {
    text += fmt::format("  note  not at rest at the beginning: {}; a replay cannot verify it until it is\n",
                        joinNotAtRest(trimmed));
  }
  return text;
}

void runTrim(const TrimArguments& arguments) {
  trace::refuseSame(arguments.out, arguments.file);
  ProgressLine progress;
  const trace::ReadingWatch watch(throwIfInterrupted);
  trace::RecordingReader recording(arguments.file);
  const double rate = recording.facts().header.ticks_per_s;
  const trace::TrimSettings settings{toTickSpan(arguments.span, rate), arguments.exact};
  const trace::Trimmed trimmed = trace::trim(recording, settings, arguments.out, progress.callback());
  progress.clear();
  const Json json = {{"file", arguments.out.string()},          {"samples", trimmed.copied.samples},
                     {"first_tick", trimmed.copied.first_tick}, {"last_tick", trimmed.copied.last_tick},
                     {"worlds", trimmed.copied.worlds},         {"earlier_ticks", trimmed.earlier_ticks},
                     {"not_at_rest", trimmed.not_at_rest}};
  printReadable(arguments.json ? jsonText(json) : textOf(arguments, trimmed, rate));
}

}  // namespace

void addTrimCommand(Command& recording) {
  const auto [command, a] =
      addCommand(recording, "trim", "Cut a part out of a recording and write it as a recording", runTrim);
  command.add_option("RECORDING", a.file, "Recording file")->required();
  addTimeSpan(command, a.span);
  namesFileToWrite(command.add_option("-o,--out", a.out, "Recording file to write"))->required();
  command.add_flag("--exact", a.exact,
                   "Begin exactly at --from, even during a contact (default: where every finger was last at rest)");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
