#include "palpate/classroom/broker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::classroom {

namespace {

namespace fs = std::filesystem;

constexpr auto kSettles =
    std::chrono::milliseconds(150);  // a port that is taken, a key that cannot be read: it ends at once
constexpr std::uint64_t kMaxLogBytes = 1ULL << 30U;

std::string readLastLine(const fs::path& log) {
  const std::string text = readFile(log, kMaxLogBytes);
  const auto lines = split(trimmed(text), '\n');
  return std::string(lines.back());
}

}  // namespace

fs::path brokerProgram() {
  const char* path = std::getenv("PATH");
  const std::string folders = fmt::format("{}:/usr/sbin:/usr/local/sbin", path == nullptr ? "" : path);
  for (const std::string_view folder : split(folders, ':')) {
    const fs::path program = fs::path(folder) / "mosquitto";
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

BrokerProcess::BrokerProcess(const ClassFolder& folder, fs::path log)
    : configuration_(fs::absolute(folder.configuration())), log_(std::move(log)) {
  writeBrokerConfiguration(folder);
  start();
}

BrokerProcess::~BrokerProcess() { end(SIGTERM); }

void BrokerProcess::start() {
  const std::string program = brokerProgram().string();
  if (program.empty()) throw Error("mosquitto is not installed (Debian: apt install mosquitto)");
  const std::string configuration = configuration_.string();
  const std::string log = log_.string();
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw Error("mosquitto cannot be started: no new process");
  if (child == 0) {
    // Only calls that are allowed between fork and exec. The broker dies with us, however that happens, and ignores
    // Ctrl-C.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    setpgid(0, 0);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (out >= 0) {
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
    }
    const std::array<const char*, 4> words = {"mosquitto", "-c", configuration.c_str(), nullptr};
    execv(program.c_str(), const_cast<char* const*>(words.data()));
    _exit(127);
  }
  id_ = child;
  std::this_thread::sleep_for(kSettles);
  if (!running()) throw Error::inFile(log, fmt::format("mosquitto ended at once: {}", readLastLine(log_)));
}

bool BrokerProcess::running() {
  if (id_ > 0 && waitpid(id_, nullptr, WNOHANG) != 0) id_ = -1;
  return id_ > 0;
}

void BrokerProcess::end(int signal) {
  if (!running()) return;
  ::kill(id_, signal);
  waitpid(id_, nullptr, 0);
  id_ = -1;
}

void BrokerProcess::kill() { end(SIGKILL); }

void BrokerProcess::restart() {
  end(SIGTERM);
  start();
}

}  // namespace palpate::classroom
