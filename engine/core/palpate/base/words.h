// The names of an enumeration's values as users write them: one table per type, from which scene files, commands,
// panels and writers all read.
//
// A module that names the values of a type specialises WordsOf for it (scene/words.h, scene/view_settings.h):
//
//   template <>
//   struct WordsOf<Shading> {
//     static constexpr std::array kAll = {Word{"gouraud", Shading::gouraud}, Word{"skin", Shading::skin}};
//   };
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

/// `kAll` has each value once, in the order of menus and documents. `kFormer`, if any, has names of earlier versions:
/// they are still read, but never listed or written.
template <class Value>
struct WordsOf;

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
