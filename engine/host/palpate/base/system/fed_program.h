// Another program that is fed through its standard input. Its error messages are kept, its output is discarded. It does
// not get the signals that a terminal sends to this one, which ends it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::system {

class FedProgram {
 public:
  /// `words`: its name and its arguments. `reason` is an errno where it could not be started, else 0.
  FedProgram(const std::filesystem::path& program, const std::vector<std::string>& words);
  /// One that was not finished is ended at once.
  ~FedProgram();
  FedProgram(const FedProgram&) = delete;
  FedProgram& operator=(const FedProgram&) = delete;
  int reason() const { return reason_; }

  /// False when it reads no more: it has ended, or will now.
  bool feed(std::string_view bytes);

  struct Ending {
    bool well = false;  ///< exit code 0
    std::string how;    ///< "exit code 1", "signal 9"
  };
  /// Closes its input and waits for its end.
  Ending finish();

  /// Whether it has ended already; does not wait.
  bool hasEnded();
  /// Sends Ctrl+C, as its terminal would; on Windows, which cannot send it to a program without a console, it is ended
  /// at once. `finish` waits for it.
  void sendInterrupt();

  /// Its words so far.
  std::string said();

 private:
  void closeInput();

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> words_;  // a file without a name
  int reason_ = 0;
  std::intptr_t input_ = -1;
  std::intptr_t process_ = -1;
  int status_ = 0;  // for one that has ended and was not finished yet
  bool has_ended_ = false;
};

}  // namespace palpate::system
