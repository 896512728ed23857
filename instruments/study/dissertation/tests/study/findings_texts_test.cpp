// Every text of findings reads to its end, whatever its study decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "palpate/base/text.h"
#include "report/page/findings_text.h"
#include "support/places.h"

namespace palpate::study {

namespace {

namespace fs = std::filesystem;

using Paragraphs = std::vector<FindingsParagraph>;

/// No choice has more texts, no paragraph more choices of two.
constexpr std::size_t kMaxTexts = 5;
constexpr unsigned kMaxAnswers = 1U << 5U;

/// How a name is used in a paragraph.
struct NameUse {
  std::vector<std::string> words{};  ///< of its choice
  bool is_number = false;
  std::string paragraph{};
};

void addUses(const std::vector<FindingsPart>& parts, std::map<std::string, NameUse>& uses) {
  for (const FindingsPart& part : parts) {
    if (part.name.empty()) continue;
    NameUse& use = uses[part.name];
    if (!part.words.empty()) use.words = part.words;
    if (!part.paragraph.empty()) use.paragraph = part.paragraph;
    use.is_number |= !part.format.empty();
    for (const auto& text : part.texts) addUses(text, uses);
  }
}

const FindingsParagraph& paragraphOf(const Paragraphs& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const FindingsParagraph& one) { return one.name == name; });
}

/// Values by which a choice among words takes its text of this number, or its last, and one of two what the next bit of
/// the answers says.
FindingValues choosing(std::size_t text, unsigned answers, const Paragraphs& all, const FindingsParagraph& paragraph) {
  std::map<std::string, NameUse> uses;
  addUses(paragraph.parts, uses);
  FindingValues values = FindingValues::object();
  for (const auto& [name, use] : uses) {
    const bool of_two = !use.words.empty() && use.words.front() == "yes";
    const bool no = of_two && (answers & 1U) == 0U;
    if (of_two) answers >>= 1U;
    if (!use.words.empty() && !of_two) {
      values[name] = use.words[std::min(text, use.words.size() - 1)];
    } else if (!use.paragraph.empty()) {
      const FindingValues one = choosing(text, answers, all, paragraphOf(all, use.paragraph));
      values[name] = FindingValues::array();
      if (!no) values[name] = {one, one};
    } else if (use.is_number || of_two) {
      values[name] = no ? 0.0 : 0.5;
    } else {
      values[name] = "a body";
    }
  }
  return values;
}

void expectAllTextsToRead(const FindingsFile& file) {
  const Paragraphs all = readFindings(file);
  std::set<std::string> within_others;
  for (const FindingsParagraph& one : all) {
    std::map<std::string, NameUse> uses;
    addUses(one.parts, uses);
    for (const auto& [name, use] : uses) within_others.insert(use.paragraph);
  }
  for (std::size_t text = 0; text < kMaxTexts; ++text) {
    for (unsigned answers = 0; answers < kMaxAnswers; ++answers) {
      FindingValues values;
      for (const FindingsParagraph& one : all) {
        if (!within_others.contains(one.name)) values[one.name] = choosing(text, answers, all, one);
      }
      for (const std::string& finding : formatFindings(file, values)) {
        ASSERT_TRUE(finding.ends_with('.')) << file.path << ": " << finding;
      }
    }
  }
}

}  // namespace

TEST(FindingsTexts, ReadToTheEndWithEveryChoice) {
  std::size_t files = 0;
  for (const char* house : {"study/dissertation", "measure", "teach"}) {
    for (const auto& entry : fs::recursive_directory_iterator(support::sourceFolder() / "instruments" / house)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with("_findings.txt")) continue;
      const std::string text = readFile(entry.path(), 1U << 20U);
      expectAllTextsToRead({name, text});
      ++files;
    }
  }
  EXPECT_GE(files, 16u);
}

}  // namespace palpate::study
