#include "figures/svg_text.h"

#include <array>
#include <cctype>
#include <map>
#include <string_view>

namespace palpate::figures {

namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string descriptionOf(const std::vector<DrawnText>& texts) {
  std::string description = "\n<desc>";
  for (const DrawnText& drawn : texts) description += escaped(drawn.text) + "\n";
  return description + "</desc>\n";
}

void describe(std::string& svg, const std::vector<DrawnText>& texts) {
  const std::size_t opening = svg.find("<svg");
  if (opening == std::string::npos) return;
  const std::size_t inside = svg.find('>', opening) + 1;
  svg.insert(inside, descriptionOf(texts));
}

// Names that cairo numbers by a counter of the whole process. References look the same as names and change alike.
constexpr std::array<std::string_view, 2> kCounted{"surface", "image"};

bool startsName(const std::string& svg, std::size_t at) { return at > 0 && (svg[at - 1] == '"' || svg[at - 1] == '#'); }

void countFromOne(std::string& svg, std::string_view name) {
  std::map<std::string, int> numbers;
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = svg.find(name); at != std::string::npos; at = svg.find(name, at + 1)) {
    const std::size_t first = at + name.size();
    std::size_t last = first;
    while (last < svg.size() && std::isdigit(static_cast<unsigned char>(svg[last])) != 0) ++last;
    if (last == first || !startsName(svg, at)) continue;
    const auto [entry, added] = numbers.emplace(svg.substr(first, last - first), static_cast<int>(numbers.size()) + 1);
    result.append(svg, done, first - done).append(std::to_string(entry->second));
    done = last;
  }
  svg = result.append(svg, done, std::string::npos);
}

}  // namespace

std::string tidiedSvg(std::string svg, const std::vector<DrawnText>& texts) {
  for (const std::string_view name : kCounted) countFromOne(svg, name);
  describe(svg, texts);
  return svg;
}

}  // namespace palpate::figures
