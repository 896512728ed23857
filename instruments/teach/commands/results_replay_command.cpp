// `palpate train results replay`: one trial out of a locked recording, as a session that every other command knows.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/trace/recording_edit.h"
#include "palpate/training/records/recording_files.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

struct TrialReplayArguments {
  ResultsArguments results;
  std::string trial;
  std::string out;
};

/// Finds a trial by its id, or by the end of one id: the beginning is the time.
training::TrialRow trialCalled(training::Store& store, const std::string& id) {
  if (const auto found = store.rows().trial(id)) return *found;
  std::vector<training::TrialRow> found;
  for (const training::SessionRow& session : store.sessions()) {
    for (const training::BlockRow& block : store.blocks(session.id)) {
      for (const training::TrialRow& trial : store.trials(block.id)) {
        if (id.size() >= 4 && trial.id.ends_with(id)) found.push_back(trial);
      }
    }
  }
  if (found.size() == 1) return found.front();
  throw Error(fmt::format("trial '{}': {}; `palpate train results export --csv` lists the ids", oneLine(id),
                          found.empty() ? "no trial here has this id" : "several trials' ids end like this"));
}

void runTrialReplay(const TrialReplayArguments& arguments) {
  training::Store store = openedResults(arguments.results);
  const training::TrialRow trial = trialCalled(store, arguments.trial);
  const auto session = store.rows().session(trial.session_id);
  if (!session) throw Error(fmt::format("trial {} belongs to no session", trial.id));
  if (store.holdsCopies()) {
    throw Error::inFile(store.file().string(), "holds no samples: they stay at the station; replay the trial there");
  }
  std::error_code error;
  if (std::filesystem::exists(arguments.out, error))
    throw Error::inFile(arguments.out, "exists already; name another file");
  const training::OpenedRecording opened = training::RecordingFiles(store).open(*session);
  ProgressLine progress;
  trace::RecordingReader recording(opened.file());
  const trace::TrimSettings settings{{trial.file_tick_first, trial.file_tick_last}, false};
  const trace::Trimmed trimmed = trace::trim(recording, settings, arguments.out, progress.callback());
  progress.clear();
  if (arguments.results.json) {
    const Json json = {{"file", arguments.out},
                       {"trial", trial.id},
                       {"samples", trimmed.copied.samples},
                       {"first_tick", trimmed.copied.first_tick},
                       {"last_tick", trimmed.copied.last_tick}};
    fmt::print("{}\n", jsonDump(json, 2));
    return;
  }
  fmt::print("{}: trial {}, {} samples; it is not locked: remove it when you are done\n", arguments.out, trial.number,
             trimmed.copied.samples);
}

}  // namespace

void addResultsReplayCommand(Command& parent) {
  const auto [command, arguments] = addCommand(
      parent, "replay", "Write one trial as a recording, for palpate recording replay, run, render and report",
      runTrialReplay);
  command.add_option("TRIAL", arguments.trial, "Id of the trial, or the end of it")->required();
  addResultsFile(command, arguments.results);
  namesFileToWrite(command.add_option("-o,--out", arguments.out, "Recording to write"))
      ->required()
      ->type_name("OUT.session");
}

}  // namespace palpate::app
