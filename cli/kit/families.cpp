#include "cli/kit/families.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "palpate/base/error.h"

namespace palpate::app {

namespace {

/// Up to the separator, which goes too.
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

/// As the system takes them; `words` must outlive it.
std::vector<char*> argumentsOf(std::string& program, std::vector<std::string>& words) {
  std::vector<char*> arguments = {program.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

const std::vector<FamilyCommand>& familyCommands() {
  static const std::vector<FamilyCommand> rows = readFamilies();
  return rows;
}

const FamilyCommand* familyOf(const std::vector<std::string>& words) {
  for (const FamilyCommand& row : familyCommands()) {
    if (beginsWith(words, row.command)) return &row;
  }
  return nullptr;
}

std::filesystem::path ownProgram() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

std::filesystem::path familyProgram(std::string_view family) {
  std::error_code error;
  const std::filesystem::path own = ownProgram();
  std::filesystem::path program = own.parent_path() / fmt::format("palpate-{}", family);
  return !own.empty() && std::filesystem::exists(program, error) ? program : std::filesystem::path();
}

void becomeFamily(const FamilyCommand& command, const std::vector<std::string>& words) {
  const std::filesystem::path program = familyProgram(command.family);
  if (program.empty()) {
    throw Error(fmt::format(
        "palpate {} is in the package palpate-{}, which is not installed here; from the source: ./run {}, or "
        "cmake --build BUILD --target palpate_{}_family",
        command.command, command.family, command.command, command.family));
  }
  std::string name = "palpate";  // what its messages and its help call it
  std::vector<std::string> own = words;
  execv(program.c_str(), argumentsOf(name, own).data());
  throw Error::inFile(program.string(), "cannot be started: " + std::generic_category().message(errno));
}

bool runFamily(std::string_view family, const std::vector<std::string>& words) {
  const std::filesystem::path program = familyProgram(family);
  if (program.empty()) return false;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  }
  std::string name = "palpate";
  std::vector<std::string> own = words;
  pid_t child = 0;
  const bool started =
      posix_spawn(&child, program.c_str(), &files, nullptr, argumentsOf(name, own).data(), environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  if (!started) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace palpate::app
