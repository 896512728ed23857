// `palpate`: reads the command line and hands over to the chosen subcommand.
//
// Exit codes: 0 done, 1 the command ran and its answer is "no" (a check that failed), 2 wrong input or usage.
#include <fmt/format.h>

#include <exception>

#include "apps/palpate/commands.h"

namespace {

constexpr int kWrongInput = 2;

int run(int argc, char** argv) {
  CLI::App app{"Palpate: feel, see and measure touch on a soft human body.", "palpate"};
  app.set_version_flag("--version", PALPATE_VERSION);
  app.require_subcommand(1);
  palpate::app::addBenchCommand(app);
  palpate::app::addInfoCommand(app);
  palpate::app::addMapCommand(app);
  palpate::app::addModelCommand(app);
  palpate::app::addPartitionCommand(app);
  palpate::app::addSimulateCommand(app);
  palpate::app::addRenderCommand(app);
  palpate::app::addRepairCommand(app);
  palpate::app::addRunCommand(app);
  palpate::app::addStudyCommand(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& answer) {  // a command's "no"
    return answer.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "palpate: {} (see --help)\n", error.what());
    return kWrongInput;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate: {}\n", error.what());
    return kWrongInput;
  }
}
