// Values of a scene file: read with their ranges, and shown as they would be there.
#include "palpate/scene/detail/key_table.h"

#include <algorithm>

namespace palpate::scene {

namespace {

std::string describeType(const TomlNode& node) {
  switch (node.kind()) {
    case TomlNode::Kind::text:
      return "a text";
    case TomlNode::Kind::flag:
      return "true or false";
    case TomlNode::Kind::list:
      return "a list";
    case TomlNode::Kind::table:
      return "a table";
    case TomlNode::Kind::whole:
    case TomlNode::Kind::fraction:
      return "a number";
    case TomlNode::Kind::date:
      break;
  }
  return "a date or time";
}

[[noreturn]] void failType(const Entry& entry, std::string_view expected) {
  entry.fail(fmt::format("must be {}, not {}", expected, describeType(entry.node)));
}

double finiteNumber(const Entry& entry, const TomlNode& node, const Range& range) {
  const auto value = node.number();
  if (!value) failType({node, entry.file, entry.name}, "a number");
  if (!std::isfinite(*value)) entry.fail("must be finite");
  if (!range.holds(*value)) entry.fail("= " + outOfRange(fmt::format("{}", *value), range));
  return *value;
}

/// Longer than any file name or title.
constexpr std::size_t kLongestText = 4096;

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string rangeSuffix(const Range& range) {
  const std::string words = range.words();
  return words.empty() ? words : ", " + words;
}

std::string formatChoices(const std::vector<std::string>& choices) {
  std::string words;
  for (const std::string& choice : choices) words += fmt::format("{}\"{}\"", words.empty() ? "" : " or ", choice);
  return words;
}

double readNumber(const Entry& entry, const Range& range) { return finiteNumber(entry, entry.node, range); }

std::size_t readCount(const Entry& entry, std::size_t low, std::size_t high) {
  if (entry.node.kind() != TomlNode::Kind::whole) failType(entry, "a whole number");
  const std::int64_t value = *entry.node.whole();
  if (value < 0 || static_cast<std::uint64_t>(value) < low || static_cast<std::uint64_t>(value) > high) {
    entry.fail("= " +
               outOfRange(fmt::format("{}", value), between(static_cast<double>(low), static_cast<double>(high))));
  }
  return static_cast<std::size_t>(value);
}

std::string readText(const Entry& entry) {
  const auto value = entry.node.text();
  if (!value) failType(entry, "a text in quotes");
  if (std::any_of(value->begin(), value->end(), isControl) || value->size() > kLongestText) {
    entry.fail("must be one line of plain text");
  }
  return *value;
}

bool readFlag(const Entry& entry) {
  if (entry.node.kind() != TomlNode::Kind::flag) failType(entry, "true or false");
  return *entry.node.flag();
}

std::vector<double> readNumbers(const Entry& entry, const Range& range) {
  const TomlList* list = entry.node.list();
  if (list == nullptr) failType(entry, "a list of numbers");
  std::vector<double> values;
  for (const TomlNode& node : *list) values.push_back(finiteNumber(entry, node, range));
  return values;
}

std::vector<double> readPoint(const Entry& entry, std::size_t count, const Range& range) {
  std::vector<double> values = readNumbers(entry, range);
  if (values.size() != count) entry.fail(fmt::format("must be {} numbers, not {}", count, values.size()));
  return values;
}

std::string readWord(const Entry& entry, const std::vector<std::string>& choices) {
  std::string word = readText(entry);
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  const std::string nearest = nearestName(word, choices);
  const std::string hint = nearest.empty() ? nearest : fmt::format("; did you mean \"{}\"?", nearest);
  entry.fail(fmt::format("must be {}, not \"{}\"{}", formatChoices(choices), oneLine(word), hint));
}

std::string inQuotes(std::string_view text) {
  std::string words = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      words += '\\';
      words += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      words += fmt::format("\\u{:04X}", byte);
    } else {
      words += c;
    }
  }
  return words + '"';
}

std::string showNumber(double value) { return fmt::format("{}", value); }

std::string showNumbers(const std::vector<double>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

}  // namespace palpate::scene
