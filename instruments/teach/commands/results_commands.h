// The subcommands of `palpate train results`, and their common part: which file, which trainee, how times and
// thresholds read.
#pragma once

#include <filesystem>
#include <string>

#include "cli/kit/options.h"
#include "palpate/base/json.h"
#include "palpate/training/records/store.h"

namespace palpate::app {

// `parent` is the results command.
void addResultsListCommand(Command& parent);
void addResultsTraineeCommand(Command& parent);
void addResultsClassCommand(Command& parent);
void addResultsCodesCommand(Command& parent);
void addResultsExportCommand(Command& parent);
void addResultsDeleteCommand(Command& parent);
void addResultsPurgeCommand(Command& parent);
void addResultsReplayCommand(Command& parent);
void addResultsReportCommand(Command& parent);
void addResultsVerifyCommand(Command& parent);

struct ResultsArguments {
  std::string class_folder;  ///< its secret distinguishes pseudonyms from codes; empty: what the records remember
  std::string file;          ///< or the address of a class's database; empty: the user's own
  bool json = false;
};
/// --class DIR, for commands that are given a code.
void addClassFolder(Command& command, ResultsArguments& arguments);
/// [FILE] and --json. `arguments` must outlive the command.
void addResultsFile(Command& command, ResultsArguments& arguments);

/// Migrates an older file. Throws Error, which says where records are made when there are none.
training::Store openedResults(const ResultsArguments& arguments);

/// A file, or a copy of the database at this address (class_part.h).
training::Store recordsAt(const std::string& file_or_address, training::Store::Open how);

/// Finds a trainee by the code on their card, their pseudonym, or its first letters. Throws Error.
training::TraineeRow traineeCalled(training::Store& store, const std::string& code_or_id);

/// Help text of the trainee argument.
inline constexpr const char* kTraineeHelp = "The code on the trainee's card, or the pseudonym (its beginning will do)";

std::string formatUtcTime(std::int64_t ms);  ///< "2026-11-22 10:03", UTC
/// "18 % (13 to 25 %)"; empty: none was measured.
std::string thresholdText(const training::BlockRow& block);
Json blockJson(const training::BlockRow& block);
Json sessionJson(training::Store& store, const training::SessionRow& session);
/// "2026-11-22 10:03  5d79b3cd  pre-test  40 trials, 18 % (13 to 25 %)"
std::string sessionLine(training::Store& store, const training::SessionRow& session);

}  // namespace palpate::app
