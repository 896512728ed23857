// Options that take numbers: each finite and in a range that help and error both say. Every number on the command line
// goes through here; a test walks over all options of all commands and feeds them what is no number.
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

/// The number that a word of the command line says. Throws UsageError, which names the option, for what is no
/// number, not finite or out of range.
double numberFrom(const std::string& option, const std::string& word, const Limits& limits);

/// The same for a whole number; 1e6 is one.
std::int64_t countFrom(const std::string& option, const std::string& word, const Limits& limits);

/// Numbers with commas between them, at least one; an empty field is no number.
std::vector<double> numbersFrom(const std::string& option, const std::string& words, const Limits& limits);

/// "(0 to 10,800 s)" for a help text, with a blank before it; empty without limits.
std::string rangeWords(const Limits& limits);

/// Where the numbers of an option go: into a number, a whole number, or several of them (std::optional, std::vector,
/// std::array). Defined for the types of number_option.cpp.
class NumberTarget {
 public:
  template <class T>
  NumberTarget(T& value);  // NOLINT(google-explicit-constructor): stands for its variable
  template <class T, std::size_t N>
  NumberTarget(std::array<T, N>& values)  // NOLINT(google-explicit-constructor)
      : NumberTarget(values.data(), N) {}

 private:
  template <class T>
  NumberTarget(T* values, std::size_t count);

  bool whole_;
  int max_values_;
  /// Throws UsageError for words that are not such numbers.
  std::function<void(const std::string& option, const std::vector<std::string>& words, const Limits& limits)> assign_;
  std::function<std::string()> shown_;  ///< as the help shows the default
  friend Option* addNumber(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                           const std::string& help);
};

/// Adds an option whose value is a number or several. `value` must outlive the command. The range is added to the help.
Option* addNumber(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                  const std::string& help);

/// The same; the value that it has now stands in the help as its default.
Option* addSetting(Command& command, const std::string& name, const NumberTarget& value, const Limits& limits,
                   const std::string& help);

/// Adds an option x,y,z in mm.
Option* addPlace(Command& command, const std::string& name, std::optional<Vec3>& value, const std::string& help);

}  // namespace palpate::app
