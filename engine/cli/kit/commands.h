// The command line of `palpate`, of the programs that it starts (families.h) and of palpate_peers: how it is run, and
// the subcommands. Each of these lives in a file of its own, adds itself to the command line or to its group, and runs
// when chosen.
#pragma once

#include <string>
#include <vector>

#include "cli/kit/options.h"

namespace palpate::app {

/// Replaces commands renamed in the last release by their present names, and prints the change.
std::vector<std::string> withPresentCommand(std::vector<std::string> words);

/// Parses a command line, runs the chosen command, and turns every error into one line and an exit code. 0: done; 1:
/// the command ran and its answer is "no" (a check that failed); 2: wrong input or usage, in one line on the standard
/// error, also when the standard output cannot be written; 128 and the signal's number after a signal (interruption.h).
int runCommandLine(Command& app, const std::vector<std::string>& words);

/// `palpate body`, `palpate recording`: made on first use.
Command& commandGroup(Command& app, const std::string& name);

// The commands of each program.

/// `palpate` itself: touching, drawing and recording.
void addOwnCommands(Command& app);
void addServeFamily(Command& app);
void addReportFamily(Command& app);
/// With `run`, whose window measures photographs too.
void addMeasureFamily(Command& app);
void addTeachFamily(Command& app);
void addStudyFamily(Command& app);

// Top level.
void addRunCommand(Command& app);
void addSimulateCommand(Command& app);
void addRenderCommand(Command& app);
void addDevicesCommand(Command& app);
void addMeasureCommand(Command& app);
void addTrainCommand(Command& app);
void addClassCommand(Command& app);
void addStudyCommand(Command& app);
void addTissueCommand(Command& app);
void addLumpCommand(Command& app);

// For `palpate body`. Commands for bodies and recordings are in both.
void addModelCommand(Command& body);
void addFitBodyCommand(Command& body);
void addRepairCommand(Command& group);
void addInfoCommand(Command& group);
void addMapCommand(Command& body);

// For `palpate recording`.
void addRecordCommand(Command& recording);
void addRecordingsCommand(Command& recording);
void addReplayCommand(Command& recording);
void addTrimCommand(Command& recording);
void addJoinCommand(Command& recording);
void addAnnotateCommand(Command& recording);
void addBundleCommand(Command& recording);
void addExportCommand(Command& recording);
void addPlotCommand(Command& recording);
void addReportCommand(Command& recording);

// For `palpate measure`.
void addMeasureAverageCommand(Command& measure);
void addMeasureDotsCommand(Command& measure);
void addMeasureSessionCommand(Command& measure);
void addMeasureStencilCommand(Command& measure);
void addMeasureStiffnessCommand(Command& measure);
void addMeasureSynthesizeCommand(Command& measure);

// For `palpate train`.
void addResultsCommand(Command& train);

// For `palpate study`.
void addCredibilityCommand(Command& study);
void addPartitionCommand(Command& study);
void addHuntCommand(Command& study);
void addBenchCommand(Command& study);
void addBenchBatchCommand(Command& bench);
void addBenchContactCommand(Command& bench);
void addBenchDeformCommand(Command& bench);
void addBenchEditCommand(Command& bench);
void addBenchFrameCommand(Command& bench);
void addBenchLoadCommand(Command& bench);
void addBenchLumpCommand(Command& bench);
void addBenchPartitionCommand(Command& bench);
void addBenchServoCommand(Command& bench);
void addBenchRecordingCommand(Command& bench);
/// One command per page.
void addStudyPages(Command& study);
/// `palpate study all`.
void addStudyAll(Command& study);

// For `palpate lump`.
void addLumpLoopsCommand(Command& lump);
void addLumpSolveCommand(Command& lump);

// For `palpate tissue`.
void addTissueLibraryCommand(Command& tissue);
void addTissueModuliCommand(Command& tissue);
void addTissueShowCommand(Command& tissue);
void addTissueSolveCommand(Command& tissue);
void addRealismCommand(Command& tissue);
void addFitForceCommand(Command& fit);
void addFitProfileCommand(Command& fit);

}  // namespace palpate::app
