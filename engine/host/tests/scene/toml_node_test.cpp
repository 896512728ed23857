// The tree of a TOML text, and which texts are kept from the parser.
#include <gtest/gtest.h>

#include <string>

#include "palpate/base/error.h"
#include "palpate/scene/detail/toml_limits.h"
#include "palpate/scene/detail/toml_node.h"
#include "palpate/scene/detail/toml_table.h"
#include "palpate/scene/scene_file.h"
#include "support/error_message.h"

namespace palpate::scene {
namespace {

/// "a.a.a"
std::string keyOfParts(std::size_t parts) {
  std::string key = "a";
  for (std::size_t i = 1; i < parts; ++i) key += ".a";
  return key;
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

/// What the reader of scenes says of a text; empty if it takes it.
std::string parseError(const std::string& text) {
  try {
    parseToml(text, "file.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

constexpr const char* kTooManyParts = "file.toml:2: a key has more than 16 parts";
constexpr const char* kTooDeep = "file.toml:2: is nested more than 16 levels deep";

}  // namespace

TEST(TomlLimits, AKeyOfFiftyThousandPartsIsRefusedInEveryForm) {
  const std::string key = keyOfParts(50'000);
  EXPECT_EQ(parseError("# first line\n" + key + " = 1\n"), kTooManyParts);
  EXPECT_EQ(parseError("# first line\n[" + key + "]\n"), kTooManyParts);
  EXPECT_EQ(parseError("# first line\n[[" + key + "]]\n"), kTooManyParts);
  EXPECT_EQ(parseError("# first line\nb = { " + key + " = 1 }\n"), kTooManyParts);
}

TEST(TomlLimits, ASceneWithSuchAKeyIsAnErrorOfItsLine) {
  try {
    parse("title = \"deep\"\n[" + keyOfParts(50'000) + "]\n", "scene.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.file(), "scene.toml");
    EXPECT_EQ(error.line(), 2u);
  }
}

TEST(TomlLimits, PartsInQuotesAndWithBlanksCountToo) {
  EXPECT_EQ(parseError("\n" + repeated("\"b\" . ", 16) + "c = 1\n"), kTooManyParts);
  EXPECT_EQ(parseError("\n" + repeated("'b.' .\t", 16) + "c = 1\n"), kTooManyParts);
}

TEST(TomlLimits, AKeyOfAsManyPartsAsThereMayBeIsRead) {
  for (const std::string form : {"{} = 1\n", "[{}]\n", "[[{}]]\n", "b = { {} = 1 }\n"}) {
    std::string text = form;
    text.replace(text.find("{}"), 2, keyOfParts(kMaxTomlKeyParts));
    EXPECT_EQ(parseError(text), "") << text;
  }
}

TEST(TomlLimits, BracketsWithinBracketsAreCounted) {
  for (const auto& brackets : {std::pair<std::string, std::string>{"[", "]"}, {"{ a = ", " }"}}) {
    const std::string& open = brackets.first;
    const std::string& close = brackets.second;
    const auto text = [&](std::size_t levels) {
      return "\na = " + repeated(open, levels) + "1" + repeated(close, levels) + "\n";
    };
    EXPECT_EQ(parseError(text(kMaxTomlNesting)), "") << open;
    EXPECT_EQ(parseError(text(kMaxTomlNesting + 1)), kTooDeep) << open;
    EXPECT_EQ(parseError(text(100'000)), kTooDeep) << open;
  }
  EXPECT_EQ(parseError("\na = " + repeated("[", 100'000)), kTooDeep);
}

TEST(TomlLimits, TablesAreCounted) {
  const std::string refusal = "has more than 100000 tables";
  EXPECT_EQ(parseError(repeated("[[a]]\n", 99'999)), "");
  EXPECT_EQ(parseError(repeated("[[a]]\n", 100'001)), "file.toml:100001: " + refusal);
  EXPECT_EQ(parseError("a = [" + repeated("{},\n", 100'001) + "]\n"), "file.toml:100001: " + refusal);
  EXPECT_EQ(parseError("a = [\n" + repeated("{b.c.d=1},\n", 40'000) + "]\n"), "file.toml:33335: " + refusal);
}

TEST(TomlLimits, ATextOfMoreBytesIsRefused) {
  EXPECT_EQ(parseError("a = 1\n#" + std::string(kMaxTomlBytes, '-')), "file.toml: is larger than 16 MiB");
}

TEST(TomlLimits, WhatStandsInTextsAndCommentsIsNotCounted) {
  const std::string brackets = repeated("[{.", 1000);
  for (const std::string& text :
       {"a = \"" + brackets + "\"", "a = '" + brackets + "'", "# " + brackets, "a = 1 # " + brackets,
        "a = \"\"\"\n" + brackets + "\n" + brackets + "\"\"\"\nb = 1", "a = '''" + brackets + "\n'" + brackets + "''''",
        "a = \"\\\"" + brackets + "\"", "a = \"\\\\\" # " + brackets, "a = \"\"\"\\\"\"\" " + brackets + "\"\"\"\"\"",
        "\"" + brackets + "\" = 1", "a = \"\"\nb = ''\n# " + brackets}) {
    EXPECT_EQ(parseError(text), "") << text.substr(0, 20);
  }
}

/// A string that was thought to end later would hide what the parser sees.
TEST(TomlLimits, WhatFollowsAnyFormOfTextIsCounted) {
  const std::string deep = "\n" + keyOfParts(17) + " = 1\n";
  for (const std::string text : {R"("")", "''", R"("\\")", R"("'")", "'\"'", R"('\')", R"("""""")", "''''''",
                                 R"(""""a""""")", R"("""\"""")", "'''\\''''", "\"\"\"a\\\"\"\"\"", "'a' # \"\"\""}) {
    EXPECT_NE(parseError("b = " + text + deep).find("more than 16 parts"), std::string::npos) << text;
  }
}

TEST(TomlLimits, LinesAreCountedThroughEveryFormOfText) {
  const std::string deep = keyOfParts(17) + " = 1\n";
  for (const std::string text :
       {"\"\"\"\n\n\"\"\"", "'''\n\n'''", "\"\"\"\\\n\n\"\"\"", "1 # \"\"\"\n\n", "[\n1,\n2]"}) {
    EXPECT_EQ(parseError("a = " + text + "\n" + deep).substr(0, 12), "file.toml:4:") << text;
  }
}

TEST(TomlLimits, NumbersWithPointsAreNoKeys) {
  EXPECT_EQ(parseError("a = [" + repeated("1.5, ", 10'000) + "0.5]\nb = [" + repeated("\n  2.5,", 10'000) + "]\n"), "");
}

TEST(TomlTable, GivesTheKeysThatAreThereAndLeavesTheOthers) {
  const TomlNode root = parseToml("text = \"a\"\nnumber = 1.5\nwhole = 3\nflag = true\n", "file.toml");
  const TomlTable table(root, "file.toml", "a table", {"text", "number", "whole", "flag", "none"});
  const NumberRange small{0.0, 10.0};
  std::string text = "b", no_text = "b";
  double number = 0.5, no_number = 0.5;
  int whole = 1, no_whole = 1;
  bool flag = false, no_flag = true;
  table.read("text", text);
  table.read("number", number, small);
  table.read("whole", whole, small);
  table.read("flag", flag);
  EXPECT_TRUE(text == "a" && number == 1.5 && whole == 3 && flag);
  table.read("none", no_text);
  table.read("none", no_number, small);
  table.read("none", no_whole, small);
  table.read("none", no_flag);
  EXPECT_TRUE(no_text == "b" && no_number == 0.5 && no_whole == 1 && no_flag);
}

TEST(TomlTable, SaysOfWhichLineAKeyIsUnknownOrWhatItTakes) {
  const auto refusal = [](const std::string& line) {
    return support::thrownMessage([&] {
      const TomlNode root = parseToml("\n" + line + "\n", "file.toml");
      const TomlTable table(root, "file.toml", "a table", {"text", "number", "whole", "flag"});
      std::string text;
      double number = 0.0;
      int whole = 0;
      bool flag = false;
      table.read("text", text);
      table.read("number", number, {0.0, 10.0});
      table.read("whole", whole, {0.0, 10.0});
      table.read("flag", flag);
    });
  };
  EXPECT_EQ(refusal("flga = true"), "file.toml:2: unknown key 'flga' in a table; did you mean 'flag'?");
  EXPECT_EQ(refusal("text = 1"), "file.toml:2: text takes text");
  EXPECT_EQ(refusal("number = \"1\""), "file.toml:2: number must be a number");
  EXPECT_EQ(refusal("number = 11"), "file.toml:2: number = 11 is out of range: 0 to 10");
  EXPECT_EQ(refusal("whole = 1.5"), "file.toml:2: whole must be a whole number");
  EXPECT_EQ(refusal("flag = 1"), "file.toml:2: flag must be true or false");
}

TEST(TomlNode, HoldsEveryKindOfValueWithItsPlace) {
  const TomlNode root = parseToml(
      "text = \"words\"\nflag = true\nwhole = 3\nfraction = 0.5\ndate = 1979-05-27\nlist = [1, 2.5]\n[table]\nkey = 1\n"
      "[[tables]]\n[[tables]]\n",
      "file.toml");
  EXPECT_EQ(root.entries().size(), 8u);
  EXPECT_EQ(root.get("text")->text(), "words");
  EXPECT_EQ(root.get("flag")->flag(), true);
  EXPECT_EQ(root.get("whole")->whole(), 3);
  EXPECT_EQ(root.get("whole")->number(), 3.0);
  EXPECT_EQ(root.get("fraction")->number(), 0.5);
  EXPECT_EQ(root.get("fraction")->whole(), std::nullopt);
  EXPECT_EQ(root.get("date")->kind(), TomlNode::Kind::date);
  ASSERT_NE(root.get("list")->list(), nullptr);
  EXPECT_EQ(root.get("list")->list()->at(1).number(), 2.5);
  EXPECT_FALSE(root.get("list")->isListOfTables());
  EXPECT_EQ(root.get("table")->line(), 7u);
  EXPECT_EQ(root.get("table")->get("key")->begin().column, 7u);
  EXPECT_EQ(root.get("table")->entries().front().place.column, 1u);
  EXPECT_TRUE(root.get("tables")->isListOfTables());
  EXPECT_EQ(root.get("tables")->list()->at(1).line(), 10u);
  EXPECT_EQ(root.get("nothing"), nullptr);
  EXPECT_EQ(root.get("text")->number(), std::nullopt);
  EXPECT_EQ(root.get("whole")->text(), std::nullopt);
  EXPECT_EQ(root.get("whole")->list(), nullptr);
}

TEST(TomlNode, SaysItsEntriesInAlphabeticalOrder) {
  const TomlNode root = parseToml("c = 1\na = 1\nB = 1\n", "file.toml");
  ASSERT_EQ(root.entries().size(), 3u);
  EXPECT_EQ(root.entries()[0].key, "B");
  EXPECT_EQ(root.entries()[1].key, "a");
  EXPECT_EQ(root.entries()[2].key, "c");
}

TEST(TomlNode, WholeNumbersBeyondADoubleAreNoNumber) {
  const TomlNode root = parseToml("a = 9007199254740993\nb = 9007199254740992\nc = 1e300\nd = nan\n", "file.toml");
  EXPECT_EQ(root.get("a")->number(), std::nullopt);
  EXPECT_EQ(root.get("b")->number(), 9007199254740992.0);
  EXPECT_EQ(root.get("c")->whole(), std::nullopt);
  EXPECT_EQ(root.get("d")->whole(), std::nullopt);
}

TEST(TomlNode, SaysTheLineThatIsNotToml) {
  EXPECT_TRUE(parseError("a = 1\nb = \n").starts_with("file.toml:2: ")) << parseError("a = 1\nb = \n");
}

}  // namespace palpate::scene
