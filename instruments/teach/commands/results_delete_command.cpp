// `palpate train results delete` and `purge`: forgetting one trainee, or rows kept for long enough; at a station, in a
// class's file or in its database.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/commands/class_part.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

using training::Store;

struct DeleteArguments {
  ResultsArguments results;
  std::string trainee;
  bool yes = false;
  bool dry_run = false;
};

struct RowsOf {
  std::size_t sessions = 0;
  std::size_t trials = 0;
};

RowsOf rowsOf(Store& store, const training::TraineeRow& trainee) {
  RowsOf rows;
  for (const training::SessionRow& session : store.sessions(trainee.id)) {
    ++rows.sessions;
    for (const training::BlockRow& block : store.blocks(session.id)) rows.trials += store.trials(block.id).size();
  }
  return rows;
}

bool confirmDeletion(const RowsOf& rows, const training::TraineeRow& trainee, std::string_view what) {
  say(fmt::format("Delete trainee {} for ever: {} sessions, {} trials{}?\nType yes to delete: ", trainee.id,
                  rows.sessions, rows.trials, what));
  std::string answer;
  std::getline(std::cin, answer);
  return trimmed(answer) == "yes";
}

void printDeletedJson(const Json& json) { fmt::print("{}\n", jsonDump(json, 2)); }

void deleteInDatabase(const DeleteArguments& arguments, Store& copy, const training::TraineeRow& trainee) {
  const RowsOf rows = rowsOf(copy, trainee);
  const auto& [found, left] = classPart().erase(arguments.results.file, trainee.id, "palpate train results");
  if (arguments.results.json) {
    printDeletedJson(
        {{"deleted", found && left.empty()}, {"sittings", rows.sessions}, {"trials", rows.trials}, {"not_done", left}});
  } else {
    fmt::print("{} {}: {} sessions, {} trials; later rows of this trainee are not stored\n",
               left.empty() ? "deleted in" : "only removed from the tables of", copy.file().string(), rows.sessions,
               rows.trials);
  }
  if (!left.empty()) {
    fmt::print(stderr, "palpate: NOT deleted for good: {}\n", left);
    throw ExitWith(1);
  }
  if (arguments.results.json) return;
  fmt::print("Records at stations are not reached: delete there as well, where there are any.\n");
}

void runResultsDelete(const DeleteArguments& arguments) {
  Store store = openedResults(arguments.results);
  const bool in_database = training::isDatabaseAddress(arguments.results.file);
  const training::TraineeRow trainee = traineeCalled(store, arguments.trainee);
  const std::string_view what = in_database ? ", in the class's database" : ", their recordings and their key";
  if (!arguments.yes && !confirmDeletion(rowsOf(store, trainee), trainee, what)) {
    fmt::print(stderr, "nothing was deleted (--yes does not ask)\n");
    throw ExitWith(1);
  }
  if (in_database) return deleteInDatabase(arguments, store, trainee);
  const training::Deleted deleted = deleteTrainee(store, trainee.id, "palpate train results");
  if (arguments.results.json) {
    return printDeletedJson({{"deleted", deleted.found},
                             {"sittings", deleted.sessions},
                             {"trials", deleted.trials},
                             {"session_files", deleted.files},
                             {"key", deleted.key},
                             {"class_is_told", store.fillsOutbox()}});
  }
  fmt::print("deleted: {} sessions, {} trials, {} recordings{}\n", deleted.sessions, deleted.trials, deleted.files,
             deleted.key ? ", the key" : "");
  fmt::print("{}Exports and backups made before are not deleted.\n",
             store.fillsOutbox() ? "The class deletes its copy at the next connection. " : "");
}

void runResultsPurge(const DeleteArguments& arguments) {
  Store store = openedResults(arguments.results);
  const std::int64_t now = training::utcMs();
  const bool in_database = training::isDatabaseAddress(arguments.results.file) && !arguments.dry_run;
  const auto& [purged, left] = in_database ? classPart().purge(arguments.results.file, now)
                                           : training::PurgedFromDatabase{purge(store, now, !arguments.dry_run), ""};
  if (!left.empty()) fmt::print(stderr, "palpate: NOT deleted for good: {}\n", left);
  if (arguments.results.json) {
    const Json json = {{"purged", !arguments.dry_run},
                       {"sittings", purged.sessions},
                       {"session_files", purged.files},
                       {"trainees", purged.trainees}};
    fmt::print("{}\n", jsonDump(json, 2));
    return;
  }
  fmt::print("{}: {} sessions, {} recordings, {} trainees of whom nothing is left\n",
             arguments.dry_run ? "old enough to go" : "gone", purged.sessions, purged.files, purged.trainees);
}

}  // namespace

void addResultsDeleteCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "delete", "Delete one trainee: rows, recordings, key; from the class too", runResultsDelete);
  addResultsFile(command, arguments.results);
  addClassFolder(command, arguments.results);
  command.add_option("--trainee", arguments.trainee, kTraineeHelp)->required()->type_name("CODE");
  command.add_flag("--yes", arguments.yes, "Do not ask for confirmation");
}

void addResultsPurgeCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "purge", "Delete what classes have kept for their retention time", runResultsPurge);
  addResultsFile(command, arguments.results);
  command.add_flag("--dry-run", arguments.dry_run, "Count only, delete nothing");
}

}  // namespace palpate::app
