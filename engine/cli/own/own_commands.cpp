// The commands of `palpate` itself, without a program of another package.
#include "cli/kit/commands.h"
#include "cli/own/commands.h"

namespace palpate::app {

void addOwnCommands(Command& app) {
  addRunCommand(app);
  addSimulateCommand(app);
  addRenderCommand(app);
  addDevicesCommand(app);

  Command& body = commandGroup(app, "body");
  addModelCommand(body);
  addFitBodyCommand(body);
  addRepairCommand(body);
  addInfoCommand(body);

  Command& recording = commandGroup(app, "recording");
  addRecordCommand(recording);
  addRecordingsCommand(recording);
  addInfoCommand(recording);
  addReplayCommand(recording);
  addTrimCommand(recording);
  addJoinCommand(recording);
  addAnnotateCommand(recording);
  addBundleCommand(recording);
  addExportCommand(recording);
  addRepairCommand(recording);
}

}  // namespace palpate::app
