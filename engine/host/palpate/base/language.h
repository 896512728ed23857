// The words of windows, training and reports in the reader's language. The code has them in English; catalogues of
// gettext have the others.
//
//   tr("Save picture") in the code ─ tools/check-translations ─► packaging/po/de.po
//   packaging/po/de.po ─ msgfmt ─► share/locale/de/…/palpate.mo ─► here
//
// Scene files, recordings, tables, JSON, options and errors stay English: machines and scripts read them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace palpate {

struct Language {
  std::string_view code;      ///< code of ISO 639: "de"
  std::string_view own_name;  ///< "Deutsch"
  char decimal_sign = '.';
  std::string_view thousands_sign = ",";
};

/// English first.
std::span<const Language> languages();

/// From now on. "": the system's, by the rules of gettext (LANGUAGE where the locale of LC_ALL, LC_MESSAGES or LANG is
/// not C, else that locale), where we have it. `folder`: where the catalogues are; empty: those of the running program.
/// Throws Error for a code that languages() lacks. It changes the process's environment: call it before other threads
/// run.
void useLanguage(std::string_view code, const std::filesystem::path& folder = {});

/// The one in use; English until useLanguage is called.
const Language& language() noexcept;

/// The translation of a literal of the code, or the literal itself if untranslated. Any thread.
const char* tr(const char* english) noexcept;
/// The form for a count.
const char* trn(const char* one, const char* many, std::size_t count) noexcept;

/// Marks a literal of a table for the catalogues; tr() translates it where it is shown.
constexpr const char* toTranslate(const char* english) { return english; }

/// A number as people write it: with the language's decimal sign.
struct WrittenNumber {
  double value = 0.0;
};

template <class Value>
decltype(auto) asWritten(const Value& value) {
  if constexpr (std::floating_point<Value>) {
    return WrittenNumber{static_cast<double>(value)};
  } else {
    return (value);
  }
}

/// fmt::vformat, or an empty text where the format does not fit the values: a catalogue is a file.
std::string formattedIfFit(const char* format, fmt::format_args values);

/// The translation filled, or the English where it does not fit; fractional numbers with the language's decimal sign.
template <class... Values>
std::string filled(const char* translation, const char* english, const Values&... values) {
  const auto fill = [](const char* format, const auto&... written) {
    return formattedIfFit(format, fmt::make_format_args(written...));
  };
  const std::string text = fill(translation, asWritten(values)...);
  return text.empty() ? fill(english, asWritten(values)...) : text;
}

/// The translation of a literal with {} in it, filled.
template <class... Values>
std::string trf(fmt::format_string<Values...> english, const Values&... values) {
  const fmt::string_view words(english);
  return filled(tr(words.data()), words.data(), values...);
}

/// The form for a count, filled: trnf("{} contact", "{} contacts", n, n).
template <class... Values>
std::string trnf(fmt::format_string<Values...> one, fmt::format_string<Values...> many, std::size_t count,
                 const Values&... values) {
  const fmt::string_view single(one);
  const fmt::string_view several(many);
  return filled(trn(single.data(), several.data(), count), (count == 1 ? single : several).data(), values...);
}

}  // namespace palpate

template <>
struct fmt::formatter<palpate::WrittenNumber> : fmt::formatter<double> {
  auto format(const palpate::WrittenNumber& number, fmt::format_context& context) const {
    fmt::memory_buffer digits;
    fmt::format_context plain(fmt::appender(digits), context.args(), context.locale());
    fmt::formatter<double>::format(number.value, plain);
    return std::replace_copy(digits.begin(), digits.end(), context.out(), '.', palpate::language().decimal_sign);
  }
};
