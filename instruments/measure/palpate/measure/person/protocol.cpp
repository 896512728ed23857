// TOML -> keys by hand, each named where it is unknown or wrong.
#include "palpate/measure/person/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"
#include "palpate/measure/average.h"
#include "palpate/scene/detail/toml_table.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kMaxProtocolBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestCode = 16;
constexpr std::array<std::string_view, 4> kHeadWords = {"top", "left", "bottom", "right"};

bool isPlain(std::string_view text) {
  return !text.empty() && text.size() <= kLongestCode && std::ranges::all_of(text, [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
  });
}

using ProtocolTable = scene::TomlTable;

HeadTowards readHeadDirection(const ProtocolTable& table) {
  std::string word = "top";
  table.read("head", word);
  const auto found = std::ranges::find(kHeadWords, word);
  if (found == kHeadWords.end()) table.fail("head = \"" + oneLine(word) + "\": top, left, bottom or right");
  return static_cast<HeadTowards>(found - kHeadWords.begin());
}

std::vector<ProtocolDrag> readDrags(const ProtocolTable& table) {
  std::vector<ProtocolDrag> drags;
  const scene::TomlNode* node = table.node("drags");
  const scene::TomlList* list = node == nullptr ? nullptr : node->list();
  if (list == nullptr || list->empty()) table.fail("drags must be a list such as [\"up\", \"right\"]");
  for (const scene::TomlNode& one : *list) {
    const std::string word = one.text().value_or("");
    const auto degrees = dragNamed(word);
    if (!degrees || !isPlain(word)) table.fail(one, "'" + oneLine(word) + "' must be up, down, left or right");
    drags.push_back({word, *degrees});
  }
  return drags;
}

/// Every table of an array of tables.
template <class Read>
void eachTable(const scene::TomlNode& root, const char* name, std::string_view file, const Read& read) {
  const scene::TomlNode* node = root.get(name);
  if (node == nullptr) return;
  if (!node->isListOfTables()) {
    throw Error::atLine(file, node->line(), fmt::format("{0} must be a list of tables, written as [[{0}]]", name));
  }
  for (const scene::TomlNode& one : *node->list()) read(one);
}

ProtocolPoint readPoint(const scene::TomlNode& table, std::string_view file) {
  const ProtocolTable keys(table, file, "[[point]]", {"name", "at", "x_mm", "y_mm"});
  ProtocolPoint point;
  keys.read("name", point.name);
  keys.read("at", point.at);
  if (!isPlain(point.name)) keys.fail("a point's name is of letters and digits: '" + oneLine(point.name) + "'");
  if (keys.node("x_mm") == nullptr || keys.node("y_mm") == nullptr) keys.fail("a point needs x_mm and y_mm");
  constexpr NumberRange kPlaces{-1e4, 1e4};
  keys.read("x_mm", point.place_mm.x(), kPlaces);
  keys.read("y_mm", point.place_mm.y(), kPlaces);
  return point;
}

ListedPictures readListedPictures(const scene::TomlNode& table, std::string_view file) {
  const ProtocolTable keys(table, file, "[[pictures]]",
                           {"press", "before", "before2", "after", "released", "contact_px"});
  ListedPictures listed;
  keys.read("press", listed.press);
  keys.read("before", listed.before);
  keys.read("before2", listed.before2);
  keys.read("after", listed.after);
  keys.read("released", listed.released);
  if (const scene::TomlNode* node = keys.node("contact_px")) {
    const scene::TomlList* list = node->list();
    if (list == nullptr || list->size() != 2 || !(*list)[0].isNumber() || !(*list)[1].isNumber()) {
      keys.fail(*node, "contact_px must be two numbers, [x, y]");
    }
    listed.contact_px = Vec2((*list)[0].number().value_or(0.0), (*list)[1].number().value_or(0.0));
  }
  return listed;
}

void checkTogether(const Protocol& protocol, std::string_view file) {
  if (protocol.points.empty()) throw Error::inFile(file, "has no [[point]]");
  if (protocol.enough > protocol.presses) throw Error::inFile(file, "enough must not exceed presses");
  std::set<std::string> names;
  for (const ProtocolPoint& point : protocol.points) {
    if (!names.insert(point.name).second) throw Error::inFile(file, "the point " + point.name + " appears twice");
  }
  for (const ProtocolDrag& drag : protocol.drags) {
    if (!names.insert(drag.word).second) throw Error::inFile(file, drag.word + " appears twice");
  }
  std::vector<std::string> presses;
  for (const PlannedPress& press : plannedPresses(protocol)) presses.push_back(press.name);
  for (const ListedPictures& listed : protocol.pictures) {
    if (std::ranges::find(presses, listed.press) != presses.end()) continue;
    throw Error::inFile(file, unknownName("press", listed.press, "[[pictures]]", presses));
  }
}

}  // namespace

