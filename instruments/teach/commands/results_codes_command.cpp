// `palpate train results codes`: cards for trainees to sign in with. Nothing is kept of them: a code becomes a
// pseudonym when it is first typed, and who got which is the teacher's own list.
#include <fmt/format.h>

#include <memory>
#include <set>
#include <vector>

#include "cli/kit/number_option.h"
#include "palpate/base/json.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/commands/class_part.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

struct CodesArguments {
  int count = 12;
  std::string class_id;
  std::string key;  ///< secret of a class that has one
  bool csv = false;
  bool json = false;
};

std::vector<std::string> newCodes(int count) {
  std::set<std::string> codes;
  while (static_cast<int>(codes.size()) < count) codes.insert(training::makeTraineeCode(training::systemRandom()[0]));
  return {codes.begin(), codes.end()};
}

std::string formatCodeCard(const std::string& code, const std::string& class_id) {
  const std::string title = class_id.empty() ? "Palpation training" : "Palpation training, " + class_id;
  return fmt::format("+{0:-<38}+\n| {1:<36} |\n| {2:<36} |\n| {3:<36} |\n| {2:<36} |\n| {4:<36} |\n+{0:-<38}+\n\n", "",
                     title.substr(0, 36), "", "Your code:   " + code, "Keep it: it is how you sign in.");
}

void runResultsCodes(const CodesArguments& arguments) {
  const std::vector<std::string> codes = newCodes(arguments.count);
  if (arguments.json) {
    Json list = Json::array();
    for (const std::string& code : codes) {
      list.push_back({{"code", code}, {"trainee", training::derivePseudonym(arguments.class_id, code, arguments.key)}});
    }
    fmt::print("{}\n", jsonDump(Json{{"class", arguments.class_id}, {"codes", list}}, 2));
    return;
  }
  std::string text = arguments.csv ? "code,pseudonym,class,name (keep this list outside)\n" : "";
  for (const std::string& code : codes) {
    text += arguments.csv
                ? fmt::format("{},{},{},\n", code, training::derivePseudonym(arguments.class_id, code, arguments.key),
                              arguments.class_id)
                : formatCodeCard(code, arguments.class_id);
  }
  fmt::print("{}", text);
}

}  // namespace

void addResultsCodesCommand(Command& parent) {
  const auto [command, arguments] = addCommand<CodesArguments>(
      parent, "codes", "New codes to sign in with, as cards to print", [](CodesArguments& a) {
        if (!a.class_id.empty() && std::filesystem::is_directory(a.class_id)) {
          training::ClassSecret secret = classPart().secret(a.class_id);
          a.class_id = secret.class_id;
          a.key = secret.key;
        }
        runResultsCodes(a);
      });
  addSetting(command, "--count", arguments.count, between(1, 10000), "Number of codes");
  command
      .add_option("--class", arguments.class_id,
                  "Class to print pseudonyms for: its folder, or its id if the class has no secret")
      ->type_name("DIR");
  Option* csv = command.add_flag("--csv", arguments.csv, "Print a table with room for names instead of cards");
  command.add_flag("--json", arguments.json, "Print one JSON object")->excludes(csv);
}

}  // namespace palpate::app
