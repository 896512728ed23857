// Texts of findings print what they are given, choose by what was decided, and refuse what does not fit.
#include <gtest/gtest.h>

#include "report/page/findings_text.h"
#include "support/error_message.h"

namespace palpate::study {

namespace {

std::vector<std::string> filled(std::string_view text, const FindingValues& values) {
  return formatFindings({"some_findings.txt", text}, values);
}

/// Of a text of one finding.
std::string said(const std::string& text, const FindingValues& values) {
  return filled("[one]\n" + text, {{"one", values}}).at(0);
}

std::string refusal(std::string_view text, const FindingValues& values) {
  return support::thrownMessage([&] { filled(text, values); });
}

}  // namespace

TEST(FindingsText, PrintsValuesAsItIsTold) {
  const FindingValues values = {{"x", 41582.25}};
  EXPECT_EQ(said("{x}", values), "41582.25");
  EXPECT_EQ(said("{x|counted}", values), "41,582");
  EXPECT_EQ(said("{x|rounded}", values), "42,000");
  EXPECT_EQ(said("{x|rounded 3}", values), "41,600");
  EXPECT_EQ(said("{x|fixed} {x|fixed 1}", values), "41582 41582.2");
  EXPECT_EQ(said("{x|short} {x|short 1}", values), "41582.2 4e+04");
  EXPECT_EQ(said("{x|percent} of {name}, {n}", {{"x", 0.123}, {"name", "a body"}, {"n", 7}}), "12 % of a body, 7");
}

TEST(FindingsText, JoinsLists) {
  const FindingValues values = {{"range", Extent{0.1, 2.0}}, {"names", {"skin", "bone", "air"}}};
  EXPECT_EQ(said("{range|rounded \" to \"} mm of {names}", values), "0.10 to 2.0 mm of skin, bone, air");
}

TEST(FindingsText, FillsAParagraphFromEachOfAList) {
  const std::string_view text = "[cost]\nIt costs {rows|as row \"; \"}, at best {best|as row}.\n[row]\n{us|rounded} us";
  const FindingValues values = {{"rows", {{{"us", 1.0}}, {{"us", 20.0}}}}, {"best", {{"us", 0.5}}}};
  EXPECT_EQ(filled(text, {{"cost", values}}), std::vector<std::string>{"It costs 1.0 us; 20 us, at best 0.50 us."});
}

TEST(FindingsText, ChoosesByWhatWasDecided) {
  const std::string text = "{x ? \"{n} are \\\"bad\\\"{some ? \" {some}\"}\" : \"none\"}.";
  EXPECT_EQ(said(text, {{"x", true}, {"n", 3}, {"some", {"a", "b"}}}), "3 are \"bad\" a, b.");
  EXPECT_EQ(said(text, {{"x", 2}, {"n", 3}, {"some", FindingValues::array()}}), "3 are \"bad\".");
  EXPECT_EQ(said(text, {{"x", 0.0}, {"n", 3}, {"some", false}}), "none.");
  const std::string words = "It {pays ? never \"never pays\"\n  always \"pays\"}.";
  EXPECT_EQ(said(words, {{"pays", "always"}}), "It pays.");
  EXPECT_EQ(said(words, {{"pays", "never"}}), "It never pays.");
}

TEST(FindingsText, KeepsTheOrderOfTheFileAndTakesALineBreakForASpace) {
  const std::string_view text = "# What this is.\n\n[first]\nOne\nof {n}.\n\n[other]\nTwo.\n\n[last]\nThree {x}.\n";
  const FindingValues twice = {{{"n", 1}}, {{"n", 2}}};
  EXPECT_EQ(filled(text, {{"last", {{"x", 1}}}, {"first", twice}}),
            (std::vector<std::string>{"One of 1.", "One of 2.", "Two.", "Three 1."}));
  EXPECT_EQ(filled(text, {{"last", nullptr}, {"first", nullptr}}), std::vector<std::string>{"Two."});
}

TEST(FindingsText, RefusesNamesAndWordsThatDoNotFit) {
  const std::string_view text = "[one]\nA {x}\nof {y ? a \"A\" b \"B\"} {z|rounded}.";
  const auto refused = [&](const FindingValues& values) { return refusal(text, {{"one", values}}); };
  EXPECT_EQ(refused({{"x", 1}, {"y", "b"}, {"z", 1}}), "no error");
  EXPECT_EQ(refused({{"x", 1}, {"z", 1}}), "some_findings.txt:1: [one] has no value `y`");
  EXPECT_EQ(refused({{"x", 1}, {"y", "a"}, {"z", 1}, {"w", 1}}), "some_findings.txt:1: [one] does not use `w`");
  EXPECT_EQ(refused({{"x", 1}, {"y", "c"}, {"z", 1}}), "some_findings.txt:3: `y` has no choice `c`");
  EXPECT_EQ(refused({{"x", 1}, {"y", "a"}, {"z", "1"}}), "some_findings.txt:3: `z` must be a number");
  EXPECT_EQ(refused({{"x", true}, {"y", "a"}, {"z", 1}}), "some_findings.txt:2: `x` must be a number or a text");
  EXPECT_EQ(refusal(text, {}), "some_findings.txt:1: [one] has no value `x`");
  EXPECT_EQ(refusal("[one]\nOne.", {{"two", {{"x", 1}}}}), "some_findings.txt:1: has no finding [two]");
  EXPECT_EQ(refusal("[one]\nOne {x|as row}.", {{"one", {{"x", {{"n", 1}}}}}}),
            "some_findings.txt:2: has no paragraph [row]");
}

TEST(FindingsText, RefusesWhatItCannotRead) {
  for (const auto& [text, message] :
       {std::pair{"# Words.\n[one\nWords.", "2: expected `]`"},
        {"[one] Words } of.", "1: a `}` that closes nothing"},
        {"[one]\nA {x|rouned}.", "2: `rouned` must be one of counted, rounded, percent, fixed, short, as"},
        {"[one]\nA {x ? \"yes}.", "2: a `}` that closes nothing"},
        {"[one]\nA\n{x ? \"yes", "3: a text without its closing"},
        {"[one]\nA {x ?}.", "2: expected a name"},
        {"[one]\nA {x", "2: expected `}`"},
        {"[one]\nA {x \"{y}\"}.", "2: expected words between"},
        {"[one]\nA.\n[one]\nB.", "4: a name that is there twice"},
        {"[one]\nA {x|rounded ? \"a\"}.", "2: expected `}`"}}) {
    const std::string refused = refusal(text, {});
    EXPECT_EQ(refused.find(std::string("some_findings.txt:") + message), 0u) << text << "\n" << refused;
  }
}

}  // namespace palpate::study
