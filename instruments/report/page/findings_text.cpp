#include "report/page/findings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "palpate/base/error.h"

namespace palpate::study {

namespace {

using Parts = std::vector<FindingsPart>;

/// Adds the names of the values and paragraphs that these parts use, choices included.
void addNames(const Parts& parts, std::set<std::string>& values, std::set<std::string>& paragraphs) {
  for (const FindingsPart& part : parts) {
    if (!part.name.empty()) values.insert(part.name);
    if (!part.paragraph.empty()) paragraphs.insert(part.paragraph);
    for (const Parts& text : part.texts) addNames(text, values, paragraphs);
  }
}

std::string numberText(const FindingsPart& part, const FindingValues& value) {
  const auto number = value.get<double>();
  if (part.format == "counted") return counted(number);
  if (part.format == "rounded") return part.digits > 0 ? rounded(number, part.digits) : rounded(number);
  if (part.format == "percent") return percent(number);
  if (part.format == "fixed") return fmt::format("{:.{}f}", number, part.digits);
  if (part.format == "short")
    return part.digits > 0 ? fmt::format("{:.{}g}", number, part.digits) : fmt::format("{:g}", number);
  return value.is_number_float() ? fmt::format("{}", number) : fmt::format("{}", value.get<std::int64_t>());
}

/// That chooses a text.
std::string choiceWord(const FindingValues& value) {
  if (value.is_string()) return value.get<std::string>();
  const bool yes = value.is_boolean()  ? value.get<bool>()
                   : value.is_number() ? value.get<double>() != 0.0
                                       : !value.empty();
  return yes ? "yes" : "no";
}

class FindingsFiller {
 public:
  explicit FindingsFiller(const FindingsFile& file) : file_(file), paragraphs_(readFindings(file)) {}

  std::vector<std::string> all(const FindingValues& values) const {
    std::set<std::string> ignored;
    std::set<std::string> named;  // by `as`, so not findings of their own
    for (const FindingsParagraph& paragraph : paragraphs_) addNames(paragraph.parts, ignored, named);
    for (const auto& [name, value] : values.items()) {
      if (named.count(name) > 0 || find(name) == nullptr) fail(1, fmt::format("has no finding [{}]", name));
    }
    std::vector<std::string> findings;
    for (const FindingsParagraph& paragraph : paragraphs_) {
      if (named.count(paragraph.name) > 0) continue;
      const auto given = values.find(paragraph.name);
      const FindingValues value = given != values.end() ? *given : FindingValues::object();
      for (const FindingValues& one : value.is_object() ? FindingValues::array({value}) : value)
        findings.push_back(filled(paragraph, one));
    }
    return findings;
  }

 private:
  FindingsFile file_;
  std::vector<FindingsParagraph> paragraphs_;

  [[noreturn]] void fail(std::size_t line, const std::string& cause) const {
    throw Error::atLine(file_.path, line, cause);
  }

  const FindingsParagraph* find(std::string_view name) const {
    const auto found = std::find_if(paragraphs_.begin(), paragraphs_.end(),
                                    [&](const FindingsParagraph& one) { return one.name == name; });
    return found == paragraphs_.end() ? nullptr : &*found;
  }

  std::string filled(const FindingsParagraph& paragraph, const FindingValues& values) const {
    std::set<std::string> names;
    std::set<std::string> ignored;
    addNames(paragraph.parts, names, ignored);
    for (const auto& [name, value] : values.items()) {
      if (names.erase(name) == 0) fail(paragraph.line, fmt::format("[{}] does not use `{}`", paragraph.name, name));
    }
    if (!names.empty()) fail(paragraph.line, fmt::format("[{}] has no value `{}`", paragraph.name, *names.begin()));
    return filled(paragraph.parts, values);
  }

  std::string filled(const Parts& parts, const FindingValues& values) const {
    std::string text;
    for (const FindingsPart& part : parts) {
      if (part.name.empty()) {
        text += part.text;
      } else if (!part.words.empty()) {
        text += filled(chosen(part, values.at(part.name)), values);
      } else {
        text += printed(part, values.at(part.name));
      }
    }
    return text;
  }

  const Parts& chosen(const FindingsPart& part, const FindingValues& value) const {
    const std::string word = choiceWord(value);
    const auto found = std::find(part.words.begin(), part.words.end(), word);
    if (found == part.words.end()) fail(part.line, fmt::format("`{}` has no choice `{}`", part.name, word));
    return part.texts[static_cast<std::size_t>(found - part.words.begin())];
  }

  std::string printed(const FindingsPart& part, const FindingValues& value) const {
    if (value.is_array()) {
      std::string list;
      for (const FindingValues& one : value) list += (&one == &value.front() ? "" : part.between) + printed(part, one);
      return list;
    }
    if (!part.paragraph.empty()) {
      const FindingsParagraph* paragraph = find(part.paragraph);
      if (paragraph == nullptr) fail(part.line, fmt::format("has no paragraph [{}]", part.paragraph));
      return filled(*paragraph, value);
    }
    if (value.is_string() && part.format.empty()) return value.get<std::string>();
    if (!value.is_number())
      fail(part.line,
           fmt::format("`{}` must be {}", part.name, part.format.empty() ? "a number or a text" : "a number"));
    return numberText(part, value);
  }
};

}  // namespace

std::vector<std::string> formatFindings(const FindingsFile& file, const FindingValues& values) {
  return FindingsFiller(file).all(values);
}

}  // namespace palpate::study
