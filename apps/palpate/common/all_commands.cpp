// Every subcommand of `palpate`.
#include "apps/palpate/common/commands.h"

namespace palpate::app {

void addAllCommands(CLI::App& app) {
  app.require_subcommand(1);
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
}

}  // namespace palpate::app
