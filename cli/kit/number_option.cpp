#include "cli/kit/number_option.h"

#include <charconv>
#include <cmath>

#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

/// Above this not every whole number is a double.
constexpr double kExactCounts = 9007199254740992.0;  // 2^53

[[noreturn]] void refuse(const std::string& option, const std::string& cause) {
  throw CLI::ValidationError(option, cause);
}

std::string quoted(const std::string& word) { return "'" + oneLine(word) + "'"; }

std::optional<std::int64_t> wholeNumber(std::string_view word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string rangeWords(const Limits& limits) {
  const std::string words = limits.range.words(limits.unit);
  return words.empty() ? words : " (" + words + ")";
}

double numberFrom(const std::string& option, const std::string& word, const Limits& limits) {
  const std::optional<double> number = parseNumber(word);
  if (!number) refuse(option, quoted(word) + " is not a number" + rangeWords(limits));
  if (!std::isfinite(*number)) refuse(option, quoted(word) + " is not a finite number" + rangeWords(limits));
  if (!limits.range.holds(*number)) refuse(option, outOfRange(oneLine(word), limits.range, limits.unit));
  return *number;
}

std::int64_t countFrom(const std::string& option, const std::string& word, const Limits& limits) {
  const double number = numberFrom(option, word, limits);
  if (const auto whole = wholeNumber(trimmed(word))) return *whole;
  if (number != std::floor(number)) refuse(option, quoted(word) + " is not a whole number" + rangeWords(limits));
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

CLI::Option* addPlace(CLI::App& command, const std::string& name, std::optional<Vec3>& value, const std::string& help) {
  const auto read = [&value, name](const std::string& words) {
    const std::vector<double> numbers = numbersFrom(name, words, between(-kFarthestMm, kFarthestMm, "mm"));
    if (numbers.size() != 3) refuse(name, quoted(words) + " must be three numbers x,y,z in mm");
    value = Vec3(numbers[0], numbers[1], numbers[2]);
  };
  return command.add_option_function<std::string>(name, read, help)->type_name(kPlaceType);
}

}  // namespace palpate::app
