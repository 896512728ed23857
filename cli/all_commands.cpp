// Every subcommand of `palpate`.
#include "cli/kit/commands.h"

namespace palpate::app {

void addAllCommands(CLI::App& app) {
  app.require_subcommand(1);
  offerMeasuringMode();
  offerMeasuringStudies();
  offerTrainingStudies();
  addAnnotateCommand(app);
  addBenchCommand(app);
  addBundleCommand(app);
  addClassCommand(app);
  addDevicesCommand(app);
  addExportCommand(app);
  addFitBodyCommand(app);
  addFitCommand(app);
  addHuntCommand(app);
  addInfoCommand(app);
  addJoinCommand(app);
  addMapCommand(app);
  addMeasureCommand(app);
  addModelCommand(app);
  addPartitionCommand(app);
  addPlotCommand(app);
  addSimulateCommand(app);
  addRealismCommand(app);
  addRecordCommand(app);
  addRenderCommand(app);
  addRepairCommand(app);
  addReplayCommand(app);
  addReportCommand(app);
  addResultsCommand(app);
  addServeCommand(app);
  addSessionsCommand(app);
  addTrimCommand(app);
  addRunCommand(app);
  addStudyCommand(app);
  addTissueCommand(app);
  addTrainCommand(app);
  app.footer(
      "Examples:\n"
      "  palpate run --preset vhb                 Touch the dissertation's Virtual Haptic Back\n"
      "  palpate run my_scan.stl                  Touch any mesh with the mouse\n"
      "  palpate simulate --preset vhb --json     Palpate without a window or device, and print what was felt");
}

}  // namespace palpate::app
