// `palpate train results`: reads the records of training. Each subcommand that changes or writes something has a file
// of its own; what only reads is in results_reading.cpp.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/kit/json.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/store.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/commands/class_part.h"
#include "teach/commands/commands.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

using training::BlockRow;
using training::SessionRow;
using training::Store;
using training::TraineeRow;

/// Fewer letters of a pseudonym would be ambiguous.
constexpr std::size_t kMinPseudonym = 4;

std::string resultsPercent(double share) { return fmt::format("{:.3g}", WrittenNumber{100.0 * share}); }

std::string resultsKind(training::SessionKind kind) {
  std::string words(wordFor(kind));
  std::ranges::replace(words, '_', '-');
  return tr(words.c_str());
}

std::size_t countTrials(Store& store, const SessionRow& session) {
  std::size_t trials = 0;
  for (const BlockRow& block : store.blocks(session.id)) trials += store.trials(block.id).size();
  return trials;
}

}  // namespace

void addResultsFile(Command& command, ResultsArguments& arguments) {
  command.add_option("FILE", arguments.file,
                     "Training records (default: your own, palpate.results), or a class's PostgreSQL: "
                     "\"host=/run/postgresql dbname=class\" or postgresql://...");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

Store recordsAt(const std::string& file_or_address, Store::Open how) {
  return training::isDatabaseAddress(file_or_address) ? classPart().copy_of_database(file_or_address)
                                                      : Store(file_or_address, how);
}

void addClassFolder(Command& command, ResultsArguments& arguments) {
  command
      .add_option(
          "--class", arguments.class_folder,
          "Folder of the class or station whose secret turns codes into pseudonyms (default: as the records remember)")
      ->type_name("DIR");
}

namespace {

void remember(Store& store, const std::string& class_folder) {
  if (class_folder.empty()) return;
  const training::ClassSecret secret = classPart().secret(class_folder);
  store.rememberTraineeKey(secret.class_id, secret.key);
}

}  // namespace

Store openedResults(const ResultsArguments& arguments) {
  if (training::isDatabaseAddress(arguments.file)) {
    Store copy = classPart().copy_of_database(arguments.file);
    remember(copy, arguments.class_folder);
    return copy;
  }
  const std::filesystem::path file =
      arguments.file.empty() ? training::defaultRecords() : std::filesystem::path(arguments.file);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw Error::inFile(file.string(), "no such file; `palpate train` creates records");
  }
  if (!arguments.class_folder.empty()) classPart();  // perhaps another program's, before the file is open
  Store store(file, Store::Open::existing);
  remember(store, arguments.class_folder);
  return store;
}

TraineeRow traineeCalled(Store& store, const std::string& code_or_id) {
  if (training::codeTyped(code_or_id)) {
    for (const training::Uuid& id : store.derivePseudonyms(code_or_id)) {
      if (auto found = store.trainee(id)) return *found;
    }
    throw Error(
        fmt::format("no trainee with the code {} in these records; for a class's database give its folder with --class",
                    *training::codeTyped(code_or_id)));
  }
  std::vector<TraineeRow> found;
  for (const TraineeRow& trainee : store.trainees()) {
    if (code_or_id.size() >= kMinPseudonym && trainee.id.starts_with(code_or_id)) found.push_back(trainee);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw Error(fmt::format(
        "'{}' is neither a code (as on the card) nor a pseudonym here; `palpate train results class` lists them",
        oneLine(code_or_id)));
  }
  throw Error(fmt::format("'{}' is the start of {} pseudonyms; give more letters", oneLine(code_or_id), found.size()));
}

std::string formatUtcTime(std::int64_t ms) {
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(static_cast<std::time_t>(ms / 1000)));
}

std::string thresholdText(const BlockRow& block) {
  if (block.method == training::Method::mastery) {
    return block.mastered_change ? trf("level {} %", resultsPercent(*block.mastered_change)) : std::string();
  }
  if (block.threshold <= 0.0 || block.trials == 0) return {};
  if (block.change_meaning == training::ChangeMeaning::cue) {
    const auto number = [](double cue) { return fmt::format("{:.2g}", WrittenNumber{cue}); };
    return trf("C {} ({} to {})", number(block.threshold), number(block.threshold_low), number(block.threshold_high));
  }
  const training::ThresholdSummary shown{
      .median = block.threshold, .low = block.threshold_low, .high = block.threshold_high};
  if (!shown.isConclusive()) return tr(training::kMoreTrialsNeeded);
  return trf("{} % ({} to {} %)", resultsPercent(block.threshold), resultsPercent(block.threshold_low),
             resultsPercent(block.threshold_high));
}

Json blockJson(const BlockRow& block) {
  return {{"block", block.id},
          {"number", block.number},
          {"method", wordFor(block.method)},
          {"finished", block.finished},
          {"trials", block.trials},
          {"threshold", block.threshold},
          {"low", block.threshold_low},
          {"high", block.threshold_high},
          {"level", orNull(block.mastered_change)},
          {"verdict", wordFor(block.verdict)}};
}

Json sessionJson(Store& store, const SessionRow& session) {
  return {{"sitting", session.id},
          {"trainee", session.trainee_id},
          {"kind", wordFor(session.kind)},
          {"start_ms", session.start_ms},
          {"end_ms", session.end_ms},
          {"device", session.device},
          {"file", session.file},
          {"trials", countTrials(store, session)},
          {"blocks", listJson(store.blocks(session.id), blockJson)}};
}

std::string sessionLine(Store& store, const SessionRow& session) {
  std::string line = fmt::format("{}  {}  {:9}  ", formatUtcTime(session.start_ms), session.trainee_id.substr(0, 8),
                                 resultsKind(session.kind)) +
                     trf("{:3} trials", countTrials(store, session));
  for (const BlockRow& block : store.blocks(session.id)) {
    const std::string measured = thresholdText(block);
    if (!measured.empty()) line += ", " + measured;
    if (block.verdict != training::Verdict::none)
      line += fmt::format(", {}", tr(std::string(wordFor(block.verdict)).c_str()));
    if (!block.finished) line += std::string(", ") + tr("not finished");
  }
  return line + "\n";
}

void addResultsCommand(Command& train) {
  Command& command = *train.add_subcommand("results", "List, check, export and delete training records; print codes");
  command.require_subcommand(1);
  addResultsListCommand(command);
  addResultsTraineeCommand(command);
  addResultsClassCommand(command);
  addResultsCodesCommand(command);
  addResultsExportCommand(command);
  addResultsDeleteCommand(command);
  addResultsPurgeCommand(command);
  addResultsReplayCommand(command);
  addResultsReportCommand(command);
  addResultsVerifyCommand(command);
}

}  // namespace palpate::app
