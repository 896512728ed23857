// `palpate train results report`: the training of a trainee or a class, as one page or as numbers.
#include <memory>

#include "cli/kit/choice_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/training/records/class_names.h"
#include "report/recording/report_delivery.h"
#include "teach/commands/class_part.h"
#include "teach/commands/results_commands.h"
#include "teach/report/training_report.h"

namespace palpate::app {

namespace {

struct ResultsReportArguments {
  ReportRequest request;
  TrainingReportSettings settings;
  std::string language;
};

void runResultsReport(ResultsReportArguments arguments) {
  useLanguage(arguments.language);
  const ReportRequest& request = arguments.request;
  const bool is_database = training::isDatabaseAddress(request.file.string());
  if (is_database) classPart();  // perhaps another program's, before anything is shown
  ProgressLine progress;
  const std::filesystem::path page = resolvePagePath(request, is_database ? "class.html" : standardPage(request.file));
  arguments.settings.file = request.file;
  const TrainingReport report = trainingReport(arguments.settings, progress.callback());
  const FinishedReport finished{.file = report.file,
                                .page = request.wantsPage() ? trainingPage(report, progress.callback()) : std::string(),
                                .numbers = trainingReportJson(report),
                                .sentences = trainingSentences(report)};
  progress.clear();
  deliver(finished, request, page);
}

}  // namespace

void addResultsReportCommand(Command& parent) {
  const auto [command, a] = addCommand<ResultsReportArguments>(
      parent, "report",
      "Report on the training of a trainee or a class (learning curve, accuracy, touch) as one HTML page",
      runResultsReport);
  command.add_option("FILE", a.request.file, "Training record (.results), or a class's PostgreSQL: postgresql://...")
      ->required();
  namesFileToWrite(command.add_option(
      "-o,--out", a.request.out,
      "Page to write (default: the file's name with .html, or class.html for a database, in this folder)"));
  Option& trainee = *command.add_option("--trainee", a.settings.trainee,
                                        "Report on one trainee, by code or by the first letters of the pseudonym");
  command.add_flag("--class", a.settings.whole_class, "Report on all trainees, even if there is only one")
      ->excludes(&trainee);
  command
      .add_option("--class-word", a.settings.only_class,
                  "Report on all trainees of one class, if the record has several")
      ->excludes(&trainee);
  command.add_flag("--json", a.request.json, "Print all numbers as one JSON object; write a page only with --out");
  addLanguage(command, a.language);
}

}  // namespace palpate::app
