#include "cli/kit/number_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>

#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

/// Above this not every whole number is a double.
constexpr double kExactCounts = 9007199254740992.0;  // 2^53

[[noreturn]] void refuse(const std::string& option, const std::string& cause) { throw UsageError(option, cause); }

std::string quoted(const std::string& word) { return "'" + oneLine(word) + "'"; }

std::optional<std::int64_t> wholeNumber(std::string_view word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string rangeText(const Limits& limits) {
  const std::string words = limits.range.words(limits.unit);
  return words.empty() ? words : " (" + words + ")";
}

double numberFrom(const std::string& option, const std::string& word, const Limits& limits) {
  const std::optional<double> number = parseNumber(word);
  if (!number) refuse(option, quoted(word) + " is not a number" + rangeText(limits));
  if (!std::isfinite(*number)) refuse(option, quoted(word) + " is not a finite number" + rangeText(limits));
  if (!limits.range.holds(*number)) refuse(option, outOfRange(oneLine(word), limits.range, limits.unit));
  return *number;
}

std::int64_t countFrom(const std::string& option, const std::string& word, const Limits& limits) {
  const double number = numberFrom(option, word, limits);
  if (const auto whole = wholeNumber(trimmed(word))) return *whole;
  if (number != std::floor(number)) refuse(option, quoted(word) + " is not a whole number" + rangeText(limits));
  if (std::abs(number) > kExactCounts) refuse(option, quoted(word) + " is too large a number");
  return static_cast<std::int64_t>(number);
}

std::vector<double> numbersFrom(const std::string& option, const std::string& words, const Limits& limits) {
  std::vector<double> numbers;
  for (const std::string_view field : split(words, ',')) {
    numbers.push_back(numberFrom(option, std::string(field), limits));
  }
  return numbers;
}

namespace {

template <class T>
T valueFrom(const std::string& option, const std::string& word, const Limits& limits) {
  if constexpr (std::integral<T>) {
    return static_cast<T>(countFrom(option, word, limits));
  } else {
    return numberFrom(option, word, limits);
  }
}

template <class T>
std::string listShown(const T* values, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}{}", i == 0 ? "" : ",", values[i]);
  return text;
}

// Conversions for one form of a variable.

template <class T>
struct Form {
  using Number = T;
  static constexpr int kMaxValues = 1;
  static void assign(T& value, const std::string& option, const std::vector<std::string>& words, const Limits& limits) {
    value = valueFrom<T>(option, words.front(), limits);
  }
  static std::string shown(const T& value) { return fmt::format("{}", value); }
};
template <class T>
struct Form<std::optional<T>> {
  using Number = T;
  static constexpr int kMaxValues = 1;
  static void assign(std::optional<T>& value, const std::string& option, const std::vector<std::string>& words,
                     const Limits& limits) {
    value = valueFrom<T>(option, words.front(), limits);
  }
  static std::string shown(const std::optional<T>& value) { return value ? fmt::format("{}", *value) : std::string(); }
};
template <class T>
struct Form<std::vector<T>> {
  using Number = T;
  static constexpr int kMaxValues = kAnyNumberOfValues;
  static void assign(std::vector<T>& values, const std::string& option, const std::vector<std::string>& words,
                     const Limits& limits) {
    values.clear();
    for (const std::string& word : words) values.push_back(valueFrom<T>(option, word, limits));
  }
  static std::string shown(const std::vector<T>& values) { return listShown(values.data(), values.size()); }
};

}  // namespace

template <class T>
NumberTarget::NumberTarget(T& value)
    : whole_(std::integral<typename Form<T>::Number>),
      max_values_(Form<T>::kMaxValues),
      assign_([&value](const std::string& option, const std::vector<std::string>& words, const Limits& limits) {
        Form<T>::assign(value, option, words, limits);
      }),
      shown_([&value] { return Form<T>::shown(value); }) {}

template <class T>
NumberTarget::NumberTarget(T* values, std::size_t count)
    : whole_(std::integral<T>),
      max_values_(static_cast<int>(count)),
      assign_([values, count](const std::string& option, const std::vector<std::string>& words, const Limits& limits) {
        for (std::size_t i = 0; i < std::min(count, words.size()); ++i)
          values[i] = valueFrom<T>(option, words[i], limits);
      }),
      shown_([values, count] { return listShown(values, count); }) {}

template NumberTarget::NumberTarget(double&);
template NumberTarget::NumberTarget(std::optional<double>&);
template NumberTarget::NumberTarget(std::vector<double>&);
template NumberTarget::NumberTarget(double*, std::size_t);
template NumberTarget::NumberTarget(int&);
template NumberTarget::NumberTarget(unsigned&);
template NumberTarget::NumberTarget(long&);
template NumberTarget::NumberTarget(unsigned long&);
template NumberTarget::NumberTarget(long long&);
template NumberTarget::NumberTarget(unsigned long long&);
template NumberTarget::NumberTarget(std::optional<int>&);
template NumberTarget::NumberTarget(std::optional<unsigned>&);
template NumberTarget::NumberTarget(std::optional<unsigned long>&);
template NumberTarget::NumberTarget(std::optional<unsigned long long>&);
template NumberTarget::NumberTarget(std::vector<int>&);

Option* addNumber(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                  const std::string& help) {
  const std::string shown_name = name.substr(name.find_last_of(',') + 1);
  const auto read = [assign = value.assign_, shown_name, limits](const std::vector<std::string>& words) {
    assign(shown_name, words, limits);
  };
  Option* option = command.add_option(name, read, help + rangeText(limits), value.shown_);
  option->type_name(value.whole_ ? kCountType : kNumberType);
  option->expected(value.max_values_);  // a vector takes any number, one after the other or the option repeated
  return option;
}

Option* addSetting(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                   const std::string& help) {
  return addNumber(command, name, value, limits, help)->capture_default_str();
}

Option* addPlace(Command& command, const std::string& name, std::optional<Vec3>& value, const std::string& help) {
  const auto read = [&value, name](const std::string& words) {
    const std::vector<double> numbers = numbersFrom(name, words, between(-kFarthestMm, kFarthestMm, "mm"));
    if (numbers.size() != 3) refuse(name, quoted(words) + " must be three numbers x,y,z in mm");
    value = Vec3(numbers[0], numbers[1], numbers[2]);
  };
  return command.add_option_function(name, read, help)->type_name(kPlaceType);
}

}  // namespace palpate::app
