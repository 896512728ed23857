// Says sentences aloud, where a speech program is installed: a child process a sentence, never waited for. One sentence
// is spoken, the newest of those that came meanwhile follows it; older ones are not worth hearing any more. All of it
// is also on the screen.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "palpate/training/session/sitting.h"

namespace palpate::viewer {

/// The program's path, from PATH; nothing: it is not installed, or PALPATE_SPEECH says "off". PALPATE_SPEECH may name
/// another program that takes a sentence as its last argument.
std::optional<std::string> speechProgram();

class Voice {
 public:
  /// Without a program it is silent.
  explicit Voice(std::optional<std::string> program) : program_(std::move(program)) {}
  /// Cuts off the current sentence.
  ~Voice();
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

  void say(const std::string& sentence);
  /// Once a frame.
  void advance();
  /// The same, and says what is new: the session's text or, without one, the screen's title.
  void follow(const training::Sitting* session, const std::string& title);
  void beginSession() { spoken_ = 0; }
  /// Drops waiting sentences; the current one ends.
  void stopSpeaking();
  bool speaks() const { return child_ > 0 || waiting_.has_value(); }
  bool can() const { return program_.has_value(); }

 private:
  void begin(const std::string& sentence);

  std::optional<std::string> program_;
  pid_t child_ = 0;
  std::optional<std::string> waiting_;
  std::uint64_t spoken_ = 0;  ///< Said::number
  std::string spoken_title_;
};

/// The spoken form: signs that engines read out or stumble over become words.
std::string asSpoken(const std::string& sentence);

}  // namespace palpate::viewer
