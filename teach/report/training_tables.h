// The tables of a training report, as they stand in its page; empty where there is nothing to tell.
#pragma once

#include <string>

#include "teach/report/training_report.h"

namespace palpate::app {

/// What the numbers are of: file, class, times, devices, protocols, versions.
std::string trainingFacts(const TrainingReport& report);

/// Every block of a trainee with its result.
std::string blocksTable(const training::TraineeStatistics& trainee);
/// Fitted slope and lapse of blocks with a threshold.
std::string fitsTable(const training::TraineeStatistics& trainee);
std::string occasionsTable(const training::ClassStatistics& all);
/// A row a trainee of a class.
std::string traineesTable(const training::TrainingStatistics& statistics);

std::string levelsTable(const training::TrialStatistics& trials, const std::string& what);
/// `set`: the names of the sites; may be empty.
std::string sitesTable(const training::TrialStatistics& trials, const training::SiteSet& set, const std::string& what);
/// Force, speed, time: tests beside practice.
std::string handlingTable(const training::TrialStatistics& tests, const training::TrialStatistics& practice);
std::string secondsTable(const training::TrialStatistics& tests, const training::TrialStatistics& practice);
std::string answersTable(const training::TrialStatistics& trials, const std::string& what);
std::string qualitySection(const TrainingReport& report);

/// A heading that opens what lies below it.
std::string foldedHtml(const std::string& heading, const std::string& html);

}  // namespace palpate::app
