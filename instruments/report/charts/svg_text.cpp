// Adds to cairo's SVG what it lacks: words, and names that do not depend on earlier drawings. Uses pugixml.
#include <pugixml.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <string_view>

#include "palpate/base/error.h"
#include "report/charts/canvas.h"

namespace palpate::figures {

namespace {

void describe(pugi::xml_node svg, const std::vector<DrawnText>& texts) {
  std::string description;
  for (const DrawnText& drawn : texts) description += drawn.text + "\n";
  svg.prepend_child("desc").text().set(description.c_str());
}

/// cairo's own names, "surface123" and "image45", numbered again in the order in which they appear.
class Renumbering {
 public:
  /// `text` with every such name in it replaced: alone (an id), behind # (a reference), or in url(#...).
  std::string renamed(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
      const std::string_view word = wordAt(text, at);
      if (word.empty()) {
        result += text[at++];
        continue;
      }
      at += word.size();
      const std::string_view number = text.substr(at, text.find_first_not_of("0123456789", at) - at);
      at += number.size();
      result.append(word).append(number.empty() ? "" : std::to_string(numberFor(word, number)));
    }
    return result;
  }

 private:
  static constexpr std::array<std::string_view, 2> kCounted{"surface", "image"};

  /// The counted word that begins here as a name does.
  static std::string_view wordAt(std::string_view text, std::size_t at) {
    if (at > 0 && text[at - 1] != '#') return {};
    for (const std::string_view word : kCounted) {
      if (text.substr(at).starts_with(word)) return word;
    }
    return {};
  }

  int numberFor(std::string_view word, std::string_view number) {
    std::map<std::string, int, std::less<>>& numbers = numbers_[word == kCounted[0] ? 0 : 1];
    const int next = static_cast<int>(numbers.size()) + 1;
    return numbers.emplace(number, next).first->second;
  }

  std::array<std::map<std::string, int, std::less<>>, 2> numbers_;
};

/// Data of a picture may look like anything.
bool mayName(const pugi::xml_attribute& attribute) { return !std::string_view(attribute.value()).starts_with("data:"); }

void renumber(pugi::xml_node node, Renumbering& renumbering) {
  for (pugi::xml_attribute attribute : node.attributes()) {
    if (mayName(attribute)) attribute.set_value(renumbering.renamed(attribute.value()).c_str());
  }
  for (const pugi::xml_node child : node.children()) renumber(child, renumbering);
}

struct StringWriter : pugi::xml_writer {
  std::string text;
  void write(const void* bytes, std::size_t count) override { text.append(static_cast<const char*>(bytes), count); }
};

}  // namespace

std::string tidiedSvg(const std::string& svg, const std::vector<DrawnText>& texts) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(svg.data(), svg.size(), pugi::parse_full);
  if (!parsed) throw Error(std::string("drawing failed: ") + parsed.description());
  Renumbering renumbering;
  renumber(document.document_element(), renumbering);
  describe(document.document_element(), texts);
  StringWriter writer;
  document.save(writer, "", pugi::format_raw | pugi::format_no_declaration);
  return std::move(writer.text);
}

}  // namespace palpate::figures
