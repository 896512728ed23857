// `palpate`: reads the command line and hands over to the chosen subcommand, or to the program that holds it.
#include <fmt/format.h>

#include <optional>

#include "cli/kit/command_pages.h"
#include "cli/kit/commands.h"
#include "cli/kit/families.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/system/process.h"

namespace {

using namespace palpate::app;

constexpr int kWrongInput = 2;

/// For the help: what other programs do.
void addFamilies(CLI::App& app) {
  for (const FamilyCommand& row : familyCommands()) {
    const std::size_t space = row.command.find(' ');
    CLI::App& parent =
        space == std::string_view::npos ? app : commandGroup(app, std::string(row.command.substr(0, space)));
    const std::string name(row.command.substr(space == std::string_view::npos ? 0 : space + 1));
    CLI::App& command = *parent.add_subcommand(name, std::string(row.what));
    if (&parent == &app) command.group(std::string(row.group));
  }
  // Last: what is added to a group takes over its heading.
  commandGroup(app, "body").group("Bodies");
  commandGroup(app, "recording").group("Recordings");
}

/// `run` is the window with the modes of every package that is there. A shell that asks what may come next asks whom
/// the command is of. Nothing: the command is one of our own.
std::optional<int> handOver(const std::vector<std::string>& words) {
  const bool completes = !words.empty() && words.front() == kCompleteOption;
  const std::vector<std::string> typed(words.begin() + (completes ? 1 : 0), words.end());
  const FamilyCommand* command = familyOf(typed);
  if (command != nullptr) return becomeFamily(*command, words);
  if (!typed.empty() && typed.front() == "run" && !familyProgram("measure").empty()) {
    return becomeFamily({.group = {}, .command = "run", .family = "measure", .what = {}}, words);
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words = withPresentCommand(palpate::system::commandLine(argc, argv));
  try {
    if (const std::optional<int> exit_code = handOver(words)) return *exit_code;
  } catch (const std::exception& error) {
    say(fmt::format("palpate: {}\n", error.what()));
    return kWrongInput;
  }
  CLI::App app{"Palpate: feel, see and measure touch on a soft human body.", "palpate"};
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
