#include "desktop.h"
#include "support/places.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <sstream>

namespace palpate::desktop {

namespace {

constexpr int kSilenceMs = 60'000;

bool onPath(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::vector<char*> pointersTo(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

std::string readAll(int fd) {
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(fd, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

}  // namespace

std::string whyNoDesktop() {
  if (!onPath("Xvfb")) return "Xvfb is missing: tools/install-dependencies --tests installs it";
  if (!onPath("xdotool")) return "xdotool is missing: tools/install-dependencies --tests installs it";
  return {};
}

Child::Child(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment,
             const std::vector<std::string>& unset, const std::filesystem::path& folder) {
  int out[2];
  int err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) return;
  pid_ = fork();
  if (pid_ == 0) {
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    for (const std::string& name : unset) unsetenv(name.c_str());
    if (chdir(folder.c_str()) != 0) _exit(126);
    execvp(arguments[0].c_str(), pointersTo(arguments).data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

Child::~Child() {
  if (pid_ > 0 && !ended_) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(out_);
  close(err_);
}

std::string Child::line() {
  while (true) {
    if (const auto end = pending_.find('\n'); end != std::string::npos) {
      std::string first = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return first.empty() ? " " : first;
    }
    pollfd ready{out_, POLLIN, 0};
    if (poll(&ready, 1, kSilenceMs) <= 0) return {};
    char buffer[4096];
    const ssize_t n = read(out_, buffer, sizeof buffer);
    if (n <= 0) return {};
    pending_.append(buffer, static_cast<std::size_t>(n));
  }
}

void Child::send(int signal) const {
  if (pid_ > 0 && !ended_) kill(pid_, signal);
}

int Child::exitCode() {
  if (ended_) return code_;
  while (!line().empty()) {
  }
  errors_ += readAll(err_);
  int status = 0;
  waitpid(pid_, &status, 0);
  ended_ = true;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return code_;
}

const std::string& Child::errors() {
  exitCode();
  return errors_;
}

Desktop::Desktop() {
  int number[2];
  if (pipe(number) != 0) return;
  server_ = fork();
  if (server_ == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDERR_FILENO);
    const std::string fd = std::to_string(number[1]);
    const std::string screen = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
    execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", screen.c_str(), "-nolisten", "tcp", nullptr);
    _exit(127);
  }
  close(number[1]);
  std::string answer;
  for (char c = 0; read(number[0], &c, 1) == 1 && c != '\n';) answer += c;
  close(number[0]);
  display_ = ":" + answer;
}

Desktop::~Desktop() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

std::map<std::string, std::string> Desktop::environment() const {
  return {{"DISPLAY", display_}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"LP_NUM_THREADS", "2"}};
}

bool Desktop::hand(const std::string& words) const {
  // It waits without an end for a window that closed before it looked.
  const std::string command = "DISPLAY=" + display_ + " timeout 60 xdotool " + words + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

std::map<std::string, std::string> parseFrameLine(const std::string& line) {
  std::map<std::string, std::string> values;
  if (!line.starts_with("frame ")) return values;
  std::istringstream words(line);
  std::string word;
  while (words >> word) {
    const auto equals = word.find('=');
    if (equals == std::string::npos) continue;
    std::string value = word.substr(equals + 1);
    if (word.starts_with("message=")) {  // the last one: a sentence
      std::string sentence;
      std::getline(words, sentence);
      value += sentence;
    }
    values[word.substr(0, equals)] = value;
  }
  return values;
}

namespace {

std::vector<std::string> commandLine(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {support::builtProgram(), "run", "--verbose", "--no-intro", "--out", "."};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

std::map<std::string, std::string> environmentIn(const Desktop& desktop, const std::filesystem::path& folder) {
  auto environment = desktop.environment();
  environment["XDG_CONFIG_HOME"] = (folder / "config").string();
  return environment;
}

}  // namespace

Program::Program(const Desktop& desktop, const std::filesystem::path& folder, const std::vector<std::string>& arguments)
    : desktop_(desktop), child_(commandLine(arguments), environmentIn(desktop, folder), {"WAYLAND_DISPLAY"}, folder) {
  // Without a window manager nobody gives the window the focus.
  if (until([](const auto&) { return true; })) hand("search --sync --onlyvisible --name Palpate windowfocus --sync");
}

bool Program::until(const std::function<bool(const std::map<std::string, std::string>&)>& ready) {
  constexpr double kPatienceS = 20.0;  // of the program's own clock
  const double start_s = number("t");
  for (std::string line = child_.line(); !line.empty(); line = child_.line()) {
    auto values = parseFrameLine(line);
    if (values.empty()) continue;
    newest_ = std::move(values);
    if (ready(newest_)) return true;
    if (number("t") > start_s + kPatienceS) return false;
  }
  return false;
}

double Program::number(const std::string& name) const {
  const auto found = newest_.find(name);
  return found == newest_.end() ? 0.0 : std::atof(found->second.c_str());
}

std::string Program::word(const std::string& name) const {
  const auto found = newest_.find(name);
  return found == newest_.end() ? std::string() : found->second;
}

std::string Program::rest() {
  std::string all;
  for (std::string line = child_.line(); !line.empty(); line = child_.line()) {
    const auto values = parseFrameLine(line);
    if (!values.empty()) newest_ = values;
    all += line + "\n";
  }
  return all;
}

}  // namespace palpate::desktop