std::string faultOfPerson(std::string_view code) {
  if (!isPlain(code)) return fmt::format("a person is a code of 1 to {} letters and digits", kLongestCode);
  const bool has_digit = std::ranges::any_of(code, [](char letter) { return letter >= '0' && letter <= '9'; });
  return has_digit ? "" : "a person is a code with a digit in it, such as P07, and no name";
}

Protocol readProtocol(const std::filesystem::path& file) {
  return parseProtocol(readFile(file, kMaxProtocolBytes), file.string());
}

Protocol parseProtocol(std::string_view text, std::string_view file) {
  const scene::TomlNode root = scene::parseToml(text, file);
  const ProtocolTable keys(root, file, "",
                           {"person", "spacing_mm", "drift_mm", "head", "partial", "presses", "enough", "drags",
                            "stature_mm", "body_mass_index", "point", "pictures"});
  Protocol protocol;
  keys.read("person", protocol.person);
  if (const std::string fault = faultOfPerson(protocol.person); !fault.empty()) keys.fail("person: " + fault);
  keys.read("spacing_mm", protocol.spacing_mm, {5.0, 100.0});
  keys.read("drift_mm", protocol.drift_mm, {0.01, 20.0});
  keys.read("partial", protocol.partial);
  keys.read("presses", protocol.presses, {1.0, 99.0});
  keys.read("enough", protocol.enough, {1.0, 99.0});
  keys.read("stature_mm", protocol.stature_mm, {500.0, 2500.0});
  keys.read("body_mass_index", protocol.body_mass_index, {16.0, 45.0});
  protocol.head = readHeadDirection(keys);
  protocol.drags = readDrags(keys);
  eachTable(root, "point", file,
            [&](const scene::TomlNode& table) { protocol.points.push_back(readPoint(table, file)); });
  eachTable(root, "pictures", file,
            [&](const scene::TomlNode& table) { protocol.pictures.push_back(readListedPictures(table, file)); });
  checkTogether(protocol, file);
  return protocol;
}

std::string protocolText(const Protocol& protocol) {
  std::string drags;
  for (const ProtocolDrag& drag : protocol.drags)
    drags += fmt::format("{}\"{}\"", drags.empty() ? "" : ", ", drag.word);
  std::string text = fmt::format(
      "# What is measured of one person (docs/howto/measure-a-person.md). Change it before the first picture is "
      "taken.\n"
      "person = \"{}\"           # a code, never a name\n"
      "spacing_mm = {:g}         # of the stencil; nothing in the pictures says it\n"
      "head = \"{}\"             # edge of the pictures towards the head: top, left, bottom, right\n"
      "drift_mm = {:g}          # how far the body may move in a held breath\n"
      "drags = [{}]  # two or more, across each other: one alone tells nothing of the tissue\n"
      "presses = {}             # of each drag at each point\n"
      "enough = {}              # of them that must count\n"
      "# stature_mm = 1750      # of the body in the scene\n"
      "# body_mass_index = 22.5\n",
      protocol.person, protocol.spacing_mm, kHeadWords.at(static_cast<std::size_t>(protocol.head)), protocol.drift_mm,
      drags, protocol.presses, protocol.enough);
  for (const ProtocolPoint& point : protocol.points) {
    text += fmt::format("\n[[point]]\nname = \"{}\"\nat = \"{}\"\nx_mm = {:.6g}\ny_mm = {:.6g}\n", point.name, point.at,
                        point.place_mm.x(), point.place_mm.y());
  }
  return text +
         "\n# Pictures with other names, or with a marked contact:\n"
         "# [[pictures]]\n"
         "# press = \"P1_up_1\"\n"
         "# before = \"IMG_0012.JPG\"\n"
         "# after = \"IMG_0014.JPG\"\n"
         "# contact_px = [2013, 1502]   # in the picture before\n";
}

std::vector<PlannedPress> plannedPresses(const Protocol& protocol) {
  std::vector<PlannedPress> planned;
  for (const ProtocolPoint& point : protocol.points) {
    for (const ProtocolDrag& drag : protocol.drags) {
      for (int press = 1; press <= protocol.presses; ++press) {
        planned.push_back(
            {fmt::format("{}_{}_{}", point.name, drag.word, press), point.name, point.place_mm, drag.degrees});
      }
    }
  }
  return planned;
}

}  // namespace palpate::measure
