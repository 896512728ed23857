// `palpate study`: the dissertation's numbers and figures, computed and drawn by the engine.
//
// Each study is a subcommand with a file of its own in study/.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "apps/palpate/commands.h"
#include "study/numbers_report.h"
#include "study/numbers_study.h"

namespace palpate::app {

namespace {

// A number that differs without an erratum that says why.
constexpr int kNotReproduced = 1;

struct NumbersArguments {
  std::string folder;
  bool json = false;
};

void runNumbers(const NumbersArguments& arguments) {
  const auto rows = study::studyNumbers();
  fmt::print("{}", arguments.json ? study::jsonOf(rows) : study::textOf(rows));
  if (!arguments.folder.empty()) study::writeNumbers(rows, arguments.folder);
  if (!study::studyHolds(rows)) throw CLI::RuntimeError(kNotReproduced);
}

void addNumbers(CLI::App& study) {
  auto arguments = std::make_shared<NumbersArguments>();
  CLI::App& command = *study.add_subcommand(
      "numbers",
      "Every number of the dissertation that can be computed, beside ours. Exit code 0 when each is reproduced or is a "
      "misprint named by its erratum, 1 otherwise");
  command.add_option("--out", arguments->folder,
                     "Also write numbers.md, numbers.csv and numbers.json into this folder");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runNumbers(*arguments); });
}

}  // namespace

void addStudyCommand(CLI::App& app) {
  CLI::App& study = *app.add_subcommand("study", "The dissertation's numbers and figures, reproduced");
  study.require_subcommand(1);
  addNumbers(study);
}

}  // namespace palpate::app
