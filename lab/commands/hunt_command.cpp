// `palpate study hunt`: random bodies and paths, judged by code that shares nothing with the finger; failing paths are
// made short and written as cases.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "cli/kit/commands.h"
#include "cli/kit/interruption.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/hunt_options.h"
#include "lab/commands/hunt_report.h"
#include "lab/hunt/hunt.h"

namespace palpate::app {

namespace {

/// The answer of a hunt that found something: the command ran and says "no".
[[noreturn]] void endWithFindings() { throw CLI::RuntimeError(1); }

void runReplay(const HuntArguments& arguments) {
  bool found = false;
  for (const std::string& folder : arguments.replay) {
    const lab::KeptCase kept = lab::readCase(folder);
    const lab::HuntReport report = lab::replay(kept);
    found = found || !report.clean();
    fmt::print("{}", replayText(folder, kept, report));
  }
  if (found) endWithFindings();
}

void runHunt(const HuntArguments& arguments) {
  ProgressLine progress;
  lab::HuntPlan plan = planOf(arguments, progress.callback());
  const FinishesInOrder in_order;
  plan.stop = [] { return endAskedBy() != 0; };
  const lab::HuntResult result = lab::hunt(plan, progress.display());
  std::vector<std::string> files(result.failing.size());
  if (!arguments.out.empty()) files = writeCases(plan, result, arguments, progress.display());
  progress.clear();
  fmt::print("{}", arguments.json ? huntJson(plan, result, files).dump(2) + "\n" : huntText(result, files));
  if (!result.failing.empty()) endWithFindings();
}

}  // namespace

void addHuntCommand(CLI::App& study) {
  auto arguments = std::make_shared<HuntArguments>();
  CLI::App& command = *study.add_subcommand(
      "hunt", "Look for faults of the finger on random bodies and paths (exit code 0: none, 1: some, 2: wrong usage)");
  addHuntOptions(command, *arguments);
  command.callback([arguments] { arguments->replay.empty() ? runHunt(*arguments) : runReplay(*arguments); });
}

}  // namespace palpate::app
