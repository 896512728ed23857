// `palpate`: reads the command line and hands over to the chosen subcommand, or to the program that holds it.
#include <filesystem>
#include <optional>
#include <system_error>

#include "cli/kit/command_pages.h"
#include "cli/kit/commands.h"
#include "cli/kit/families.h"
#include "cli/kit/program.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/trace/forces_table.h"
#include "palpate/window/window.h"

namespace {

using namespace palpate::app;

/// Printed where no window can be opened.
constexpr const char* kFirstSteps =
    "Palpate: feel, see and measure touch on a soft human body.\n"
    "  palpate run         Open a window and touch a body with the mouse (needs a display; here is none)\n"
    "  palpate simulate    Palpate without a window or device and write what was felt\n"
    "  palpate train       Train and examine palpation\n"
    "  palpate body ...    Make, fit, repair, look into and map a body\n"
    "  palpate --help      All commands; palpate COMMAND --help says more\n";

/// A file in place of a command: no command has a point or a slash in its name.
bool isFile(const std::string& word) {
  std::error_code error;
  return !word.starts_with('-') && word.find_first_of("./\\") != std::string::npos &&
         std::filesystem::is_regular_file(palpate::pathOf(word), error);
}

/// The default without a command: the window, with a file if one is named; help in one more way.
std::vector<std::string> withMeantCommand(std::vector<std::string> words) {
  if (words.empty()) return {"run"};
  if (words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  } else if (isFile(words.front())) {
    const std::filesystem::path file = palpate::pathOf(words.front());
    if (isRecordingFile(file) || palpate::trace::isForcesTable(file)) words.insert(words.begin(), "--replay");
    words.insert(words.begin(), "run");
  }
  return words;
}

/// Lists the commands of other programs in the help.
void addFamilies(Command& app) {
  for (const FamilyCommand& row : familyCommands()) {
    const std::size_t space = row.command.find(' ');
    Command& parent =
        space == std::string_view::npos ? app : commandGroup(app, std::string(row.command.substr(0, space)));
    const std::string name(row.command.substr(space == std::string_view::npos ? 0 : space + 1));
    Command& command = *parent.add_subcommand(name, std::string(row.what));
    if (&parent == &app) command.group(std::string(row.group));
  }
  // Last, because additions to a group take over its heading.
  commandGroup(app, "body").group("Bodies");
  commandGroup(app, "recording").group("Recordings");
}

/// `run` is the window with the modes of every installed package. A shell's request for completions goes to the program
/// of the command. Empty for a command of our own.
std::optional<int> delegateToFamily(const std::vector<std::string>& words) {
  const bool completes = !words.empty() && words.front() == kCompleteOption;
  const std::vector<std::string> typed(words.begin() + (completes ? 1 : 0), words.end());
  const FamilyCommand* command = findFamilyCommand(typed);
  if (command != nullptr) return becomeFamily(*command, words);
  if (!typed.empty() && typed.front() == "run" && !familyProgram("measure").empty()) {
    return becomeFamily({.group = {}, .command = "run", .family = "measure", .what = {}}, words);
  }
  return std::nullopt;
}

int runTypedCommand(const std::vector<std::string>& typed) {
  if (typed.empty() && !palpate::window::displayOffered()) return printed(kFirstSteps);
  const std::vector<std::string> words = withMeantCommand(withPresentCommand(typed));
  if (const std::optional<int> exit_code = delegateToFamily(words)) return *exit_code;
  Command app{"Palpate: feel, see and measure touch on a soft human body.", "palpate"};
  app.allow_windows_style_options(false);  // "/tmp" is a folder
  app.set_version_flag("--version", PALPATE_VERSION);
  app.require_subcommand(1);
  addOwnCommands(app);
  addFamilies(app);
  app.footer(
      "Examples:\n"
      "  palpate run --preset vhb                 Touch the dissertation's Virtual Haptic Back\n"
      "  palpate run my_scan.stl                  Touch any mesh with the mouse\n"
      "  palpate simulate --preset vhb --json     Palpate without a window or device, and print what was felt");
  return runCommandLine(app, words);
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram([&] { return runTypedCommand(palpate::system::commandLine(argc, argv)); });
}
