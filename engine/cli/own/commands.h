// The commands of `palpate` itself, each in a file of its own, and of palpate-serve.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addOwnCommands(Command& app);
void addServeFamily(Command& app);

void addRunCommand(Command& app);
void addSimulateCommand(Command& app);
void addRenderCommand(Command& app);
void addDevicesCommand(Command& app);

// For `palpate body`; those for bodies and recordings are in both.
void addModelCommand(Command& body);
void addFitBodyCommand(Command& body);
void addRepairCommand(Command& group);
void addInfoCommand(Command& group);

// For `palpate recording`.
void addRecordCommand(Command& recording);
void addRecordingsCommand(Command& recording);
void addReplayCommand(Command& recording);
void addTrimCommand(Command& recording);
void addJoinCommand(Command& recording);
void addAnnotateCommand(Command& recording);
void addBundleCommand(Command& recording);
void addExportCommand(Command& recording);

}  // namespace palpate::app
