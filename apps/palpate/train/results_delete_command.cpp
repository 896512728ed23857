// `palpate results delete` and `purge`: forgetting one trainee, or what has been kept for long enough.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "apps/palpate/common/progress_line.h"
#include "apps/palpate/train/results_commands.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::app {

namespace {

using training::Store;

struct DeleteArguments {
  ResultsArguments results;
  std::string trainee;
  bool yes = false;
  bool dry_run = false;
};

bool saidYes(Store& store, const training::TraineeRow& trainee) {
  std::size_t sittings = 0, trials = 0;
  for (const training::SittingRow& sitting : store.sittings(trainee.id)) {
    ++sittings;
    for (const training::BlockRow& block : store.blocks(sitting.id)) trials += store.trials(block.id).size();
  }
  say(
      fmt::format("Delete trainee {} for ever: {} sittings, {} trials, their session files and their key?\n"
                  "Type yes to delete: ",
                  trainee.id, sittings, trials));
  std::string answer;
  std::getline(std::cin, answer);
  return trimmed(answer) == "yes";
}

void runResultsDelete(const DeleteArguments& arguments) {
  Store store = openedResults(arguments.results);
  const training::TraineeRow trainee = traineeCalled(store, arguments.trainee);
  if (!arguments.yes && !saidYes(store, trainee)) {
    fmt::print(stderr, "nothing was deleted (--yes does not ask)\n");
    throw CLI::RuntimeError(1);
  }
  const training::Deleted deleted = deleteTrainee(store, trainee.id, "palpate results");
  if (arguments.results.json) {
    const nlohmann::ordered_json json = {{"deleted", deleted.found}, {"sittings", deleted.sittings},
                                         {"trials", deleted.trials}, {"session_files", deleted.files},
                                         {"key", deleted.key},       {"class_is_told", store.fillsOutbox()}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("deleted: {} sittings, {} trials, {} session files{}\n", deleted.sittings, deleted.trials, deleted.files,
             deleted.key ? ", the key" : "");
  fmt::print("{}Exports and backups that you made before are not reached.\n",
             store.fillsOutbox() ? "The class is told when it is next reached. " : "");
}

void runResultsPurge(const DeleteArguments& arguments) {
  Store store = openedResults(arguments.results);
  const training::Purged purged = purge(store, training::utcMs(), !arguments.dry_run);
  if (arguments.results.json) {
    const nlohmann::ordered_json json = {{"purged", !arguments.dry_run},
                                         {"sittings", purged.sittings},
                                         {"session_files", purged.files},
                                         {"trainees", purged.trainees}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: {} sittings, {} session files, {} trainees of whom nothing is left\n",
             arguments.dry_run ? "old enough to go" : "gone", purged.sittings, purged.files, purged.trainees);
}

}  // namespace

void addResultsDeleteCommand(CLI::App& parent) {
  const auto arguments = std::make_shared<DeleteArguments>();
  CLI::App& command = *parent.add_subcommand("delete", "Forget one trainee: rows, session files, key; the class too");
  addResultsFile(command, arguments->results);
  command.add_option("--trainee", arguments->trainee, kTraineeHelp)->required()->type_name("CODE");
  command.add_flag("--yes", arguments->yes, "Do not ask");
  command.callback([arguments] { runResultsDelete(*arguments); });
}

void addResultsPurgeCommand(CLI::App& parent) {
  const auto arguments = std::make_shared<DeleteArguments>();
  CLI::App& command = *parent.add_subcommand("purge", "Forget what the classes have kept for as long as they said");
  addResultsFile(command, arguments->results);
  command.add_flag("--dry-run", arguments->dry_run, "Only count");
  command.callback([arguments] { runResultsPurge(*arguments); });
}

}  // namespace palpate::app
