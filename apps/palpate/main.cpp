// `palpate`: reads the command line and hands over to the chosen subcommand.
#include "apps/palpate/common/commands.h"

int main(int argc, char** argv) {
  CLI::App app{"Palpate: feel, see and measure touch on a soft human body.", "palpate"};
  app.set_version_flag("--version", PALPATE_VERSION);
  app.require_subcommand(1);
  palpate::app::addBenchCommand(app);
  palpate::app::addHuntCommand(app);
  palpate::app::addInfoCommand(app);
  palpate::app::addMapCommand(app);
  palpate::app::addModelCommand(app);
  palpate::app::addPartitionCommand(app);
  palpate::app::addPlotCommand(app);
  palpate::app::addSimulateCommand(app);
  palpate::app::addRenderCommand(app);
  palpate::app::addRepairCommand(app);
  palpate::app::addRunCommand(app);
  palpate::app::addStudyCommand(app);
  return palpate::app::runCommandLine(app, argc, argv);
}
