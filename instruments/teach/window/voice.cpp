// posix_spawn without a shell: a sentence is an argument, never part of a command.
#include "teach/window/voice.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSpeechProgram = "espeak-ng";
/// Words a minute: slower than espeak-ng's 175, for people whose attention is in their finger.
constexpr const char* kWordsAMinute = "150";

std::optional<std::string> inPath(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    return ::access(name.c_str(), X_OK) == 0 ? std::optional(name) : std::nullopt;
  }
  const char* path = std::getenv("PATH");
  for (const std::string_view folder : split(path == nullptr ? "" : path, ':')) {
    const fs::path file = fs::path(folder) / name;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return file.string();
  }
  return std::nullopt;
}

bool isEspeak(const std::string& program) { return fs::path(program).filename() == kSpeechProgram; }

/// Starts the program in its own process, its output discarded.
pid_t spawned(const std::string& program, const std::string& sentence) {
  std::string text = sentence;
  std::array<std::string, 6> words = {program, "-v", std::string(language().code), "-s", kWordsAMinute, "--"};
  std::array<char*, 8> arguments{};
  std::size_t count = 0;
  arguments[count++] = words[0].data();
  if (isEspeak(program)) {
    for (std::size_t i = 1; i < words.size(); ++i) arguments[count++] = words[i].data();
  }
  arguments[count] = text.data();
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int fault = posix_spawn(&child, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  return fault == 0 ? child : 0;
}

}  // namespace

std::optional<std::string> speechProgram() {
  const char* wanted = std::getenv("PALPATE_SPEECH");
  if (wanted == nullptr || *wanted == '\0') return inPath(kSpeechProgram);
  if (std::string_view(wanted) == "off") return std::nullopt;
  return inPath(wanted);
}

Voice::~Voice() { stopSpeaking(); }

void Voice::say(const std::string& sentence) {
  if (!program_ || sentence.empty()) return;
  waiting_ = asSpoken(sentence);
  advance();
}

void Voice::begin(const std::string& sentence) {
  child_ = spawned(*program_, sentence);
  if (child_ == 0) program_.reset();  // gone since it was found: silent from now on
}

void Voice::advance() {
  if (child_ > 0 && ::waitpid(child_, nullptr, WNOHANG) == 0) return;
  child_ = 0;
  if (program_ && waiting_) begin(*std::exchange(waiting_, std::nullopt));
}

void Voice::follow(const training::Sitting* session, const std::string& title) {
  advance();
  if (!can()) return;
  if (session != nullptr) {
    const training::Said said = session->said();
    if (std::exchange(spoken_, said.number) != said.number) say(said.text);
    spoken_title_ = title;
  } else if (std::exchange(spoken_title_, title) != title) {
    say(title);
  }
}

void Voice::stopSpeaking() {
  waiting_.reset();
  if (child_ <= 0) return;
  ::kill(child_, SIGTERM);
  ::waitpid(child_, nullptr, 0);
  child_ = 0;
}

std::string asSpoken(const std::string& sentence) {
  const std::pair<std::string_view, std::string> signs[] = {
      {"–", fmt::format(" {} ", tr("to"))}, {"%", fmt::format(" {}", tr("per cent"))}, {"  ", " "}, {" .", "."}};
  std::string spoken = sentence;
  for (const auto& [sign, words] : signs) {
    for (std::size_t at = spoken.find(sign); at != std::string::npos; at = spoken.find(sign, at + words.size())) {
      spoken.replace(at, sign.size(), words);
    }
  }
  return spoken;
}

}  // namespace palpate::viewer
