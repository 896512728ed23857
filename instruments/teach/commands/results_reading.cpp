// Prints what can be read at a glance: sessions, one trainee, all trainees, and whether the records are intact.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/json.h"
#include "cli/kit/readable_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/verify.h"
#include "palpate/training/report/threshold_points.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

using training::BlockRow;
using training::SessionRow;
using training::Store;
using training::TraineeRow;
struct ReadingArguments {
  ResultsArguments results;
  std::string trainee;
  std::string language;
};

void printResults(const Json& json) { printReadable(jsonText(json)); }

void runResultsList(const ReadingArguments& arguments) {
  Store store = openedResults(arguments.results);
  const std::string whose = arguments.trainee.empty() ? "" : traineeCalled(store, arguments.trainee).id;
  Json json = Json::array();
  std::string text;
  for (const SessionRow& session : store.sessions(whose)) {
    json.push_back(sessionJson(store, session));
    text += sessionLine(store, session);
  }
  if (arguments.results.json) return printResults({{"file", store.file().string()}, {"sittings", json}});
  printReadable(text.empty() ? fmt::format("{}: no session yet\n", store.file().string()) : text);
}

/// Finished blocks that measured a threshold, oldest first.
std::vector<BlockRow> measuredBlocks(Store& store, const TraineeRow& trainee) {
  std::vector<BlockRow> measured;
  for (const SessionRow& session : store.sessions(trainee.id)) {
    for (const BlockRow& block : store.blocks(session.id)) {
      if (training::isTest(session.kind) && block.finished && block.threshold > 0.0) measured.push_back(block);
    }
  }
  return measured;
}

struct TraineeSummary {
  TraineeRow row;
  std::size_t sessions = 0;
  std::size_t trials = 0;
  std::int64_t last_ms = 0;
  std::optional<BlockRow> first = {}, last = {};  ///< blocks that measured
};

TraineeSummary traineeSummary(Store& store, const TraineeRow& row) {
  TraineeSummary summary{.row = row};
  for (const SessionRow& session : store.sessions(row.id)) {
    ++summary.sessions;
    summary.last_ms = std::max(summary.last_ms, std::max(session.start_ms, session.end_ms));
    for (const BlockRow& block : store.blocks(session.id)) summary.trials += store.trials(block.id).size();
  }
  const std::vector<BlockRow> measured = measuredBlocks(store, row);
  if (!measured.empty()) {
    summary.first = measured.front();
    summary.last = measured.back();
  }
  return summary;
}

Json traineeSummaryJson(const TraineeSummary& summary) {
  const auto measured = [](const std::optional<BlockRow>& block) { return block ? blockJson(*block) : Json(nullptr); };
  return {{"trainee", summary.row.id},      {"class", summary.row.class_id},    {"created_ms", summary.row.created_ms},
          {"consent", summary.row.consent}, {"sittings", summary.sessions},     {"trials", summary.trials},
          {"last_ms", summary.last_ms},     {"first", measured(summary.first)}, {"last", measured(summary.last)}};
}

std::string thresholdOrDash(const std::optional<BlockRow>& block) { return block ? thresholdText(*block) : "-"; }

void runResultsTrainee(const ReadingArguments& arguments) {
  useLanguage(arguments.language);
  Store store = openedResults(arguments.results);
  const TraineeSummary summary = traineeSummary(store, traineeCalled(store, arguments.trainee));
  const std::vector<SessionRow> sessions = store.sessions(summary.row.id);
  if (arguments.results.json) {
    Json json = traineeSummaryJson(summary);
    json["list"] = listJson(sessions, [&](const SessionRow& session) { return sessionJson(store, session); });
    return printResults(json);
  }
  const TraineeRow& row = summary.row;
  std::string text = fmt::format(
      "{}\n  {}\n  {}\n", row.class_id.empty() ? row.id : trf("{}, class {}", row.id, row.class_id),
      trf("{} sessions, {} trials, since {}", summary.sessions, summary.trials, formatUtcTime(row.created_ms)),
      trf("first measured {}, last {}", thresholdOrDash(summary.first), thresholdOrDash(summary.last)));
  for (const SessionRow& session : sessions) text += "  " + sessionLine(store, session);
  printReadable(text);
}

void runResultsClass(const ReadingArguments& arguments) {
  Store store = openedResults(arguments.results);
  Json json = Json::array();
  std::string text;
  for (const TraineeRow& row : store.trainees()) {
    const TraineeSummary summary = traineeSummary(store, row);
    json.push_back(traineeSummaryJson(summary));
    text +=
        fmt::format("{}  {:10}  {:3} sessions  {:4} trials  first {:22}  last {}\n", row.id.substr(0, 8), row.class_id,
                    summary.sessions, summary.trials, thresholdOrDash(summary.first), thresholdOrDash(summary.last));
  }
  if (arguments.results.json) return printResults({{"file", store.file().string()}, {"trainees", json}});
  printReadable(text.empty() ? fmt::format("{}: no trainee yet\n", store.file().string()) : text);
}

void runResultsVerify(const ReadingArguments& arguments) {
  Store store = openedResults(arguments.results);
  const training::Verified found = verifyRecords(store);
  if (arguments.results.json) {
    printResults({{"file", store.file().string()},
                  {"ok", found.ok()},
                  {"trials", found.trials},
                  {"trainees", found.trainees},
                  {"sittings", found.sessions},
                  {"blocks", found.blocks},
                  {"session_files", found.recording_files},
                  {"recomputed", found.recomputed},
                  {"schema", training::kSchemaVersion},
                  {"faults", found.faults},
                  {"notes", found.notes}});
  } else {
    for (const std::string& fault : found.faults) printReadable("fault  " + readableLine(fault) + "\n");
    for (const std::string& note : found.notes) printReadable("note   " + readableLine(note) + "\n");
    fmt::print("{}: {}; {} trainees, {} sessions, {} blocks ({} computed again), {} trials, {} recordings\n",
               store.file().string(), found.ok() ? "whole" : "NOT whole", found.trainees, found.sessions, found.blocks,
               found.recomputed, found.trials, found.recording_files);
  }
  if (!found.ok()) throw ExitWith(1);
}

}  // namespace

void addResultsListCommand(Command& parent) {
  const auto [command, arguments] = addCommand(parent, "list", "List the sessions, oldest first", runResultsList);
  addResultsFile(command, arguments.results);
  addClassFolder(command, arguments.results);
  command.add_option("--trainee", arguments.trainee, kTraineeHelp)->type_name("CODE");
}

void addResultsTraineeCommand(Command& parent) {
  const auto [command, arguments] = addCommand(parent, "trainee", "Show one trainee's results", runResultsTrainee);
  command.add_option("CODE", arguments.trainee, kTraineeHelp)->required();
  addResultsFile(command, arguments.results);
  addClassFolder(command, arguments.results);
  addLanguage(command, arguments.language);
}

void addResultsClassCommand(Command& parent) {
  const auto [command, arguments] = addCommand(parent, "class", "List all trainees, one per line", runResultsClass);
  addResultsFile(command, arguments.results);
}

void addResultsVerifyCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "verify", "Check that rows, recordings and results are complete and agree", runResultsVerify);
  addResultsFile(command, arguments.results);
}

}  // namespace palpate::app
