// Every option of every command that takes a number refuses what is none.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "class/commands/commands.h"
#include "cli/kit/commands.h"
#include "cli/kit/number_option.h"
#include "cli/own/commands.h"
#include "dissertation/command/commands.h"
#include "measure/commands/commands.h"
#include "report/commands.h"
#include "teach/commands/commands.h"

namespace palpate::app {
namespace {

/// An option with the words that lead to its command.
struct FoundOption {
  std::vector<std::string> words;
  std::string name;
  std::string type;
  std::string help;
  int values = 1;
  bool positional = false;
};

void collect(const Command& command, const std::vector<std::string>& words, std::vector<FoundOption>& found) {
  for (const Option* option : command.get_options()) {
    found.push_back({words, option->get_single_name(), option->get_type_name(), option->get_description(),
                     option->get_expected_min(), option->get_positional()});
  }
  for (const Command* sub : command.all_subcommands()) {
    std::vector<std::string> deeper = words;
    deeper.push_back(sub->get_name());
    collect(*sub, deeper, found);
  }
}

void addAllCommands(Command& app) {
  addOwnCommands(app);
  addServeFamily(app);
  addReportFamily(app);
  addMeasureCommand(app);
  addTeachFamily(app);
  addClassCommand(app);
  addStudyFamily(app);
}

std::vector<FoundOption> allOptions() {
  Command app{"", "palpate"};
  addAllCommands(app);
  std::vector<FoundOption> found;
  collect(app, {}, found);
  return found;
}

bool takesNumbers(const FoundOption& option) {
  for (const char* type : {kNumberType, kCountType, kPlaceType, "WIDTHxHEIGHT"}) {
    if (option.type.find(type) != std::string::npos) return true;
  }
  return false;
}

/// As many numbers as the option wants, each this one.
std::string valueOf(const FoundOption& option, const std::string& number) {
  if (option.type.find("WIDTHxHEIGHT") != std::string::npos) return number + "x" + number;
  const int count = option.type.find(kPlaceType) != std::string::npos ? 3 : option.values;
  std::string value = number;
  for (int i = 1; i < count; ++i) value += "," + number;
  return value;
}

struct Answer {
  int exit_code = -1;
  std::string error;
};

Answer answerTo(const FoundOption& option, const std::string& value) {
  std::vector<std::string> words = option.words;
  words.push_back(fmt::format("--{}={}", option.name, value));
  Command app{"", "palpate"};
  addAllCommands(app);
  testing::internal::CaptureStderr();
  const int exit_code = runCommandLine(app, words);
  return {exit_code, testing::internal::GetCapturedStderr()};
}

}  // namespace

TEST(NumberOptions, NoneIsReadByTheLibraryUnchecked) {
  std::size_t numbers = 0;
  for (const FoundOption& option : allOptions()) {
    for (const char* unchecked : {"INT", "FLOAT", "DOUBLE"}) {
      EXPECT_EQ(option.type.find(unchecked), std::string::npos) << option.name << " goes around addNumber";
    }
    numbers += takesNumbers(option) ? 1 : 0;
  }
  EXPECT_GT(numbers, 80u);
}

TEST(NumberOptions, EachSaysItsRangeInTheHelp) {
  for (const FoundOption& option : allOptions()) {
    if (option.type != kNumberType && option.type != kCountType) continue;
    EXPECT_TRUE(option.help.ends_with(")")) << option.name << ": " << option.help;
  }
}

class NumberOption : public testing::TestWithParam<const char*> {};

TEST_P(NumberOption, RefusesIt) {
  for (const FoundOption& option : allOptions()) {
    if (!takesNumbers(option)) continue;
    ASSERT_FALSE(option.positional) << option.name;
    const Answer answer = answerTo(option, valueOf(option, GetParam()));
    EXPECT_EQ(answer.exit_code, 2) << fmt::format("{}", fmt::join(option.words, " ")) << " --" << option.name;
    EXPECT_EQ(answer.error.find("palpate: --" + option.name + ": "), 0u) << option.name << ": " << answer.error;
    EXPECT_EQ(answer.error.find('\n'), answer.error.size() - 1) << answer.error;
  }
}

INSTANTIATE_TEST_SUITE_P(Words, NumberOption,
                         testing::Values("nan", "inf", "-inf", "1e300", "-1e300", "soft", "+-5", "3mm"));

}  // namespace palpate::app
