// A socket in place of a pipe: writing to one whose reader has ended can be kept from raising SIGPIPE. Its words go to
// a file and not to another pipe, which it could fill while we fill its input. A process group of its own keeps signals
// away.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/base/system/fed_program.h"
#include "palpate/base/system/process.h"
#include "palpate/base/system/signals.h"

namespace palpate::system {

namespace {

/// Our environment, and our process id: a program of our own then ends with us, however we end (endWithStarter).
std::vector<char*> environmentNaming(std::string& starter) {
  starter = fmt::format("{}={}", kStarterVariable, ::getpid());
  const std::string_view name(starter.data(), starter.find('=') + 1);
  std::vector<char*> environment;
  for (char** entry = environmentOfTheProgram(); *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with(name)) environment.push_back(*entry);
  }
  environment.push_back(starter.data());
  environment.push_back(nullptr);
  return environment;
}

/// Lets a program receive stop signals, even where we ignore them (`palpate run &` in a script).
void restoreStopSignals(posix_spawnattr_t& attributes) {
  sigset_t heard;
  sigemptyset(&heard);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&heard, signal);
  posix_spawnattr_setsigdefault(&attributes, &heard);
}

int spawnProgram(const std::filesystem::path& program, std::vector<std::string> words, int input, int said,
                 pid_t& process) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, said, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  restoreStopSignals(attributes);
  std::string starter;
  std::vector<char*> environment = environmentNaming(starter);
  const int error = posix_spawn(&process, program.c_str(), &files, &attributes, arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

int ended(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

FedProgram::FedProgram(const std::filesystem::path& program, const std::vector<std::string>& words)
    : words_(std::tmpfile(), &std::fclose) {
  std::array<int, 2> ends{};
#ifdef SOCK_CLOEXEC  // at once: a program that another thread starts must not hold our end open
  constexpr int kKind = SOCK_STREAM | SOCK_CLOEXEC;
#else
  constexpr int kKind = SOCK_STREAM;
#endif
  if (!words_ || ::socketpair(AF_UNIX, kKind, 0, ends.data()) != 0) {
    reason_ = errno;
    return;
  }
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
#ifdef SO_NOSIGPIPE
  const int on = 1;
  ::setsockopt(ends[0], SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof(on));
#endif
  pid_t process = -1;
  reason_ = spawnProgram(program, words, ends[1], ::fileno(words_.get()), process);
  ::close(ends[1]);
  input_ = ends[0];
  process_ = reason_ == 0 ? process : -1;
}

FedProgram::~FedProgram() {
  closeInput();
  if (process_ <= 0 || has_ended_) return;
  ::kill(static_cast<pid_t>(process_), SIGKILL);
  ended(static_cast<pid_t>(process_));
}

void FedProgram::closeInput() {
  if (input_ >= 0) ::close(static_cast<int>(std::exchange(input_, -1)));
}

bool FedProgram::feed(std::string_view bytes) {
#ifdef MSG_NOSIGNAL
  constexpr int kFlags = MSG_NOSIGNAL;
#else
  constexpr int kFlags = 0;
#endif
  while (!bytes.empty()) {
    const ssize_t sent = ::send(static_cast<int>(input_), bytes.data(), bytes.size(), kFlags);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

FedProgram::Ending FedProgram::finish() {
  closeInput();
  const pid_t process = static_cast<pid_t>(std::exchange(process_, -1));
  const int status = has_ended_ ? status_ : ended(process);
  if (!WIFEXITED(status)) return {false, fmt::format("signal {}", WTERMSIG(status))};
  return {WEXITSTATUS(status) == 0, fmt::format("exit code {}", WEXITSTATUS(status))};
}

bool FedProgram::hasEnded() {
  if (process_ <= 0 || has_ended_) return true;
  has_ended_ = ::waitpid(static_cast<pid_t>(process_), &status_, WNOHANG) > 0;
  return has_ended_;
}

void FedProgram::sendInterrupt() {
  if (!hasEnded()) ::kill(static_cast<pid_t>(process_), SIGINT);
}

}  // namespace palpate::system
