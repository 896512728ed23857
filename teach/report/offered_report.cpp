// Training as `palpate report` sees it: what its files are, and a report on one.
#include "cli/session/report_source.h"
#include "palpate/classroom/database_copy.h"
#include "teach/commands/results_commands.h"
#include "teach/report/training_report.h"

namespace palpate::app {

namespace {

FinishedReport finishedTrainingReport(const ReportRequest& request, const Progress& progress) {
  const TrainingReport report =
      trainingReport({request.file, request.trainee, request.only_class, request.whole_class}, progress);
  return {.file = report.file,
          .page = request.wants_page ? trainingPage(report, progress) : std::string(),
          .numbers = trainingReportJson(report),
          .sentences = trainingSentences(report)};
}

std::string pageOfDatabase(const std::filesystem::path& file) {
  return classroom::isDatabaseAddress(file.string()) ? "class.html" : "";
}

}  // namespace

void offerTrainingReports() {
  offerReportSource({.owns = isRecordsFile, .page_name = pageOfDatabase, .report = finishedTrainingReport});
}

}  // namespace palpate::app
