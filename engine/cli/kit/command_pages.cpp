#include "cli/kit/command_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "cli/kit/families.h"

namespace palpate::app {

namespace {

const Command* commandNamed(const Command& app, const std::string& word) {
  const std::vector<Command*> commands = app.all_subcommands();
  const auto found = std::ranges::find(commands, word, [](const Command* command) { return command->get_name(); });
  return found == commands.end() ? nullptr : *found;
}

/// "--out", "-o"; empty for a positional argument.
std::vector<std::string> optionSpellings(const Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

const Option* optionNamed(const Command& app, const std::string& word) {
  for (const Option* option : app.get_options()) {
    if (std::ranges::count(optionSpellings(*option), word) > 0) return option;
  }
  return nullptr;
}

bool isFlag(const Option& option) { return option.get_items_expected_max() == 0; }

/// "dry|oiled|none" as its words; empty for an option with other values too, which are written in capitals.
std::vector<std::string> optionValues(const Option& option) {
  const std::string type = option.get_type_name();
  std::vector<std::string> words;
  if (type.find('|') == std::string::npos) return words;
  for (std::size_t at = 0; at <= type.size();) {
    const std::size_t end = std::min(type.find('|', at), type.size());
    const std::string word = type.substr(at, end - at);
    if (std::ranges::none_of(word, [](unsigned char letter) { return std::isupper(letter) != 0; })) {
      words.push_back(word);
    }
    at = end + 1;
  }
  return words;
}

// --- man

/// Lines that begin with a dot or a quote are commands to roff, and hyphens would be set as dashes.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if ((letter == '.' || letter == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
    if (letter == '\\')
      escaped += "\\e";
    else if (letter == '-')
      escaped += "\\-";
    else if (letter == '|')
      escaped += "|\\:";  // a list of words may be broken here
    else
      escaped += letter;
  }
  return escaped;
}

std::string defaultOf(const Option& option) {
  const std::string& text = option.get_default_str();
  return text.empty() ? text : fmt::format(" (default: {})", text);
}

std::string optionText(const Option& option) {
  std::vector<std::string> names = optionSpellings(option);
  if (names.empty()) names = {option.get_name()};  // positional
  std::string text = fmt::format(".TP\n\\fB{}\\fR", roff(fmt::format("{}", fmt::join(names, ", "))));
  if (!isFlag(option) && !option.get_type_name().empty())
    text += fmt::format(" \\fI{}\\fR", roff(option.get_type_name()));
  return text + "\n" + roff(option.get_description() + defaultOf(option)) + "\n";
}

std::string optionsText(const Command& command) {
  std::string text;
  for (const Option* option : command.get_options()) {
    if (option != command.get_help_ptr()) text += optionText(*option);
  }
  return text;
}

/// Every command under this one that does something, with its options.
std::string commandsText(const Command& app, const std::string& words) {
  std::string text;
  for (const Command* command : app.all_subcommands()) {
    const std::string name = words + " " + command->get_name();
    if (command->all_subcommands().empty()) {
      text += fmt::format(".SS {}\n{}\n{}", roff(name), roff(command->get_description()), optionsText(*command));
    } else {
      text += commandsText(*command, name);
    }
  }
  return text;
}

std::string seeAlso(const std::string& program) {
  if (program != "palpate") return "palpate(1)";
  std::set<std::string> pages;
  for (const FamilyCommand& row : familyCommands()) pages.insert(fmt::format("palpate-{}(1)", row.family));
  return fmt::format("{}", fmt::join(pages, ", "));
}

}  // namespace

std::vector<std::string> findCompletions(const Command& app, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  const Command* command = &app;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (const Command* next = commandNamed(*command, words[i])) command = next;
  }
  std::vector<std::string> candidates;
  const Option* before = words.size() < 2 ? nullptr : optionNamed(*command, words[words.size() - 2]);
  if (before != nullptr && !isFlag(*before)) {
    candidates = optionValues(*before);
  } else if (words.back().starts_with('-')) {
    for (const Option* option : command->get_options()) {
      for (std::string& name : optionSpellings(*option)) candidates.push_back(std::move(name));
    }
  } else {
    for (const Command* sub : command->all_subcommands()) candidates.push_back(sub->get_name());
  }
  std::erase_if(candidates, [&](const std::string& word) { return !word.starts_with(words.back()); });
  return candidates;
}

std::string manPage(const Command& app, const std::string& program) {
  return fmt::format(
      ".TH {} 1 \"\" \"Palpate {}\" \"Palpate\"\n.ad l\n.SH NAME\n{} \\- feel, see and measure touch on a soft human "
      "body\n"
      ".SH SYNOPSIS\n.B palpate\n\\fICOMMAND\\fR [\\fIOPTION\\fR ...]\n"
      ".SH EXIT STATUS\n0: done; 1: the command's answer is \"no\"; 2: wrong input; 128 and its number: ended by a "
      "signal.\n"
      ".SH COMMANDS\nEvery command takes \\fB\\-\\-help\\fR.\n{}.SH SEE ALSO\n{}\n",
      roff(program), roff(app.version()), roff(program), commandsText(app, "palpate"), roff(seeAlso(program)));
}

}  // namespace palpate::app
