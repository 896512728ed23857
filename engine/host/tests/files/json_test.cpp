// The own JSON value against the library behind it, whose type builds, reads and writes the same here independently.
#include "palpate/base/json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace palpate {
namespace {

using Library = nlohmann::ordered_json;

std::string libraryText(const Library& json, int indent = -1, bool ascii_alone = false) {
  return json.dump(indent, ' ', ascii_alone, Library::error_handler_t::replace);
}

/// The same value twice.
struct Pair {
  Json ours;
  Library theirs;
};

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  Pair value(int depth) {
    switch (below(depth > 0 ? 9 : 7)) {
      case 0:
        return {nullptr, nullptr};
      case 1:
        return both(below(2) == 1);
      case 2:
        return both(static_cast<std::int64_t>(random_()));
      case 3:
        return both(std::uint64_t{random_()});
      case 4:
        return both(std::bit_cast<double>(random_()));  // NaN and infinity among them
      case 5:
        return both(std::ldexp(static_cast<double>(below(2000)) - 1000.0, -static_cast<int>(below(12))));
      case 6:
        return both(text());
      case 7:
        return array(depth - 1);
      default:
        return object(depth - 1);
    }
  }
  std::size_t below(std::size_t most) { return random_() % most; }

  /// Any bytes, those that are not UTF-8 included.
  std::string text() {
    static const std::string pieces[] = {"a", "\"", "\\", "\n",   "\x01", "\x7f",
                                         "é", "€",  "😀",  "\xff", "\xc3", "\xe2\x82"};
    std::string made;
    for (std::size_t i = below(8); i > 0; --i) made += pieces[below(std::size(pieces))];
    return made;
  }

 private:
  template <class Value>
  static Pair both(const Value& value) {
    return {Json(value), Library(value)};
  }
  Pair array(int depth) {
    Pair made{Json::array(), Library::array()};
    for (std::size_t i = below(5); i > 0; --i) {
      const Pair one = value(depth);
      made.ours.push_back(one.ours);
      made.theirs.push_back(one.theirs);
    }
    return made;
  }
  Pair object(int depth) {
    Pair made{Json::object(), Library::object()};
    for (std::size_t i = below(5); i > 0; --i) {
      const std::string name = text();  // often one that is there already
      const Pair one = value(depth);
      made.ours[name] = one.ours;
      made.theirs[name] = one.theirs;
    }
    return made;
  }

  std::mt19937_64 random_;
};

/// Every value and every type, through the accessors.
void expectSame(const Json& ours, const Library& theirs) {
  EXPECT_EQ(ours.is_null(), theirs.is_null());
  EXPECT_EQ(ours.is_boolean(), theirs.is_boolean());
  EXPECT_EQ(ours.is_number(), theirs.is_number());
  EXPECT_EQ(ours.is_number_integer(), theirs.is_number_integer());
  EXPECT_EQ(ours.is_number_unsigned(), theirs.is_number_unsigned());
  EXPECT_EQ(ours.is_number_float(), theirs.is_number_float());
  EXPECT_EQ(ours.is_string(), theirs.is_string());
  EXPECT_EQ(ours.is_discarded(), theirs.is_discarded());
  ASSERT_EQ(ours.is_array(), theirs.is_array());
  ASSERT_EQ(ours.is_object(), theirs.is_object());
  ASSERT_EQ(ours.size(), theirs.size());
  EXPECT_EQ(ours.empty(), theirs.empty());
  EXPECT_STREQ(ours.type_name(), theirs.type_name());
  if (ours.is_boolean()) {
    EXPECT_EQ(ours.get<bool>(), theirs.get<bool>());
  }
  if (ours.is_number_unsigned()) {
    EXPECT_EQ(ours.get<std::uint64_t>(), theirs.get<std::uint64_t>());
  }
  if (ours.is_number_integer()) {
    EXPECT_EQ(ours.get<std::int64_t>(), theirs.get<std::int64_t>());
  }
  if (ours.is_number()) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(ours.get<double>()), std::bit_cast<std::uint64_t>(theirs.get<double>()));
  }
  if (ours.is_string()) {
    EXPECT_EQ(ours.get<std::string>(), theirs.get<std::string>());
  }
  for (std::size_t i = 0; ours.is_array() && i < ours.size(); ++i) expectSame(ours[i], theirs[i]);
  if (!ours.is_object()) return;
  auto member = theirs.begin();
  for (const auto& [name, value] : ours.items()) {
    EXPECT_EQ(name, member.key());
    expectSame(value, *member++);
    EXPECT_EQ(&ours.at(name), &value);
  }
}

