// `palpate`: reads the command line and hands over to the chosen subcommand.
#include "cli/kit/commands.h"

int main(int argc, char** argv) {
  CLI::App app{"Palpate: feel, see and measure touch on a soft human body.", "palpate"};
  app.set_version_flag("--version", PALPATE_VERSION);
  palpate::app::addAllCommands(app);
  return palpate::app::runCommandLine(app, argc, argv);
}
