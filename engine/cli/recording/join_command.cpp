// `palpate recording join`: recordings one after another in one file.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "palpate/base/json.h"
#include "palpate/trace/recording_edit.h"

namespace palpate::app {

namespace {

struct JoinArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path out;
  bool json = false;
};

void runJoin(const JoinArguments& arguments) {
  ProgressLine progress;
  const trace::ReadingWatch watch(throwIfInterrupted);
  const trace::Joined joined = trace::join(arguments.files, arguments.out, progress.callback());
  progress.clear();
  if (arguments.json) {
    const Json json = {{"file", arguments.out.string()},
                       {"samples", joined.samples},
                       {"begins", joined.begins},
                       {"last_tick", joined.last_tick},
                       {"notes", joined.notes}};
    printReadable(jsonText(json));
    return;
  }
  std::string text = fmt::format("{}: {} samples of {} recordings, one after another\n", arguments.out.string(),
                                 joined.samples, joined.begins.size());
  for (const std::string& note : joined.notes) text += "  note  " + note + "\n";
  printReadable(text);
}

}  // namespace

void addJoinCommand(Command& recording) {
  const auto [command, a] = addCommand(recording, "join", "Join recordings of the same fingers into one", runJoin);
  command.add_option("RECORDING", a.files, "Recording files, in order")->required()->expected(2, 1000);
  namesFileToWrite(command.add_option("-o,--out", a.out, "Recording file to write"))->required();
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
