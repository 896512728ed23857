#include "cli/kit/progress_line.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/kit/interruption.h"
#include "palpate/base/system/process.h"

namespace palpate::app {

namespace {

/// A terminal is rewritten ten times a second; a log gets a line only when work takes longer than two seconds.
constexpr std::chrono::milliseconds kTerminalPause{100};
constexpr std::chrono::seconds kLogPause{2};

}  // namespace

void say(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

ProgressLine::ProgressLine() : terminal_(system::isStderrTerminal()), next_(Clock::now()) {
  if (!terminal_) next_ += kLogPause;
}

ProgressLine::~ProgressLine() { clear(); }

Progress ProgressLine::callback() { return interruptible(display()); }

Progress ProgressLine::display() {
  return [this](std::string_view stage, double done) { show(stage, done); };
}

void ProgressLine::show(std::string_view stage, double done) {
  const bool new_stage = terminal_ && stage != stage_;
  if (!new_stage && Clock::now() < next_) return;
  stage_ = stage;
  next_ = Clock::now();
  next_ += terminal_ ? std::chrono::duration_cast<Clock::duration>(kTerminalPause) : kLogPause;
  const std::string percent = done > 0.0 ? fmt::format(" {:.0f} %", 100.0 * done) : " ...";
  const std::string line = fmt::format("{}{}", stage, percent);
  if (terminal_) {
    say("\r\x1b[K" + line);
  } else if (line != said_) {
    say(line + "\n");
  }
  said_ = line;
  visible_ = terminal_;
}

void ProgressLine::clear() {
  if (visible_) say("\r\x1b[K");
  visible_ = false;
}

}  // namespace palpate::app
