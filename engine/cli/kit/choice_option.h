// An option with a few named values: `--tree bsp|octree`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/options.h"
#include "palpate/base/words.h"

namespace palpate::app {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;  ///< in the order of the help text

/// The words of an enumeration, which a command spells with hyphens.
template <class Value>
Choices<Value> makeChoices() {
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
  for (const auto& [name, value] : makeChoices<Value>()) {
    if (name == wanted) return value;
  }
  return std::nullopt;
}

template <class Value>
std::vector<std::string> choiceNames(const Choices<Value>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}
template <class Value>
std::vector<std::string> choiceNames() {
  return choiceNames(makeChoices<Value>());
}

/// The error for a word that is not among the names; empty for one of them.
std::string faultOfChoice(const std::string& wanted, const std::vector<std::string>& names);

/// Restricts an option that keeps the word itself to these, as the help says too.
Option* restrictTo(const std::vector<std::string>& names, Option* option);

/// addChoice for a value of any type: `choose` is called with the index of the chosen name, and `standard` is the index
/// of the default, none if no name is it.
Option* addIndexedChoice(Command& command, const std::string& option, const std::vector<std::string>& names,
                         std::optional<std::size_t> standard, const std::function<void(std::size_t)>& choose,
                         const std::string& help);

/// Adds an option that accepts one of the names; another is a usage error that lists them. `value` is the default,
/// shown in the help, and must outlive the command.
template <class Value>
Option* addChoice(Command& command, const std::string& option, Value& value, const Choices<Value>& choices,
                  const std::string& help) {
  std::optional<std::size_t> standard;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].second == value) standard = i;
  }
  const auto choose = [&value, choices](std::size_t place) { value = choices[place].second; };
  return addIndexedChoice(command, option, choiceNames(choices), standard, choose, help);
}

/// The same with all words of the enumeration.
template <class Value>
Option* addChoice(Command& command, const std::string& option, Value& value, const std::string& help) {
  return addChoice(command, option, value, makeChoices<Value>(), help);
}

/// For a command whose pages or windows are translated: it calls useLanguage(code). `code` must outlive the command.
Option* addLanguage(Command& command, std::string& code);

}  // namespace palpate::app
