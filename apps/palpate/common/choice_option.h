// An option with a few named values: `--tree bsp|octree`.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// For an option that keeps the name itself: it is one of these.
template <class Value>
CLI::IsMember oneChoiceOf() {
  std::vector<std::string> names;
  for (const auto& [name, value] : choicesOf<Value>()) names.push_back(name);
  return CLI::IsMember(names);
}

/// The names with bars between them.
template <class Value>
std::string namesOf(const Choices<Value>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : "|") + name;
  return names;
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
    throw CLI::ValidationError(option, "\"" + wanted + "\" is not one of " + namesOf(choices));
  };
  return command.add_option_function<std::string>(option, choose, help + standard)->type_name(namesOf(choices));
}

/// The same with all words of the enumeration.
template <class Value>
CLI::Option* addChoice(CLI::App& command, const std::string& option, Value& value, const std::string& help) {
  return addChoice(command, option, value, choicesOf<Value>(), help);
}

}  // namespace palpate::app
