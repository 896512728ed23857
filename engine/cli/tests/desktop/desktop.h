// A desktop of its own for a test: an X server without a screen, the program in it, and hands (xdotool) that send real
// events. What is waited for is a line that the program prints, never a time.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace palpate::desktop {

/// Whether there is what a desktop needs; the reason if not.
std::string whyNoDesktop();

/// A child process with its output read line by line.
class Child {
 public:
  Child(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment,
        const std::vector<std::string>& unset = {}, const std::filesystem::path& folder = ".");
  /// Kills what still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The next line of its output; empty at its end or after a minute of silence.
  std::string line();
  void send(int signal) const;
  /// Waits for it to end; its exit code, or -1.
  int exitCode();
  const std::string& errors();
  bool ended() const { return ended_; }

 private:
  int pid_ = -1;
  int out_ = -1;
  int err_ = -1;
  bool ended_ = false;
  int code_ = -1;
  std::string pending_;
  std::string errors_;
};

/// An X server, as long as it lives.
class Desktop {
 public:
  static constexpr int kWidth = 1400;
  static constexpr int kHeight = 900;

  Desktop();
  ~Desktop();
  std::map<std::string, std::string> environment() const;
  /// Runs `xdotool` with these words; false if it fails.
  bool hand(const std::string& words) const;

 private:
  int server_ = -1;
  std::string display_;
};

/// The values of a line of `palpate run --verbose`: "frame 3 t=0.1 depth=2.5 ..." as a map.
std::map<std::string, std::string> parseFrameLine(const std::string& line);

/// `palpate run` on a desktop, with a folder for its settings and files.
class Program {
 public:
  Program(const Desktop& desktop, const std::filesystem::path& folder, const std::vector<std::string>& arguments);

  /// Reads frames until one is so; false when the program ends or falls silent before.
  bool until(const std::function<bool(const std::map<std::string, std::string>&)>& ready);
  /// A number of the newest frame.
  double number(const std::string& name) const;
  std::string word(const std::string& name) const;
  bool hand(const std::string& words) const { return desktop_.hand(words); }
  /// Everything it prints until it ends.
  std::string rest();
  void send(int signal) const { child_.send(signal); }
  int exitCode() { return child_.exitCode(); }
  std::string errors() { return child_.errors(); }

 private:
  const Desktop& desktop_;
  Child child_;
  std::map<std::string, std::string> newest_;
};

}  // namespace palpate::desktop
