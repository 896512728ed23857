// A command line from its words to an exit code: corrections of misspelt and renamed words, and one line for every
// error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string_view>
#include <system_error>

#include "cli/kit/command_pages.h"
#include "cli/kit/commands.h"
#include "cli/kit/interruption.h"
#include "cli/kit/program.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "palpate/base/error_text.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/system/files.h"
#include "palpate/base/system/process.h"
#include "palpate/base/system/signals.h"
#include "palpate/scene/host.h"

namespace palpate::app {

namespace {

constexpr int kWrongInput = 2;

// --- unknown words and suggestions

/// The command that the words before the unknown one chose.
const Command& chosenCommand(const Command& app) {
  const std::vector<Command*> chosen = app.get_subcommands();
  return chosen.empty() ? app : chosenCommand(*chosen.back());
}

/// "palpate bench contact"
std::string fullName(const Command& command) {
  const Command* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : fullName(*parent) + " " + command.get_name();
}

std::vector<std::string> subcommandNames(const Command& command) {
  std::vector<std::string> names;
  for (const Command* sub : command.all_subcommands()) {
    names.push_back(sub->get_name());
  }
  return names;
}

/// Without their hyphens, which do not help to find the nearest.
std::vector<std::string> optionNames(const Command& command) {
  std::vector<std::string> names;
  for (const Option* option : command.get_options()) {
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  return names;
}

std::string unknownOption(const Command& command, const std::string& word) {
  const std::string written = word.substr(0, word.find('='));
  const std::string nearest = nearestName(written.substr(written.find_first_not_of('-')), optionNames(command));
  const std::string hint = nearest.empty() ? nearest : fmt::format("; did you mean '--{}'?", nearest);
  return fmt::format("unknown option '{}' of {}{}", oneLine(written), fullName(command), hint);
}

/// For a word that is neither command nor option, CLI11 says at most that something is missing.
std::string explainUsageError(const Command& app, const UsageError& error) {
  const std::vector<std::string> unknown = app.remaining();
  if (!error.isAboutArguments() || unknown.empty()) return error.what();
  const std::string& word = unknown.front();
  const Command& command = chosenCommand(app);
  if (word.find_first_not_of('-') == std::string::npos) return error.what();
  if (word.starts_with('-')) return unknownOption(command, word);
  const std::vector<std::string> commands = subcommandNames(command);
  if (!commands.empty()) return unknownName("command", word, "", commands);
  return fmt::format("'{}' is one word too many for {}", oneLine(word), fullName(command));
}

// --- renamed options

struct RenamedOption {
  std::string_view before, now;
};
constexpr std::array kRenamedOptions = {
    RenamedOption{"--output", "--out"},
    RenamedOption{"--skin-output", "--skin-out"},
    RenamedOption{"--bones-output", "--bones-out"},
    RenamedOption{"--unit-mm", "--unit"},
    RenamedOption{"--mesh-unit", "--unit"},
    RenamedOption{"--mesh-group", "--group"},
};

/// The word with the option's present name; prints the change once for each word.
std::string withPresentName(const std::string& word) {
  for (const auto& [before, now] : kRenamedOptions) {
    if (!word.starts_with(before) || (word.size() > before.size() && word[before.size()] != '=')) continue;
    say(fmt::format("palpate: note: {} is called {} now; the old name will go\n", before, now));
    return std::string(now) + word.substr(before.size());
  }
  return word;
}

std::vector<std::string>& wordsTyped() {
  static std::vector<std::string> words;
  return words;
}

int parse(Command& app, const std::vector<std::string>& words) {
  std::vector<std::string> last_first;  // order of CLI11
  for (auto word = words.rbegin(); word != words.rend(); ++word) last_first.push_back(withPresentName(*word));
  wordsTyped().assign(last_first.rbegin(), last_first.rend());
  try {
    app.parse(last_first);
  } catch (const ExitWith& answer) {
    return answer.code();
  } catch (const UsageError& error) {
    say(readableText(fmt::format("palpate: {} (see --help)\n", explainUsageError(app, error))));
    return kWrongInput;
  }
  return 0;
}

/// Output may still be in a buffer, and the disk that it goes to full.
int flushed(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  const int reason = errno;
  if (reason == EPIPE) return signalExitCode(system::kBrokenPipe);  // the reader has what it wanted
  say(fmt::format("palpate: standard output: cannot be written: {}\n", std::generic_category().message(reason)));
  return kWrongInput;
}

/// Answers requests of shells and of the build, which are not in the help. Returns false for everything else.
bool answered(const Command& app, const std::vector<std::string>& words) {
  if (words.empty()) return false;
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (words.front() == kCompleteOption) {
    for (const std::string& word : findCompletions(app, rest)) fmt::print("{}\n", word);
    return true;
  }
  if (words.front() != kManOption) return false;
  fmt::print("{}", manPage(app, rest.empty() ? app.get_name() : rest.front()));
  return true;
}

int runToTheEnd(Command& app, const std::vector<std::string>& words) {
  try {
    return flushed(answered(app, words) ? 0 : parse(app, words));
  } catch (const Ended&) {
    say(fmt::format("palpate: ended by {}\n", nameOfSignal(endingSignal())));
  } catch (const std::system_error& error) {  // fmt's, when it cannot print
    if (std::ferror(stdout) != 0) return flushed(kWrongInput);
    say(fmt::format("palpate: {}\n", error.what()));
  } catch (const std::exception& error) {  // it may quote a user's file
    say(readableText(fmt::format("palpate: {}\n", palpate::textOf(error))));
  }
  return kWrongInput;
}

// --- commands that were at the top in 0.2

struct MovedCommand {
  std::string_view before, now;
};
constexpr std::array kMovedCommands = {
    MovedCommand{"annotate", "recording annotate"},
    MovedCommand{"bench", "study bench"},
    MovedCommand{"bundle", "recording bundle"},
    MovedCommand{"export", "recording export"},
    MovedCommand{"fit", "tissue fit"},
    MovedCommand{"fit-body", "body fit"},
    MovedCommand{"hunt", "study hunt"},
    MovedCommand{"info", "body info"},
    MovedCommand{"join", "recording join"},
    MovedCommand{"map", "body map"},
    MovedCommand{"model", "body make"},
    MovedCommand{"partition", "study partition"},
    MovedCommand{"plot", "recording plot"},
    MovedCommand{"realism", "tissue realism"},
    MovedCommand{"record", "recording new"},
    MovedCommand{"repair", "body repair"},
    MovedCommand{"replay", "recording replay"},
    MovedCommand{"report", "recording report"},
    MovedCommand{"results", "train results"},
    MovedCommand{"sessions", "recording list"},
    MovedCommand{"trim", "recording trim"},
};

/// Recordings and records of training shared one command.
std::string_view presentCommand(const MovedCommand& moved, const std::vector<std::string>& words) {
  const auto of_training = [](const std::string& word) {
    return word.ends_with(".results") || word.starts_with("postgres");
  };
  const bool training = moved.before == "report" && std::ranges::any_of(words, of_training);
  return training ? "train results report" : moved.now;
}

}  // namespace

std::vector<std::string> withPresentCommand(std::vector<std::string> words) {
  const auto moved =
      words.empty() ? kMovedCommands.end() : std::ranges::find(kMovedCommands, words.front(), &MovedCommand::before);
  if (moved == kMovedCommands.end()) return words;
  std::string_view now = presentCommand(*moved, words);
  say(fmt::format("palpate: note: `palpate {}` is called `palpate {}` now; the old name will go\n", moved->before,
                  now));
  words.erase(words.begin());
  std::size_t place = 0;
  for (std::size_t space = now.find(' '); space != std::string_view::npos; space = now.find(' ')) {
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(place++), std::string(now.substr(0, space)));
    now.remove_prefix(space + 1);
  }
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(place), std::string(now));
  return words;
}

