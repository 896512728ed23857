// `palpate recording report`: what a recording was, as one page that needs nothing else, or as numbers. And the
// commands of palpate-report, of which it is one.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/choice_option.h"
#include "cli/kit/commands.h"
#include "cli/kit/interruption.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "report/commands.h"
#include "report/recording/recording_report.h"
#include "report/recording/report_delivery.h"

namespace palpate::app {

namespace {

struct ReportArguments {
  ReportRequest request;
  std::filesystem::path folder;
  std::string language;
  TimeSpan span;
};

trace::TickSpan reportSpan(const ReportArguments& arguments, const trace::RecordingFacts& facts) {
  const trace::TickSpan span = toTickSpan(arguments.span, facts.header.ticks_per_s);
  if (facts.samples > 0 && span.from > facts.last_tick) {
    throw Error::inFile(
        arguments.request.file.string(),
        fmt::format("ends at {} s, before --from", static_cast<double>(facts.last_tick) / facts.header.ticks_per_s));
  }
  return span;
}

void runReport(const ReportArguments& arguments) {
  useLanguage(arguments.language);
  const ReportRequest& request = arguments.request;
  if (request.file.extension() == ".results") {
    throw Error::inFile(request.file.string(), "is a training record; use palpate train results report");
  }
  ProgressLine progress;
  trace::RecordingReader recording(request.file);
  const std::filesystem::path page = resolvePagePath(request, standardPage(request.file));
  const ReportSettings settings{request.file, arguments.folder, reportSpan(arguments, recording.facts())};
  const FinishesInOrder in_order;  // the recording's files are in a folder that must be removed again
  const trace::ReadingWatch watch(throwIfInterrupted);
  const RecordingReport report = recordingReport(recording, settings, progress.callback());
  const FinishedReport finished{.file = request.file,
                                .page = request.wantsPage() ? reportPage(report, progress.callback()) : std::string(),
                                .numbers = reportJson(report),
                                .sentences = reportSentences(report)};
  progress.clear();
  deliver(finished, request, page);
}

void addReportCommand(Command& recording) {
  const auto [command, a] =
      addCommand(recording, "report",
                 "Report on a recording (forces, contacts, phases, maps of the body) as one HTML page", runReport);
  command.add_option("FILE", a.request.file, "Recording file")->required();
  namesFileToWrite(command.add_option("-o,--out", a.request.out,
                                      "Page to write (default: the file's name with .html, in this folder)"));
  addTimeSpan(command, a.span);
  command.add_option("--folder", a.folder,
                     "Folder of the files that the scene names (default: the recording itself, else where they were)");
  command.add_flag("--json", a.request.json, "Print all numbers as one JSON object; write a page only with --out");
  addLanguage(command, a.language);
}

}  // namespace

void addReportFamily(Command& app) {
  addMapCommand(commandGroup(app, "body"));
  addPlotCommand(commandGroup(app, "recording"));
  addReportCommand(commandGroup(app, "recording"));
}

}  // namespace palpate::app
