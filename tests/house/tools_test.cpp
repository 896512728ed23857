// The tools that are scripts of the shell, as somebody meets them who does not know what they do: some run for hours.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "support/places.h"
#include "support/run_command.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

bool isOfTheShell(const std::string& text) {
  const std::string first = text.substr(0, text.find('\n'));
  return first == "#!/bin/sh" || first == "#!/usr/bin/env bash";
}

/// The comment that a script opens with, without its marks.
std::string openingComment(const std::string& text) {
  std::istringstream lines(text);
  std::string line, comment;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with('#')) comment += line.substr(line.size() > 1 ? 2 : 1) + "\n";
  return comment;
}

}  // namespace

TEST(Tools, SayWhatTheyDoWhenAskedForHelpAndDoNothing) {
  std::size_t asked = 0;
  for (const auto& entry : fs::directory_iterator(support::sourceFolder() / "tools")) {
    const fs::path& tool = entry.path();
    const std::string text = support::contentOf(tool);
    if (!isOfTheShell(text) || tool.filename() == "bench-kernels")
      continue;  // that one's arguments go to Google Benchmark
    const auto answer = support::runProgram("/usr/bin/timeout", "10 '" + tool.string() + "' --help", "/");
    EXPECT_EQ(answer.exit_code, 0) << tool << answer.err;
    EXPECT_EQ(answer.out, openingComment(text)) << tool;
    EXPECT_GT(answer.out.size(), 40u) << tool;
    ++asked;
  }
  EXPECT_GT(asked, 20u);
}

}  // namespace palpate
