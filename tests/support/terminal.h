// A terminal for a program under test. There it shows each stage of its work as it begins; into a file it would tell
// only of what takes two seconds (engine/cli/kit/progress_line.h), and how long that is depends on the machine.
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

namespace palpate::support {

/// One thread. POSIX.
class Terminal {
 public:
  Terminal() : screen_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (screen_ < 0 || grantpt(screen_) != 0 || unlockpt(screen_) != 0) throw std::runtime_error("no terminal");
    program_side_ = open(ptsname(screen_), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    close(program_side_);
    close(screen_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// The descriptor that a program writes to.
  int programSide() const { return program_side_; }

  /// All that it has shown so far.
  const std::string& shown() {
    char piece[4096];
    for (ssize_t bytes = 0; (bytes = read(screen_, piece, sizeof piece)) > 0;) shown_.append(piece, bytes);
    return shown_;
  }

 private:
  int screen_;
  int program_side_ = -1;
  std::string shown_;
};

}  // namespace palpate::support
