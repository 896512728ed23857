// Values of a scene file: read with their ranges, shown as they would stand there, and for a misspelled name the
// nearest one that exists.
//
// Based on: Levenshtein, "Binary codes capable of correcting deletions, insertions, and reversals", 1966.
#include "palpate/scene/key_table.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace palpate::scene {

namespace {

std::string typeWords(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a text";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    default:
      return "a date or time";
  }
}

[[noreturn]] void failType(const Entry& entry, std::string_view expected) {
  entry.fail(fmt::format("must be {}, not {}", expected, typeWords(entry.node)));
}

double finiteNumber(const Entry& entry, const toml::node& node, const Range& range) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) failType({node, entry.file, entry.name}, "a number");
  if (!std::isfinite(*value)) entry.fail("must be finite");
  if (!range.holds(*value)) entry.fail(fmt::format("= {} must be {}", *value, range.words()));
  return *value;
}

/// Letters that must be inserted, removed or replaced to turn a into b (Levenshtein 1966).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// The first word of a name: "radius" of "radius_mm".
std::string_view stem(std::string_view name) { return name.substr(0, name.find('_')); }

/// Longer than any file name or title.
constexpr std::size_t kLongestText = 4096;

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string oneLine(std::string_view text, std::size_t most) {
  std::string line(text.substr(0, most));
  std::replace_if(line.begin(), line.end(), isControl, '?');
  return line;
}

std::string Range::words() const {
  std::string words;
  if (std::isfinite(low)) words = fmt::format("{} {}", above_low ? "above" : "at least", low);
  if (std::isfinite(high)) words += fmt::format("{}at most {}", words.empty() ? "" : " and ", high);
  return words;
}

std::string rangeSuffix(const Range& range) {
  const std::string words = range.words();
  return words.empty() ? words : ", " + words;
}

std::string choiceWords(const std::vector<std::string>& choices) {
  std::string words;
  for (const std::string& choice : choices) words += fmt::format("{}\"{}\"", words.empty() ? "" : " or ", choice);
  return words;
}

double readNumber(const Entry& entry, const Range& range) { return finiteNumber(entry, entry.node, range); }

std::size_t readCount(const Entry& entry, std::size_t low, std::size_t high) {
  if (!entry.node.is_integer()) failType(entry, "a whole number");
  const auto value = *entry.node.value<std::int64_t>();
  if (value < 0 || static_cast<std::uint64_t>(value) < low || static_cast<std::uint64_t>(value) > high) {
    entry.fail(fmt::format("= {} must be {} to {}", value, low, high));
  }
  return static_cast<std::size_t>(value);
}

std::string readText(const Entry& entry) {
  const auto value = entry.node.value<std::string>();
  if (!entry.node.is_string()) failType(entry, "a text in quotes");
  if (std::any_of(value->begin(), value->end(), isControl) || value->size() > kLongestText) {
    entry.fail("must be one line of plain text");
  }
  return *value;
}

bool readFlag(const Entry& entry) {
  if (!entry.node.is_boolean()) failType(entry, "true or false");
  return *entry.node.value<bool>();
}

std::vector<double> readNumbers(const Entry& entry, const Range& range) {
  const toml::array* list = entry.node.as_array();
  if (list == nullptr) failType(entry, "a list of numbers");
  std::vector<double> values;
  for (const toml::node& node : *list) values.push_back(finiteNumber(entry, node, range));
  return values;
}

std::vector<double> readPoint(const Entry& entry, std::size_t count) {
  std::vector<double> values = readNumbers(entry, {});
  if (values.size() != count) entry.fail(fmt::format("must be {} numbers, not {}", count, values.size()));
  return values;
}

std::string readWord(const Entry& entry, const std::vector<std::string>& choices) {
  std::string word = readText(entry);
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  entry.fail(fmt::format("must be {}, not \"{}\"", choiceWords(choices), oneLine(word)));
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

std::string nearestName(std::string_view written, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, written.size() / 3) + 1;
  if (written.size() > kLongestName) return nearest;
  for (const std::string& name : names) {
    // "radius_cm" and "radius" mean "radius_mm", however many letters that takes.
    const std::size_t distance = stem(name) == stem(written) ? std::min<std::size_t>(1, editDistance(name, written))
                                                             : editDistance(name, written);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string unknownName(std::string_view kind, std::string_view written, std::string_view table,
                        const std::vector<std::string>& names) {
  const std::string where = table.empty() ? std::string() : fmt::format(" in {}", table);
  const std::string nearest = nearestName(written, names);
  const std::string hint =
      nearest.empty() ? fmt::format("known: {}", fmt::join(names, ", ")) : fmt::format("did you mean '{}'?", nearest);
  return fmt::format("unknown {} '{}'{}; {}", kind, oneLine(written), where, hint);
}

}  // namespace palpate::scene
