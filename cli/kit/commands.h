// The command line of `palpate`, of the programs that it starts (families.h) and of palpate_peers: how it is run, and
// the subcommands. Each of these lives in a file of its own, adds itself to the command line or to its group, and runs
// when chosen.
#pragma once

#include <string>
#include <vector>

#include "cli/kit/cli11.h"

namespace palpate::app {

/// Commands that were called otherwise in the last release get their present names, and it is said.
std::vector<std::string> withPresentCommand(std::vector<std::string> words);

/// Parses a command line, runs what was chosen, and turns every error into one line and an exit code.
/// 0: done; 1: the command ran and its answer is "no" (a check that failed); 2: wrong input or usage, said in one line
/// on the standard error, also when the standard output cannot be written; 128 and the signal's number when a signal
/// asked for the end (interruption.h).
int runCommandLine(CLI::App& app, const std::vector<std::string>& words);

/// `palpate body`, `palpate recording`: made by whoever asks first.
CLI::App& commandGroup(CLI::App& app, const std::string& name);

// The commands of each program.

/// `palpate` itself: what touches, draws and records.
void addOwnCommands(CLI::App& app);
void addServeFamily(CLI::App& app);
void addReportFamily(CLI::App& app);
/// With `run`, whose window measures photographs too.
void addMeasureFamily(CLI::App& app);
void addTeachFamily(CLI::App& app);
void addStudyFamily(CLI::App& app);

// Of the top.
void addRunCommand(CLI::App& app);
void addSimulateCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addDevicesCommand(CLI::App& app);
void addMeasureCommand(CLI::App& app);
void addTrainCommand(CLI::App& app);
void addClassCommand(CLI::App& app);
void addStudyCommand(CLI::App& app);
void addTissueCommand(CLI::App& app);
void addLumpCommand(CLI::App& app);

// Of `palpate body`. What is of bodies and recordings stands in both.
void addModelCommand(CLI::App& body);
void addFitBodyCommand(CLI::App& body);
void addRepairCommand(CLI::App& group);
void addInfoCommand(CLI::App& group);
void addMapCommand(CLI::App& body);

// Of `palpate recording`.
void addRecordCommand(CLI::App& recording);
void addRecordingsCommand(CLI::App& recording);
void addReplayCommand(CLI::App& recording);
void addTrimCommand(CLI::App& recording);
void addJoinCommand(CLI::App& recording);
void addAnnotateCommand(CLI::App& recording);
void addBundleCommand(CLI::App& recording);
void addExportCommand(CLI::App& recording);
void addPlotCommand(CLI::App& recording);
void addReportCommand(CLI::App& recording);

// Of `palpate measure`.
void addMeasureAverageCommand(CLI::App& measure);
void addMeasureDotsCommand(CLI::App& measure);
void addMeasureSessionCommand(CLI::App& measure);
void addMeasureStencilCommand(CLI::App& measure);
void addMeasureStiffnessCommand(CLI::App& measure);
void addMeasureSynthesizeCommand(CLI::App& measure);

// Of `palpate train`.
void addResultsCommand(CLI::App& train);

// Of `palpate study`.
void addCredibilityCommand(CLI::App& study);
void addPartitionCommand(CLI::App& study);
void addHuntCommand(CLI::App& study);
void addBenchCommand(CLI::App& study);
void addBenchBatchCommand(CLI::App& bench);
void addBenchContactCommand(CLI::App& bench);
void addBenchDeformCommand(CLI::App& bench);
void addBenchEditCommand(CLI::App& bench);
void addBenchFrameCommand(CLI::App& bench);
void addBenchLoadCommand(CLI::App& bench);
void addBenchLumpCommand(CLI::App& bench);
void addBenchPartitionCommand(CLI::App& bench);
void addBenchServoCommand(CLI::App& bench);
void addBenchRecordingCommand(CLI::App& bench);
/// A page each.
void addStudyPages(CLI::App& study);
/// `palpate study all`.
void addStudyAll(CLI::App& study);

// Of `palpate lump`.
void addLumpLoopsCommand(CLI::App& lump);
void addLumpSolveCommand(CLI::App& lump);

// Of `palpate tissue`.
void addTissueLibraryCommand(CLI::App& tissue);
void addTissueModuliCommand(CLI::App& tissue);
void addTissueShowCommand(CLI::App& tissue);
void addTissueSolveCommand(CLI::App& tissue);
void addRealismCommand(CLI::App& tissue);
void addFitForceCommand(CLI::App& fit);
void addFitProfileCommand(CLI::App& fit);

}  // namespace palpate::app
