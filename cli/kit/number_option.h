// Options that take numbers: each finite and in a range that help and error both say. Every number on the command line
// goes through here; a test walks over all options of all commands and feeds them what is no number.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cli/kit/cli11.h"
#include "palpate/base/number_range.h"
#include "palpate/base/vec.h"

namespace palpate::app {

/// What an option takes. `unit` is for people and may be empty; a name with a unit in it need not repeat it.
struct Limits {
  NumberRange range;
  std::string unit = {};
};
inline Limits between(double low, double high, std::string unit = {}) { return {{low, high}, std::move(unit)}; }
inline Limits above(double low, double high, std::string unit = {}) { return {{low, high, true}, std::move(unit)}; }

/// A run, a script and a scene's `seconds` last no longer.
inline constexpr double kLongestRunS = 10800.0;
/// A place farther than this is on no body.
inline constexpr double kFarthestMm = 1e5;

/// What the help calls the values; the test knows options that take numbers by it.
inline constexpr const char* kNumberType = "NUMBER";
inline constexpr const char* kCountType = "COUNT";
inline constexpr const char* kPlaceType = "X,Y,Z";

/// The number that a word of the command line says. Throws CLI::ValidationError, which names the option, for what is no
/// number, not finite or out of range.
double numberFrom(const std::string& option, const std::string& word, const Limits& limits);

/// The same for a whole number; 1e6 is one.
std::int64_t countFrom(const std::string& option, const std::string& word, const Limits& limits);

/// Numbers with commas between them, at least one; an empty field is no number.
std::vector<double> numbersFrom(const std::string& option, const std::string& words, const Limits& limits);

/// "(0 to 10,800 s)" for a help text, with a blank before it; empty without limits.
std::string rangeWords(const Limits& limits);

namespace number_option {

template <class T>
T valueFrom(const std::string& option, const std::string& word, const Limits& limits) {
  if constexpr (std::integral<T>) {
    return static_cast<T>(countFrom(option, word, limits));
  } else {
    return numberFrom(option, word, limits);
  }
}

// How the words of one option become its value.

template <class T>
requires std::is_arithmetic_v<T>
void assign(const std::string& option, const CLI::results_t& words, const Limits& limits, T& value) {
  value = valueFrom<T>(option, words.front(), limits);
}
template <class T>
void assign(const std::string& option, const CLI::results_t& words, const Limits& limits, std::optional<T>& value) {
  value = valueFrom<T>(option, words.front(), limits);
}
template <class T>
void assign(const std::string& option, const CLI::results_t& words, const Limits& limits, std::vector<T>& values) {
  values.clear();
  for (const std::string& word : words) values.push_back(valueFrom<T>(option, word, limits));
}
template <class T, std::size_t N>
void assign(const std::string& option, const CLI::results_t& words, const Limits& limits, std::array<T, N>& values) {
  std::transform(words.begin(), words.end(), values.begin(),
                 [&](const std::string& word) { return valueFrom<T>(option, word, limits); });
}

// The default as the help shows it.

template <class T>
requires std::is_arithmetic_v<T> std::string shown(const T& value) { return fmt::format("{}", value); }
template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? shown(*value) : std::string();
}
template <class List>
requires requires(const List& list) { list.size(); }
std::string shown(const List& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ",") + shown(value);
  return text;
}

template <class T>
struct Form {
  static constexpr int kMax = 1;
  using Number = T;
};
template <class T>
struct Form<std::optional<T>> : Form<T> {};
template <class T>
struct Form<std::vector<T>> {
  static constexpr int kMax = CLI::detail::expected_max_vector_size;
  using Number = T;
};
template <class T, std::size_t N>
struct Form<std::array<T, N>> {
  static constexpr int kMax = static_cast<int>(N);
  using Number = T;
};

}  // namespace number_option

/// Adds an option whose value is a number, a whole number, or several of them (std::optional, std::vector, std::array).
/// `value` must outlive the command. The range is added to the help.
template <class T>
CLI::Option* addNumber(CLI::App& command, const std::string& name, T& value, const Limits& limits,
                       const std::string& help) {
  using Form = number_option::Form<T>;
  const std::string shown_name = name.substr(name.find_last_of(',') + 1);
  const auto read = [&value, shown_name, limits](const CLI::results_t& words) {
    number_option::assign(shown_name, words, limits, value);
    return true;
  };
  CLI::Option* option = command.add_option(name, read, help + rangeWords(limits), false,
                                           [&value] { return number_option::shown(value); });
  option->type_name(std::integral<typename Form::Number> ? kCountType : kNumberType);
  option->expected(Form::kMax);  // of a vector any number, one after the other or the option repeated
  return option;
}

/// The same; the value that it has now stands in the help as its default.
template <class T>
CLI::Option* addSetting(CLI::App& command, const std::string& name, T& value, const Limits& limits,
                        const std::string& help) {
  return addNumber(command, name, value, limits, help)->capture_default_str();
}

/// Adds an option x,y,z in mm.
CLI::Option* addPlace(CLI::App& command, const std::string& name, std::optional<Vec3>& value, const std::string& help);

}  // namespace palpate::app
