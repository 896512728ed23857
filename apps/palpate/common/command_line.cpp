#include "apps/palpate/common/commands.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "apps/palpate/common/interruption.h"
#include "apps/palpate/common/progress_line.h"

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
    say(fmt::format("palpate: {} (see --help)\n", reasonOf(app, error)));
    return kWrongInput;
  }
  return 0;
}

/// What was printed may still be in a buffer, and the disk that it goes to full.
int flushed(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  const int reason = errno;
  if (reason == EPIPE) return exitCodeOf(SIGPIPE);  // the reader has what it wanted
  say(fmt::format("palpate: standard output: cannot be written: {}\n", std::generic_category().message(reason)));
  return kWrongInput;
}

int runToTheEnd(CLI::App& app, int argc, char** argv) {
  try {
    return flushed(parse(app, argc, argv));
  } catch (const Ended&) {
    say(fmt::format("palpate: ended by {}\n", nameOfSignal(endAskedBy())));
  } catch (const std::system_error& error) {  // fmt's, when it cannot print
    if (std::ferror(stdout) != 0) return flushed(kWrongInput);
    say(fmt::format("palpate: {}\n", error.what()));
  } catch (const std::exception& error) {
    say(fmt::format("palpate: {}\n", error.what()));
  }
  return kWrongInput;
}

}  // namespace

int runCommandLine(CLI::App& app, int argc, char** argv) {
  listenForSignals();
  const int exit_code = runToTheEnd(app, argc, argv);
  return endAskedBy() == 0 ? exit_code : exitCodeOf(endAskedBy());
}

}  // namespace palpate::app