Command& commandGroup(Command& app, const std::string& name) {
  struct Group {
    std::string_view name, what;
  };
  static constexpr std::array kGroups = {
      Group{"body", "A body: made, fitted to a scan, repaired, looked into, mapped"},
      Group{"recording", "Recordings: made, listed, replayed, cut, reported, shared"},
  };
  for (Command* known : app.all_subcommands()) {
    if (known->get_name() == name) return *known;
  }
  const auto group = std::ranges::find(kGroups, name, &Group::name);
  Command& added = *app.add_subcommand(name, std::string(group->what));
  added.require_subcommand(1);
  return added;
}

int printed(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flushed(0);
}

int runProgram(const std::function<int()>& body) {
  installHost();
  system::holdStandardStreams();
  system::makeFailedWritesErrors();
  system::returnLargeArrays();
  try {
    return body();
  } catch (const std::exception& error) {
    say(fmt::format("palpate: {}\n", palpate::textOf(error)));
  }
  return kWrongInput;
}

const std::vector<std::string>& typedWords() { return wordsTyped(); }

int runCommandLine(Command& app, const std::vector<std::string>& words) {
  listenForSignals();
  const int exit_code = runToTheEnd(app, words);
  return endingSignal() == 0 ? exit_code : signalExitCode(endingSignal());
}

}  // namespace palpate::app
