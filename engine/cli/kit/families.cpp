#include "cli/kit/families.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"

namespace palpate::app {

namespace {

/// The name in the messages and the help of every program.
constexpr const char* kCalled = "palpate";

/// Cuts the text off up to the separator, which goes too.
std::string_view cutOff(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return piece;
}

std::vector<FamilyCommand> readFamilies() {
  std::vector<FamilyCommand> rows;
  for (std::string_view rest = familyTable(); !rest.empty();) {
    std::string_view line = cutOff(rest, '\n');
    if (line.empty() || line.starts_with('#')) continue;
    FamilyCommand row;
    for (std::string_view* cell : {&row.group, &row.command, &row.family, &row.what}) *cell = cutOff(line, '\t');
    rows.push_back(row);
  }
  return rows;
}

bool beginsWith(const std::vector<std::string>& words, std::string_view command) {
  for (const std::string& word : words) {
    if (cutOff(command, ' ') != word) return false;
    if (command.empty()) return true;
  }
  return false;
}

int become(const std::filesystem::path& program, const std::vector<std::string>& words) {
  const int exit_code = system::becomeProgram(program, kCalled, words);
  if (exit_code >= 0) return exit_code;
  throw Error::inFile(program.string(), "cannot be started: " + std::generic_category().message(errno));
}

}  // namespace

const std::vector<FamilyCommand>& familyCommands() {
  static const std::vector<FamilyCommand> rows = readFamilies();
  return rows;
}

const FamilyCommand* findFamilyCommand(const std::vector<std::string>& words) {
  for (const FamilyCommand& row : familyCommands()) {
    if (beginsWith(words, row.command)) return &row;
  }
  return nullptr;
}

std::filesystem::path familyProgram(std::string_view family) {
  std::error_code error;
  const std::filesystem::path own = system::ownProgram();
  std::filesystem::path program =
      own.parent_path() / pathOf(fmt::format("palpate-{}{}", family, system::kProgramExtension));
  return !own.empty() && std::filesystem::exists(program, error) ? program : std::filesystem::path();
}

int becomeFamily(const FamilyCommand& command, const std::vector<std::string>& words) {
  const std::filesystem::path program = familyProgram(command.family);
  if (program.empty()) {
    throw Error(
        fmt::format("palpate {} requires the package palpate-{}, which is not installed; from source: ./run {}, or "
                    "cmake --build BUILD --target palpate_{}_family",
                    command.command, command.family, command.command, command.family));
  }
  return become(program, words);
}

int becomeCommand(const std::vector<std::string>& words) {
  return become(system::ownProgram().parent_path() / pathOf(fmt::format("{}{}", kCalled, system::kProgramExtension)),
                words);
}

bool runFamily(std::string_view family, const std::vector<std::string>& words) {
  const std::filesystem::path program = familyProgram(family);
  if (program.empty()) return false;
  return system::runQuietly(program, kCalled, words) == 0;
}

}  // namespace palpate::app
