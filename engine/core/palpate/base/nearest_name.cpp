// Distances between names, all of them: a table of names is short.
//
// Based on: Levenshtein, "Binary codes capable of correcting deletions, insertions, and reversals", 1966.
#include "palpate/base/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "palpate/base/text.h"

namespace palpate {

namespace {

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

/// The first word of a name: "radius" of "radius_mm" and of "radius-mm".
std::string_view stem(std::string_view name) { return name.substr(0, name.find_first_of("_-")); }

bool isControlByte(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string oneLine(std::string_view text, std::size_t most) {
  std::string line(text.substr(0, most));
  std::replace_if(line.begin(), line.end(), isControlByte, '?');
  return line;
}

std::string nearestName(std::string_view written, const std::vector<std::string>& names) {
  std::string nearest;
  if (written.size() > kLongestName) return nearest;
  // At least one letter of a short word must be right.
  std::size_t least = std::min(std::max<std::size_t>(2, written.size() / 3) + 1, written.size());
  for (const std::string& name : names) {
    // "radius_cm" and "radius" mean "radius_mm", however many letters differ.
    const std::size_t distance = stem(name) == stem(written) ? std::min<std::size_t>(1, editDistance(name, written))
                                                             : editDistance(name, written);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::vector<std::string> nearestNames(std::string_view written, const std::vector<std::string>& names,
                                      std::size_t most) {
  struct Near {
    std::size_t distance;
    std::string name;
  };
  const std::string wanted = inSmallLetters(written.substr(0, kLongestName));
  std::vector<Near> all;
  for (const std::string& name : names) all.push_back({editDistance(inSmallLetters(name), wanted), name});
  std::stable_sort(all.begin(), all.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  std::vector<std::string> nearest;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) nearest.push_back(std::move(all[i].name));
  return nearest;
}

std::string nameHint(std::string_view written, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(written, names);
  return nearest.empty() ? fmt::format("known: {}", fmt::join(names, ", "))
                         : fmt::format("did you mean '{}'?", nearest);
}

std::string unknownName(std::string_view kind, std::string_view written, std::string_view where,
                        const std::vector<std::string>& names) {
  const std::string place = where.empty() ? std::string() : fmt::format(" in {}", where);
  return fmt::format("unknown {} '{}'{}; {}", kind, oneLine(written), place, nameHint(written, names));
}

}  // namespace palpate
