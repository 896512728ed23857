// One table says everything about the keys of a scene file: how each is read, which values it takes, what it is when it
// is left out and what it means. The reader, its error messages and `palpate simulate --keys` all come from it.
//
// Used by the tables (scene_keys.h) and by who reads or writes whole files.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/path_text.h"
#include "palpate/base/vec.h"
#include "palpate/base/words.h"
#include "palpate/scene/detail/toml_node.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// A value in the file and its place.
struct Entry {
  const TomlNode& node;
  std::string_view file;
  std::string name;  ///< as the user writes it, e.g. "finger.radius_mm"

  std::size_t line() const { return node.line(); }
  [[noreturn]] void fail(std::string_view cause) const {
    throw Error::atLine(file, line(), fmt::format("{} {}", name, cause));
  }
};

using Range = NumberRange;
inline constexpr Range atLeast(double low) { return {low}; }
inline constexpr Range between(double low, double high) { return {low, high}; }
inline constexpr Range above(double low, double high = std::numeric_limits<double>::infinity()) {
  return {low, high, true};
}

/// One key of a table whose settings are an S.
template <class S>
struct Key {
  std::string name;
  std::string takes;    ///< type and range in words
  std::string meaning;  ///< one sentence, with unit and reason
  std::function<void(S&, const Entry&)> read;
  std::function<std::string(const S&)> show;  ///< the value as in a file; empty = none
  KeyForm form = {};
  bool first = false;  ///< read before the others, which overrule it
};

double readNumber(const Entry& entry, const Range& range);
std::size_t readCount(const Entry& entry, std::size_t low, std::size_t high);
std::string readText(const Entry& entry);
bool readFlag(const Entry& entry);
std::vector<double> readNumbers(const Entry& entry, const Range& range);
/// Exactly `count` numbers.
std::vector<double> readPoint(const Entry& entry, std::size_t count, const Range& range);
/// Throws Error, naming all choices, for another text.
std::string readWord(const Entry& entry, const std::vector<std::string>& choices);
template <class E>
E readChoice(const Entry& entry) {
  const std::string word = readText(entry);
  if (const auto value = valueNamed<E>(word)) return *value;  // words of earlier versions too
  return *valueNamed<E>(readWord(entry, wordList<E>()));
}

/// A text as in a file: in quotes, with what would end or break it written as escapes.
std::string inQuotes(std::string_view text);
std::string showNumber(double value);
std::string showNumbers(const std::vector<double>& values);
std::string rangeSuffix(const Range& range);
std::string formatChoices(const std::vector<std::string>& choices);

/// A way from the settings to one number, text, ... of them; lets a key reach into a nested struct.
template <class S, class T>
using Access = std::function<T&(S&)>;

/// The way to a member of a member: way(&BodySettings::torso, &body::TorsoSettings::triangles).
template <class... Members>
auto way(Members... members) {
  return [=](auto& settings) -> decltype(auto) { return (settings.*....*members); };
}

template <class S, class T>
T valueOf(const Access<S, T>& access, const S& settings) {
  S copy = settings;
  return access(copy);
}

template <class S>
Key<S> number(std::string name, Access<S, double> at, Range range, std::string meaning) {
  return {std::move(name),
          "number" + rangeSuffix(range),
          std::move(meaning),
          [at, range](S& s, const Entry& e) { at(s) = readNumber(e, range); },
          [at](const S& s) { return showNumber(valueOf<S, double>(at, s)); },
          {KeyForm::Kind::number, range.low, range.high}};
}

/// A whole number of the unsigned type N, which must hold `high`.
template <class S, class N = std::size_t>
Key<S> count(std::string name, std::type_identity_t<Access<S, N>> at, std::type_identity_t<N> low,
             std::type_identity_t<N> high, std::string meaning) {
  return {std::move(name),
          "whole number" + rangeSuffix(between(static_cast<double>(low), static_cast<double>(high))),
          std::move(meaning),
          [=](S& s, const Entry& e) { at(s) = static_cast<N>(readCount(e, low, high)); },
          [at](const S& s) { return fmt::format("{}", valueOf<S, N>(at, s)); },
          {KeyForm::Kind::whole, static_cast<double>(low), static_cast<double>(high)}};
}

template <class S>
Key<S> flag(std::string name, Access<S, bool> at, std::string meaning) {
  return {std::move(name),
          "true or false",
          std::move(meaning),
          [at](S& s, const Entry& e) { at(s) = readFlag(e); },
          [at](const S& s) { return valueOf<S, bool>(at, s) ? "true" : "false"; },
          {KeyForm::Kind::flag}};
}

template <class S>
Key<S> text(std::string name, Access<S, std::string> at, std::string meaning) {
  return {std::move(name),
          "text",
          std::move(meaning),
          [at](S& s, const Entry& e) { at(s) = readText(e); },
          [at](const S& s) {
            const std::string value = valueOf<S, std::string>(at, s);
            return value.empty() ? value : inQuotes(value);
          },
          {KeyForm::Kind::text}};
}

