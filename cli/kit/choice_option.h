// An option with a few named values: `--tree bsp|octree`.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/cli11.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/words.h"

namespace palpate::app {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;  ///< in the order of the help text

/// The words of an enumeration, which a command spells with hyphens.
template <class Value>
Choices<Value> choicesOf() {
  Choices<Value> choices;
  for (const auto& [word, value] : WordsOf<Value>::kAll) {
    choices.emplace_back(word, value);
    std::replace(choices.back().first.begin(), choices.back().first.end(), '_', '-');
  }
  return choices;
}

/// The value of one of these names.
template <class Value>
std::optional<Value> choiceNamed(const std::string& wanted) {
  for (const auto& [name, value] : choicesOf<Value>()) {
    if (name == wanted) return value;
  }
  return std::nullopt;
}

template <class Value>
std::vector<std::string> namesOf(const Choices<Value>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}
template <class Value>
std::vector<std::string> choiceNames() {
  return namesOf(choicesOf<Value>());
}

/// What is wrong with a word that is none of these; empty for one of them.
inline std::string faultOfChoice(const std::string& wanted, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return {};
  const std::string nearest = nearestName(wanted, names);
  const std::string hint = nearest.empty() ? nearest : fmt::format("; did you mean '{}'?", nearest);
  return fmt::format("'{}' is not one of {}{}", oneLine(wanted), fmt::join(names, "|"), hint);
}

/// For an option that keeps the word itself: it is one of these, as the help says too.
inline CLI::Option* takesOneOf(const std::vector<std::string>& names, CLI::Option* option) {
  option->check(CLI::Validator([names](const std::string& wanted) { return faultOfChoice(wanted, names); }, ""));
  return option->type_name(fmt::format("{}", fmt::join(names, "|")));
}

/// Adds an option that takes one of the names; another is a usage error that says which there are. `value` is the
/// default, shown in the help, and must outlive the command.
template <class Value>
CLI::Option* addChoice(CLI::App& command, const std::string& option, Value& value, const Choices<Value>& choices,
                       const std::string& help) {
  std::string standard;
  for (const auto& [name, choice] : choices) {
    if (choice == value) standard = "; default " + name;
  }
  const auto choose = [&value, choices, option](const std::string& wanted) {
    for (const auto& [name, choice] : choices) {
      if (CLI::detail::to_lower(name) != CLI::detail::to_lower(wanted)) continue;
      value = choice;
      return;
    }
    throw CLI::ValidationError(option, faultOfChoice(wanted, namesOf(choices)));
  };
  return command.add_option_function<std::string>(option, choose, help + standard)
      ->type_name(fmt::format("{}", fmt::join(namesOf(choices), "|")));
}

/// The same with all words of the enumeration.
template <class Value>
CLI::Option* addChoice(CLI::App& command, const std::string& option, Value& value, const std::string& help) {
  return addChoice(command, option, value, choicesOf<Value>(), help);
}

/// For a command whose pages or windows are translated: it calls useLanguage(code). `code` must outlive the command.
inline CLI::Option* addLanguage(CLI::App& command, std::string& code) {
  std::vector<std::string> codes;
  for (const Language& language : languages()) codes.emplace_back(language.code);
  return takesOneOf(codes,
                    command.add_option("--language", code, "Language of what people read (default: the system's)"));
}

}  // namespace palpate::app