/// What an action throws; empty where it throws nothing.
template <class Action>
std::string complaintOf(Action&& action) {
  try {
    action();
    return {};
  } catch (const JsonError& error) {
    return error.what();
  } catch (const Library::exception& error) {
    return error.what();
  }
}

TEST(Json, RandomValuesBecomeTheSameText) {
  Maker maker(1);
  for (int i = 0; i < 3000; ++i) {
    const auto [ours, theirs] = maker.value(4);
    expectSame(ours, theirs);
    EXPECT_EQ(jsonDump(ours), libraryText(theirs));
    EXPECT_EQ(jsonDump(ours, 2), libraryText(theirs, 2));
    EXPECT_EQ(jsonDump(ours, 1, true), libraryText(theirs, 1, true));
    const Json copy = ours;
    EXPECT_EQ(jsonDump(copy), libraryText(theirs));
    if (HasFailure()) return;
  }
}

TEST(Json, RandomTextIsReadTheSameOrRefusedWithTheSameWords) {
  Maker maker(2);
  std::size_t good = 0;
  std::size_t bad = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = libraryText(maker.value(4).theirs, i % 3 - 1);
    for (std::size_t cut = maker.below(3); cut > 0 && !text.empty(); --cut) {
      constexpr std::string_view kLetters = "{}[],:\"0.-eE+ntf\\u\n\x80";
      const std::size_t at = maker.below(text.size());
      if (maker.below(2) == 0) {
        text.erase(at, 1);
      } else {
        text.insert(at, 1, kLetters[maker.below(kLetters.size())]);
      }
    }
    const Library theirs = Library::parse(text, nullptr, false);
    const Json ours = Json::tryParse(text);
    expectSame(ours, theirs);
    EXPECT_EQ(complaintOf([&] { return Json::parse(text); }), complaintOf([&] { return Library::parse(text); }))
        << text;
    if (!theirs.is_discarded()) expectSame(Json::parse(text), theirs);
    ++(theirs.is_discarded() ? bad : good);
    if (HasFailure()) return;
  }
  EXPECT_GT(good, 1000U);
  EXPECT_GT(bad, 1000U);
}

TEST(Json, ChosenTextIsReadTheSame) {
  for (const std::string text : {"",
                                 " ",
                                 "null",
                                 "nul",
                                 "\xef\xbb\xbf[1]",
                                 "[1,]",
                                 "{\"a\":1,}",
                                 "{\"a\":1,\"b\":2,\"a\":{\"c\":3}}",
                                 "1e400",
                                 "-1e400",
                                 "1e-400",
                                 "-0",
                                 "-0.0",
                                 "0.1",
                                 "18446744073709551615",
                                 "18446744073709551616",
                                 "-9223372036854775808",
                                 "-9223372036854775809",
                                 "01",
                                 "1.",
                                 ".5",
                                 "+1",
                                 "NaN",
                                 "\"\\ud83d\\ude00\"",
                                 "\"\\ud83d\"",
                                 "\"\xff\"",
                                 "\"\t\"",
                                 "[1] 2",
                                 "// no\n1",
                                 "{1:2}",
                                 "[[[[]]]]",
                                 "{\"\":\"\"}",
                                 "truefalse",
                                 "\"a"}) {
    expectSame(Json::tryParse(text), Library::parse(text, nullptr, false));
    EXPECT_EQ(complaintOf([&] { return Json::parse(text); }), complaintOf([&] { return Library::parse(text); }))
        << text;
  }
}

TEST(Json, TextMayBeNestedDeeperThanTheStack) {
  constexpr std::size_t kDeep = 300000;
  Json deep = Json::parse(std::string(kDeep, '[') + std::string(kDeep, ']'));
  std::size_t depth = 0;
  for (const Json* at = &deep; !at->empty(); at = &at->front()) ++depth;
  EXPECT_EQ(depth, kDeep - 1);
  EXPECT_TRUE(Json::tryParse(std::string(kDeep, '[')).is_discarded());
  std::string objects;
  for (std::size_t i = 0; i < kDeep; ++i) objects += "{\"a\":";
  deep = Json::parse(objects + "1" + std::string(kDeep, '}'));
  EXPECT_EQ(deep.size(), 1U);
}