/// A file, relative to the folder of the scene file.
inline constexpr std::string_view kTakesFile = "file name";
template <class S>
Key<S> file(std::string name, Access<S, std::filesystem::path> at, std::string meaning) {
  return {std::move(name),
          std::string(kTakesFile),
          std::move(meaning),
          [at](S& s, const Entry& e) { at(s) = pathOf(e.file).parent_path() / pathOf(readText(e)); },
          [at](const S& s) {
            const std::filesystem::path path = valueOf<S, std::filesystem::path>(at, s);
            return path.empty() ? std::string()
                                : inQuotes(std::filesystem::absolute(path).lexically_normal().generic_string());
          },
          {KeyForm::Kind::file}};
}

/// One of the words of an enumeration (WordsOf).
template <class S, class E>
Key<S> choice(std::string name, Access<S, E> at, std::string meaning) {
  return {std::move(name),
          formatChoices(wordList<E>()),
          std::move(meaning),
          [at](S& s, const Entry& e) { at(s) = readChoice<E>(e); },
          [at](const S& s) { return fmt::format("\"{}\"", wordFor(valueOf<S, E>(at, s))); },
          {KeyForm::Kind::choice, 0.0, 0.0, wordList<E>()}};
}

template <class S>
Key<S> numbers(std::string name, Access<S, std::vector<double>> at, Range range, std::string meaning) {
  return {std::move(name), "list of numbers" + rangeSuffix(range), std::move(meaning),
          [at, range](S& s, const Entry& e) { at(s) = readNumbers(e, range); },
          [at](const S& s) { return showNumbers(valueOf<S, std::vector<double>>(at, s)); }};
}

template <class S>
Key<S> point2(std::string name, Access<S, Vec2> at, Range range, std::string meaning) {
  return {std::move(name), "two numbers" + rangeSuffix(range), std::move(meaning),
          [at, range](S& s, const Entry& e) {
            const auto v = readPoint(e, 2, range);
            at(s) = Vec2(v[0], v[1]);
          },
          [at](const S& s) {
            const Vec2 v = valueOf<S, Vec2>(at, s);
            return showNumbers({v.x(), v.y()});
          }};
}

inline Vec3 readPoint3(const Entry& entry, const Range& range) {
  const std::vector<double> v = readPoint(entry, 3, range);
  return {v[0], v[1], v[2]};
}

/// For a place in numbers of settings that may name it by `at`: a named place is written by its name.
template <class S>
Key<S> unlessNamed(Key<S> key) {
  key.show = [show = std::move(key.show)](const S& s) { return s.at.empty() ? show(s) : std::string(); };
  return key;
}

template <class S>
Key<S> point3(std::string name, Access<S, Vec3> at, Range range, std::string meaning) {
  return {std::move(name), "three numbers" + rangeSuffix(range), std::move(meaning),
          [at, range](S& s, const Entry& e) { at(s) = readPoint3(e, range); },
          [at](const S& s) {
            const Vec3 v = valueOf<S, Vec3>(at, s);
            return showNumbers({v.x(), v.y(), v.z()});
          }};
}

/// A place that need not be given.
template <class S>
Key<S> place(std::string name, Access<S, std::optional<Vec3>> at, Range range, std::string meaning) {
  return {std::move(name), "three numbers" + rangeSuffix(range), std::move(meaning),
          [at, range](S& s, const Entry& e) { at(s) = readPoint3(e, range); },
          [at](const S& s) {
            const std::optional<Vec3> v = valueOf<S, std::optional<Vec3>>(at, s);
            return v ? showNumbers({v->x(), v->y(), v->z()}) : std::string();
          }};
}

/// Reads every key of `table` into the settings; `title` is the table's header as in a file.
template <class S>
void readTable(const TomlNode& table, std::string_view title, std::string_view file_name,
               const std::vector<Key<S>>& keys, S& settings, const std::vector<std::string>& nested = {}) {
  std::vector<std::string> names = nested;
  for (const Key<S>& key : keys) names.push_back(key.name);
  const auto read = [&](const Key<S>& key, const TomlNode& node) {
    key.read(settings, {node, file_name, title.empty() ? key.name : fmt::format("{} {}", title, key.name)});
  };
  for (const Key<S>& key : keys) {
    const TomlNode* node = key.first ? table.get(key.name) : nullptr;
    if (node != nullptr) read(key, *node);
  }
  for (const TomlEntry& entry : table.entries()) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key<S>& k) { return k.name == entry.key; });
    if (key != keys.end()) {
      if (!key->first) read(*key, entry.node);
    } else if (std::find(nested.begin(), nested.end(), entry.key) == nested.end()) {
      throw Error::atLine(file_name, entry.place.line, unknownName("key", entry.key, title, names));
    }
  }
}

}  // namespace palpate::scene
