// Options with numbers: each finite and in a range that help and error both name. Every number on the command line goes
// through here; a test tries invalid numbers on all options of all commands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/options.h"
#include "palpate/base/number_range.h"
#include "palpate/base/vec.h"

namespace palpate::app {

/// The valid numbers of an option. `unit` is for people and may be empty; a name with a unit in it need not repeat it.
struct Limits {
  NumberRange range;
  std::string unit = {};
};
inline Limits between(double low, double high, std::string unit = {}) { return {{low, high}, std::move(unit)}; }
inline Limits above(double low, double high, std::string unit = {}) { return {{low, high, true}, std::move(unit)}; }

/// Longest run, script and `seconds` of a scene.
inline constexpr double kLongestRunS = 10800.0;
/// Farther places are off every body.
inline constexpr double kFarthestMm = 1e5;

/// The values' types in the help; the test recognises options with numbers by them.
inline constexpr const char* kNumberType = "NUMBER";
inline constexpr const char* kCountType = "COUNT";
inline constexpr const char* kPlaceType = "X,Y,Z";

/// Parses a word of the command line. Throws UsageError, which names the option, unless it is a finite number in range.
double numberFrom(const std::string& option, const std::string& word, const Limits& limits);

/// The same for a whole number; 1e6 is one.
std::int64_t countFrom(const std::string& option, const std::string& word, const Limits& limits);

/// Numbers with commas between them, at least one; empty fields are errors.
std::vector<double> numbersFrom(const std::string& option, const std::string& words, const Limits& limits);

/// "(0 to 10,800 s)" for a help text, with a blank before it; empty without limits.
std::string rangeText(const Limits& limits);

/// The variable behind an option: a number, a whole number, or several of them (std::optional, std::vector,
/// std::array). Defined for the types of number_option.cpp.
class NumberTarget {
 public:
  template <class T>
  NumberTarget(T& value);  // NOLINT(google-explicit-constructor): acts as its variable
  template <class T, std::size_t N>
  NumberTarget(std::array<T, N>& values)  // NOLINT(google-explicit-constructor)
      : NumberTarget(values.data(), N) {}

 private:
  template <class T>
  NumberTarget(T* values, std::size_t count);

  bool whole_;
  int max_values_;
  /// Throws UsageError for words that are not valid numbers.
  std::function<void(const std::string& option, const std::vector<std::string>& words, const Limits& limits)> assign_;
  std::function<std::string()> shown_;  ///< the default in the help
  friend Option* addNumber(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                           const std::string& help);
};

/// Adds an option whose value is a number or several. `value` must outlive the command. The range is added to the help.
Option* addNumber(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                  const std::string& help);

/// The same; the help shows its present value as the default.
Option* addSetting(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                   const std::string& help);

/// Adds an option x,y,z in mm.
Option* addPlace(Command& command, const std::string& name, std::optional<Vec3>& value, const std::string& help);

}  // namespace palpate::app