/// The same braces, once for each type.
template <class Value>
std::vector<Value> bracedValues() {
  const std::string name = "n";
  const std::vector<double> numbers = {1.0, 0.5};
  const std::vector<std::string> names = {"x", "y"};
  const std::array<double, 3> three = {1.0, 2.0, 3.0};
  Value list = Value::array();
  list.push_back({{"a", 1}, {"b", nullptr}});
  list.push_back({1, 2.5, "three"});
  list.push_back({"a", 1});
  list.push_back({{"a", 1}});
  list.push_back({name});
  list.push_back(name);
  Value object = Value::object();
  object.push_back({"pair", 1});
  object.push_back({"pair", 2});
  object.update({{"pair", 3}, {"more", numbers}});
  object["new"]["inner"] = {1, 2, 3};
  object["empty"] = Value::array();
  Value null;
  null["list"].push_back(1);
  null["list"].push_back("two");
  return {list,
          object,
          null,
          {1, 2, 3},
          {{1, 2}, {3, 4}},
          {{"a", 1}, {"a", 2}},
          {{"a", 1}, {"b", {{"c", {1, 2}}, {"d", {"x", 1, true}}}}},
          {{"a", 1}, {2, 3}},
          {{"a", {{"en", "word"}}}, {"list", {name}}, {"names", names}, {"numbers", numbers}, {"three", three}},
          Value::array({1}),
          Value::array({{"a", 1}}),
          Value::object({{"a", 1}, {"b", "c"}}),
          Value(std::string_view("view")),
          Value(std::size_t{7}),
          Value(-7L),
          Value(0.1F),
          Value(static_cast<std::uint8_t>(200)),
          Value(true),
          Value(std::numeric_limits<double>::quiet_NaN()),
          Value(std::numeric_limits<double>::infinity())};
}

TEST(Json, BracesMeanTheSame) {
  const auto ours = bracedValues<Json>();
  const auto theirs = bracedValues<Library>();
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(jsonDump(ours[i]), libraryText(theirs[i])) << i;
}

/// What is wrong with uses of a value, in words.
template <class Value>
std::vector<std::string> complaints() {
  const Value object = {{"a", 1}, {"b", "text"}};
  const Value list = {1, 2};
  const Value number = 5;
  const Value null;
  Value changed = 5;
  return {complaintOf([&] { (void)object.at("c"); }),
          complaintOf([&] { (void)object.at(0); }),
          complaintOf([&] { (void)list.at("a"); }),
          complaintOf([&] { (void)list.at(2); }),
          complaintOf([&] { (void)number.at("a"); }),
          complaintOf([&] { (void)null.at("a"); }),
          complaintOf([&] { (void)object.at("b").template get<double>(); }),
          complaintOf([&] { (void)object.at("a").template get<std::string>(); }),
          complaintOf([&] { (void)object.at("a").template get<bool>(); }),
          complaintOf([&] { (void)object.template get<std::vector<double>>(); }),
          complaintOf([&] { (void)object.template get<std::string>(); }),
          complaintOf([&] { (void)list.template get<double>(); }),
          complaintOf([&] { (void)list.value("a", 1.0); }),
          complaintOf([&] { (void)object.value("b", 1.0); }),
          complaintOf([&] { (void)object.value("a", "text"); }),
          complaintOf([&] { changed["a"] = 1; }),
          complaintOf([&] { changed.push_back(1); }),
          complaintOf([&] {
            changed.update({{"a", 1}});
          }),
          complaintOf([&] { return Value::object({1}); })};
}

TEST(Json, ErrorsSayTheSame) {
  const auto ours = complaints<Json>();
  EXPECT_EQ(ours, complaints<Library>());
  for (const std::string& complaint : ours) EXPECT_FALSE(complaint.empty());
}

TEST(Json, AnElementIsItsOwnListAndNullNone) {
  int seen = 0;
  for (const Json& value : Json(5)) seen += value.get<int>();
  for (const Json& value : Json()) seen += value.get<int>();
  const Json object = {{"a", 10}, {"b", 100}};
  for (const Json& value : object) seen += value.get<int>();
  EXPECT_EQ(seen, 115);
  EXPECT_EQ(object.find("c"), object.end());
  EXPECT_EQ(object.find("b")->get<int>(), 100);
}

TEST(Json, APartMayReplaceItsWhole) {
  Json json = {{"a", {{"b", {1, 2, 3}}}}};
  json = Json(json["a"]["b"]);
  EXPECT_EQ(jsonDump(json), "[1,2,3]");
  json = {{"a", {{"b", {1, 2, 3}}}}};
  json = std::move(json["a"]);
  EXPECT_EQ(jsonDump(json), R"({"b":[1,2,3]})");
  json["b"].push_back(json);
  EXPECT_EQ(jsonDump(json), R"({"b":[1,2,3,{"b":[1,2,3]}]})");
}

}  // namespace
}  // namespace palpate
