// `palpate study credibility`: the credibility file of this release.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "dissertation/command/commands.h"
#include "dissertation/credibility/credibility.h"

namespace palpate::app {

namespace {

// A number is beyond its bar.
constexpr int kBarBroken = 1;

struct CredibilityArguments {
  std::vector<std::string> files;
  std::string question;
  std::string context;
  std::string influence = std::string(wordFor(study::ContextOfUse{}.influence));
  std::string consequence = std::string(wordFor(study::ContextOfUse{}.consequence));
  std::string living;
  std::optional<std::uint64_t> seed;
  bool quick = false;
  bool json = false;
};

study::CredibilitySettings settingsOf(const CredibilityArguments& arguments) {
  study::CredibilitySettings settings;
  if (!arguments.question.empty()) settings.use.question = arguments.question;
  if (!arguments.context.empty()) settings.use.context = arguments.context;
  settings.use.influence = valueNamed<study::RiskLevel>(arguments.influence).value();
  settings.use.consequence = valueNamed<study::RiskLevel>(arguments.consequence).value();
  settings.living = arguments.living;
  settings.seed = arguments.seed.value_or(settings.seed);
  settings.quick = arguments.quick;
  return settings;
}

void runCredibility(const CredibilityArguments& arguments) {
  study::CredibilitySettings settings = settingsOf(arguments);
  ProgressLine progress;
  settings.progress = progress.callback();
  const study::CredibilityFile file = study::makeCredibility(settings);
  progress.clear();
  for (const std::string& name : arguments.files) study::writeCredibility(file, name);
  fmt::print("{}", arguments.json ? study::toJson(file) : study::textOf(file));
  if (!arguments.json) {
    for (const std::string& name : arguments.files) fmt::print("\n{}\n", name);
  }
  if (!file.holds()) throw ExitWith(kBarBroken);
}

/// Before anything is computed.
std::string wrongEnding(const std::string& name) {
  return name.ends_with(".html") || name.ends_with(".json") ? "" : name + ": must end in .html or .json";
}

}  // namespace

void addCredibilityCommand(Command& study) {
  auto arguments = std::make_shared<CredibilityArguments>();
  CredibilityArguments& a = *arguments;
  Command& command = *study.add_subcommand(
      "credibility",
      "Compute why this release's figures may be trusted, after ASME V&V 40: verification, validation by data set, "
      "uncertainty, limits (about a minute). Exit code 0 if every bar holds, 1 otherwise");
  namesFileToWrite(command.add_option("-o,--out", a.files, "File to write, repeatable: .html or .json"))
      ->check(wrongEnding);
  command.add_option("--question", a.question, "Question of interest (default: teaching and examining palpation)");
  command.add_option("--context", a.context, "Context of use (default: one fingertip in training, no patient)");
  const auto levels = enumNames<study::RiskLevel>();
  const std::vector<std::string> words(levels.begin(), levels.end());
  command.add_option("--influence", a.influence, "Influence of the model on the decision: low, medium, high")
      ->capture_default_str()
      ->check(IsMember{words});
  command.add_option("--consequence", a.consequence, "Consequence of a wrong decision: low, medium, high")
      ->capture_default_str()
      ->check(IsMember{words});
  command
      .add_option("--living", a.living,
                  "Also compare with presses on living limbs: their list or its folder "
                  "(docs/explanation/tissue.md; half a minute more)")
      ->check(ExistingPath{});
  addNumber(command, "--seed", a.seed, between(0, 1e15), "Seed of the bodies in the hunt and of the inputs");
  command.add_flag("--quick", a.quick, "Use fewer ticks, stacks and draws, to preview the file, not for its numbers");
  command.add_flag("--json", a.json, "Print one JSON object");
  command.callback([arguments] { runCredibility(*arguments); });
}

}  // namespace palpate::app
