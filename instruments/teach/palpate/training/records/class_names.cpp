#include "palpate/training/records/class_names.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace palpate::training {

namespace {

constexpr std::size_t kLongestClassWord = 32;

}  // namespace

bool isClassWord(std::string_view text) {
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && text.size() <= kLongestClassWord && text.front() != '-' && std::ranges::all_of(text, plain);
}

bool isDatabaseAddress(std::string_view text) {
  constexpr std::array<std::string_view, 5> kBeginnings = {"postgresql://", "postgres://",
                                                           "dbname=", "host=", "service="};
  return std::ranges::any_of(kBeginnings, [text](std::string_view word) { return text.starts_with(word); }) ||
         text.find(" dbname=") != std::string_view::npos;
}

}  // namespace palpate::training
