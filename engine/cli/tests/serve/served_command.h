// `palpate serve` as a child of a test: started on a small body, ended by a signal.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpate/mesh/files/save.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate::support {

inline const std::string kLookToken = "look-0123456789abcdef";
inline const std::string kControlToken = "control-0123456789abcdef";
inline const std::string kInstructToken = "instruct-0123456789abcdef";

class ServedCommand {
 public:
  /// A dome, 200 mm wide, its top at (0, 0, 20). `more`: further words of the command. `scene`: a text that is served
  /// in place of the bare dome, and may name dome.ply and the layers back.json.
  explicit ServedCommand(const std::vector<std::string>& more = {}, const std::string& scene = {}) {
    mesh::save(folder_ / "dome.ply", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
    if (!scene.empty()) {
      tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
      std::ofstream(folder_ / "scene.toml") << scene;
    }
    std::filesystem::create_directories(folder_ / "site/part");
    std::ofstream(folder_ / "site/index.html")
        << "<!doctype html><head></head><script>let a = 1;</script><script src='m.js'></script>";
    std::ofstream(folder_ / "site/m.js") << "export const one = 1;\n";
    std::ofstream(folder_ / "site/part/e.wasm") << "not really";
    std::ofstream(folder_ / "site/.hidden") << "secret";
    std::ofstream(folder_ / "secret.txt") << "secret";
    std::filesystem::create_symlink("../secret.txt", folder_ / "site/link.txt");
    std::vector<std::string> words = {"serve",       scene.empty() ? "dome.ply" : "scene.toml",
                                      "--port",      "0",
                                      "--json",      "--look-token",
                                      kLookToken,    "--token",
                                      kControlToken, "--site",
                                      "site",        "--instruct-token",
                                      kInstructToken};
    words.insert(words.end(), more.begin(), more.end());
    child_ = ::fork();
    if (child_ == 0) runInFolder(std::move(words));
    serving_ = waitFor([&] { return contentOf(folder_ / "out").find('\n') != std::string::npos || hasEnded(); });
    const std::string line = contentOf(folder_ / "out");
    const auto json = nlohmann::json::parse(line.substr(0, line.find('\n')), nullptr, false);
    serving_ = serving_ && json.is_object() && json.contains("port");
    EXPECT_TRUE(serving_) << contentOf(folder_ / "err") << line;
    if (serving_) first_line_ = json;
  }
  ~ServedCommand() { end(SIGKILL); }
  ServedCommand(const ServedCommand&) = delete;
  ServedCommand& operator=(const ServedCommand&) = delete;

  int port() const { return serving_ ? first_line_["port"].get<int>() : 0; }
  const nlohmann::json& firstLine() const { return first_line_; }
  const TemporaryFolder& folder() const { return folder_; }

  /// The exit code; below 0 the signal that killed it.
  int end(int signal) {
    if (child_ <= 0) return 0;
    if (!ended_) {
      ::kill(child_, signal);
      ::waitpid(child_, &status_, 0);
    }
    child_ = 0;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }
  /// It ended by itself, or ends within the patience of waitFor.
  int endByItself() {
    EXPECT_TRUE(waitFor([&] { return hasEnded(); }));
    return end(SIGKILL);
  }
  nlohmann::json report() const {
    const std::string out = contentOf(folder_ / "out");
    const std::size_t last = out.rfind("{\"event\":\"ended\"");
    return last == std::string::npos ? nlohmann::json() : nlohmann::json::parse(out.substr(last), nullptr, false);
  }

 private:
  bool hasEnded() {
    if (!ended_ && child_ > 0) ended_ = ::waitpid(child_, &status_, WNOHANG) == child_;
    return ended_;
  }
  [[noreturn]] void runInFolder(std::vector<std::string> words) const {
    const char* other = std::getenv("PALPATE_COMMAND");  // one that is instrumented: tools/sanitize-serve
    words.insert(words.begin(), other != nullptr ? other : support::builtProgram());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    if (::chdir(folder_.path().c_str()) != 0) ::_exit(99);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
    ::dup2(::open("out", O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open("err", O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(pointers.front(), pointers.data());
    ::_exit(99);
  }

  TemporaryFolder folder_;
  pid_t child_ = -1;
  int status_ = 0;
  bool ended_ = false;
  bool serving_ = false;
  nlohmann::json first_line_;
};

}  // namespace palpate::support
