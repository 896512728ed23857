// Commands and their options. CLI11 parses them, and only options.cpp includes it: its templates cost every file that
// sees them seconds of compiling. Functions have CLI11's names and meanings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// The names are CLI11's.
// NOLINTBEGIN(readability-identifier-naming)
namespace CLI {
class Option;
}

namespace palpate::app {

/// The command line is wrong. The command ends with one line that points to --help.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message) : std::runtime_error(message) {}
  UsageError(const std::string& option, const std::string& cause) : UsageError(option + ": " + cause) {}
  static UsageError aboutArguments(const std::string& message) {
    UsageError error(message);
    error.about_words_ = true;
    return error;
  }

  /// A word was not expected or is missing, so that an unknown word says more (Command::remaining).
  bool isAboutArguments() const { return about_words_; }

 private:
  bool about_words_ = false;
};

/// Ends the command with this exit code and without a message: it ran, and its answer is "no".
class ExitWith : public std::runtime_error {
 public:
  explicit ExitWith(int code) : std::runtime_error("Runtime error"), code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};

/// For Option::check: the value is one of these, which the help lists.
struct IsMember {
  std::vector<std::string> names;
};
/// For Option::check: a file or folder that exists.
struct ExistingPath {};

/// An option that takes any number of values.
inline constexpr int kAnyNumberOfValues = 1 << 29;

/// Returns the error of a value; empty for a valid one.
using Check = std::function<std::string(const std::string& value)>;

/// An option or a flag of a command, which owns it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}
  Option(const Option&) = delete;
  Option& operator=(const Option&) = delete;

  // Each returns this option.
  Option* required(bool value = true);
  Option* type_name(const std::string& name);
  Option* description(const std::string& text);
  Option* group(const std::string& name);
  Option* capture_default_str();
  Option* default_str(const std::string& text);
  Option* delimiter(char separator);
  Option* expected(int count);
  Option* expected(int least, int most);
  Option* allow_extra_args(bool value = true);
  Option* check(const Check& check);
  Option* check(const IsMember& names);
  Option* check(ExistingPath existing);
  Option* needs(Option* other);
  Option* needs(const std::string& other);
  Option* excludes(Option* other);
  Option* excludes(const std::string& other);

  /// Its long name with hyphens, or that of a positional argument.
  std::string get_name() const;
  std::string get_single_name() const;
  const std::vector<std::string>& get_snames() const;
  const std::vector<std::string>& get_lnames() const;
  const std::string& get_description() const;
  std::string get_type_name() const;
  std::string get_default_str() const;
  int get_expected_min() const;
  int get_items_expected_max() const;
  bool get_positional() const;
  /// Number of uses.
  std::size_t count() const;

 private:
  CLI::Option* option_;
  friend class Command;
};

/// A command with its options and subcommands, which live as long as it does.
class Command {
 public:
  Command(const std::string& description, const std::string& name);
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  // Options whose value is a text, several of them or a file. The variable must outlive the command.
  Option* add_option(const std::string& name, std::string& value, const std::string& help);
  Option* add_option(const std::string& name, std::filesystem::path& value, const std::string& help);
  Option* add_option(const std::string& name, std::optional<std::string>& value, const std::string& help);
  Option* add_option(const std::string& name, std::optional<std::filesystem::path>& value, const std::string& help);
  Option* add_option(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option* add_option(const std::string& name, std::vector<std::filesystem::path>& values, const std::string& help);
  /// `read` is called with all the values; `shown` is the default for capture_default_str.
  Option* add_option(const std::string& name, const std::function<void(const std::vector<std::string>&)>& read,
                     const std::string& help, const std::function<std::string()>& shown);
  Option* add_option_function(const std::string& name, const std::function<void(const std::string&)>& read,
                              const std::string& help);
  Option* add_option_function(const std::string& name, const std::function<void(const std::vector<std::string>&)>& read,
                              const std::string& help);
  Option* add_flag(const std::string& name, bool& value, const std::string& help);
  /// `read` is called with the count of the flag less the count of its opposite.
  Option* add_flag_function(const std::string& name, const std::function<void(std::int64_t)>& read,
                            const std::string& help);
  void set_version_flag(const std::string& name, const std::string& version);

  Command* add_subcommand(const std::string& name, const std::string& help);
  Command* require_subcommand(int count);
  Command* require_subcommand(std::size_t least, std::size_t most);
  Command* group(const std::string& name);
  Command* footer(const std::string& text);
  Command* callback(const std::function<void()>& run);
  /// Whether "/x" is an option.
  Command* allow_windows_style_options(bool value);

  std::string get_name() const;
  std::string get_description() const;
  std::string version() const;
  const Command* get_parent() const;
  /// The option of that name. Throws std::exception where there is none.
  Option* get_option(const std::string& name);
  std::vector<Option*> get_options();
  std::vector<const Option*> get_options() const;
  /// --help.
  const Option* get_help_ptr() const;
  /// Number of uses of the option of that name.
  std::size_t count(const std::string& option) const;
  Command* get_subcommand(const std::string& name);
  /// All subcommands, in the order in which they were added.
  std::vector<Command*> all_subcommands() const;
  /// Those that the command line chose.
  std::vector<Command*> get_subcommands() const;

  /// Parses the words of a command line, the last one first, and runs the chosen commands. Prints the answers to --help
  /// and --version. Throws UsageError for a wrong command line, and exceptions of the callbacks.
  void parse(const std::vector<std::string>& last_first);
  /// The words that neither this command nor a chosen subcommand knows.
  std::vector<std::string> remaining() const;

 private:
  struct Impl;
  explicit Command(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

/// A new command of `parent`, and its arguments, for options to be added. Both live as long as `parent`; `run` is
/// called with the arguments once they are parsed.
template <class Arguments, class Run>
std::pair<Command&, Arguments&> addCommand(Command& parent, const std::string& name, const std::string& help,
                                           const Run& run) {
  const auto arguments = std::make_shared<Arguments>();
  Command& command = *parent.add_subcommand(name, help);
  command.callback([arguments, run] { run(*arguments); });
  return {command, *arguments};
}
template <class Arguments>
auto addCommand(Command& parent, const std::string& name, const std::string& help, void (*run)(const Arguments&)) {
  return addCommand<Arguments, void (*)(const Arguments&)>(parent, name, help, run);
}

}  // namespace palpate::app
// NOLINTEND(readability-identifier-naming)
