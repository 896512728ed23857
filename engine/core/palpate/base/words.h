// The names of an enumeration's values as users write them: one table per type, from which scene files, commands,
// panels and writers all read.
//
// A module that names the values of a type has a wordTable for it in the namespace palpate (scene/words.h,
// scene/view_settings.h):
//
//   constexpr auto wordTable(Named<Shading>) { return wordsUpTo(Shading::skin, {"gouraud", "skin"}); }
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

template <class Value>
struct Word {
  std::string_view word;
  Value value;
};
template <class Value>
Word(const char*, Value) -> Word<Value>;

/// The enumeration that a wordTable is of.
template <class Value>
struct Named {};

/// A table in the order of the values from 0 to `last`. It does not compile where a value has no name; two that change
/// places in the enumeration must change places here.
template <class Value, std::size_t count>
consteval std::array<Word<Value>, count> wordsUpTo(Value last, const std::string_view (&names)[count]) {
  std::array<Word<Value>, count> words{};
  for (std::size_t i = 0; i < count; ++i) words[i] = {names[i], static_cast<Value>(i)};
  if (words.back().value != last) throw "a value without a name";
  return words;
}

/// `kAll` has each value once, in the order of menus and documents. A specialisation may have a `kFormer`: names of
/// earlier versions, which are still read, but never listed or written.
template <class Value>
struct WordsOf {
  static constexpr auto kAll = wordTable(Named<Value>{});
};

/// Empty for a value without a name.
template <class Value>
constexpr std::string_view wordFor(const Value& value) {
  for (const auto& [word, named] : WordsOf<Value>::kAll) {
    if (named == value) return word;
  }
  return {};
}

template <class Value>
constexpr std::optional<Value> valueNamed(std::string_view wanted) {
  for (const auto& [word, value] : WordsOf<Value>::kAll) {
    if (word == wanted) return value;
  }
  if constexpr (requires { WordsOf<Value>::kFormer; }) {
    for (const auto& [word, value] : WordsOf<Value>::kFormer) {
      if (word == wanted) return value;
    }
  }
  return std::nullopt;
}

/// The names only, in the table's order.
template <class Value>
constexpr auto enumNames() {
  std::array<std::string_view, WordsOf<Value>::kAll.size()> words;
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = WordsOf<Value>::kAll[i].word;
  return words;
}

/// The same for callers that keep or change them.
template <class Value>
std::vector<std::string> wordList() {
  constexpr auto kWords = enumNames<Value>();
  return {kWords.begin(), kWords.end()};
}

}  // namespace palpate
