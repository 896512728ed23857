// Progress of long work for the user: one line that is rewritten on a terminal, a few plain lines in a log.
#pragma once

#include <string>
#include <string_view>

#include "palpate/base/progress.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app {

/// Prints to stderr. Failures (a closed pipe, a full disk) are ignored.
void say(std::string_view text);

/// Prints to stderr, so that results on stdout stay clean. One thread.
class ProgressLine {
 public:
  ProgressLine();
  /// Clears the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// For the library; valid as long as this object. Work that reports throws Ended (interruption.h) after a signal.
  Progress callback();
  /// The same without an end: for work that checks for signals itself, because it has something to finish.
  Progress display();
  void show(std::string_view stage, double done);
  void clear();

 private:
  bool terminal_;
  bool visible_ = false;
  std::string stage_;
  std::string said_;  ///< the last line
  Clock::time_point next_;
};

}  // namespace palpate::app
