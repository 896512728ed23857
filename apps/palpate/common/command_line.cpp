#include "apps/palpate/common/commands.h"

#include <fmt/format.h>

#include <exception>

namespace palpate::app {

namespace {

constexpr int kWrongInput = 2;

/// CLI11 says of a word that is no subcommand only that one is missing.
std::string reasonOf(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (error.get_name() != "RequiredError" || unknown.empty()) return error.what();
  return fmt::format("'{}' is no command here", unknown.front());
}

int parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& answer) {  // a command's "no"
    return answer.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "palpate: {} (see --help)\n", reasonOf(app, error));
    return kWrongInput;
  }
  return 0;
}

}  // namespace

int runCommandLine(CLI::App& app, int argc, char** argv) {
  try {
    return parse(app, argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate: {}\n", error.what());
    return kWrongInput;
  }
}

}  // namespace palpate::app
