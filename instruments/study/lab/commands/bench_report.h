// One runner for all commands of `palpate study bench`: a name, its options, and a function that measures.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "lab/counters/figures_json.h"
#include "palpate/base/json.h"
#include "report/page/figures_text.h"

namespace palpate::app {

/// {cpu, cores, memory_gb, kernel, compiler, build, simd, palpate}
Json machineJson();

/// Prints the JSON object with the machine as its last key, or the text with the machine as its last line.
void printReport(Json json, const std::string& text, bool as_json);

/// Adds a benchmark. `add_options(command, arguments)` adds all options but --json; `measure(arguments, progress)`
/// gives the figures.
template <class Arguments, class AddOptions>
Arguments& addBench(Command& parent, const std::string& name, const std::string& help, const AddOptions& add_options,
                    Json (*measure)(const Arguments&, ProgressLine&)) {
  const auto arguments = std::make_shared<Arguments>();
  const auto as_json = std::make_shared<bool>(false);
  Command& command = *parent.add_subcommand(name, help);
  add_options(command, *arguments);
  command.add_flag("--json", *as_json, "Print one JSON object");
  command.callback([arguments, as_json, measure, &command] {
    if constexpr (requires { arguments->input.radius_given; }) {
      arguments->input.radius_given = command.count("--radius-mm") > 0;
    }
    ProgressLine progress;
    Json figures = measure(*arguments, progress);
    progress.clear();
    const std::string text = study::figuresText(figures);
    printReport(std::move(figures), text, *as_json);
  });
  return *arguments;
}

/// No subcommand: the regression guard `palpate study bench --baseline FILE`.
void addBenchBaseline(Command& bench);

}  // namespace palpate::app
