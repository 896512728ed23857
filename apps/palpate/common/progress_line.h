// Progress of long work for the person who waits: one line that is rewritten on a terminal, a few plain lines in a log.
#pragma once

#include <string>

#include "palpate/base/progress.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app {

/// Prints to stderr, so that results on stdout stay clean. One thread.
class ProgressLine {
 public:
  ProgressLine();
  /// Clears the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// For the library; valid as long as this object.
  Progress callback();
  void show(std::string_view stage, double done);
  void clear();

 private:
  bool terminal_;
  bool visible_ = false;
  std::string stage_;
  Clock::time_point next_;
};

}  // namespace palpate::app
