// The command line of `palpate` (and of palpate_peers): how it is run, and its subcommands. Each of these lives in a
// file of its own, adds itself to the command line and runs when chosen.
#pragma once

#include <CLI/CLI.hpp>

namespace palpate::app {

/// Parses a command line, runs what was chosen, and turns every error into one line and an exit code.
/// 0: done; 1: the command ran and its answer is "no" (a check that failed); 2: wrong input or usage, said in one line
/// on the standard error, also when the standard output cannot be written; 128 and the signal's number when a signal
/// asked for the end (interruption.h).
int runCommandLine(CLI::App& app, int argc, char** argv);

/// Studies of the products that are built apart, for `palpate study`: before its commands are added.
void offerMeasuringStudies();
void offerTrainingStudies();
/// And of modes for the window of `palpate run`.
void offerMeasuringMode();

/// All subcommands of `palpate`.
void addAllCommands(CLI::App& app);

void addAnnotateCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);
// `parent` is the bench command.
void addBenchContactCommand(CLI::App& parent);
void addBenchDeformCommand(CLI::App& parent);
void addBenchFrameCommand(CLI::App& parent);
void addBenchPartitionCommand(CLI::App& parent);
void addBundleCommand(CLI::App& app);
void addClassCommand(CLI::App& app);
void addDevicesCommand(CLI::App& app);
void addExportCommand(CLI::App& app);
void addFitBodyCommand(CLI::App& app);
void addFitCommand(CLI::App& app);
// `parent` is the fit command.
void addFitForceCommand(CLI::App& parent);
void addFitProfileCommand(CLI::App& parent);
void addHuntCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addJoinCommand(CLI::App& app);
void addMapCommand(CLI::App& app);
void addMeasureCommand(CLI::App& app);
// `parent` is the measure command.
void addMeasureAverageCommand(CLI::App& parent);
void addMeasureDotsCommand(CLI::App& parent);
void addMeasureSessionCommand(CLI::App& parent);
void addMeasureStencilCommand(CLI::App& parent);
void addMeasureStiffnessCommand(CLI::App& parent);
void addMeasureSynthesizeCommand(CLI::App& parent);
void addModelCommand(CLI::App& app);
void addPartitionCommand(CLI::App& app);
void addPlotCommand(CLI::App& app);
void addSimulateCommand(CLI::App& app);
void addRealismCommand(CLI::App& app);
void addRecordCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addRepairCommand(CLI::App& app);
void addReplayCommand(CLI::App& app);
void addReportCommand(CLI::App& app);
void addResultsCommand(CLI::App& app);
void addServeCommand(CLI::App& app);
void addSessionsCommand(CLI::App& app);
void addTrainCommand(CLI::App& app);
void addTrimCommand(CLI::App& app);
void addStudyCommand(CLI::App& app);
// `parent` is the study command.
void addStudyPages(CLI::App& parent);
/// `palpate study all`.
void addStudyAll(CLI::App& parent);
void addRunCommand(CLI::App& app);
void addTissueCommand(CLI::App& app);
// `parent` is the tissue command.
void addTissueLibraryCommand(CLI::App& parent);
void addTissueModuliCommand(CLI::App& parent);
void addTissueShowCommand(CLI::App& parent);
void addTissueSolveCommand(CLI::App& parent);

}  // namespace palpate::app
