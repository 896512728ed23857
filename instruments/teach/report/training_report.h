// A records file as a report of training: of one trainee or of a class.
//
//   Store ─ trainingReport ─► TrainingReport ─► trainingReportJson, trainingReportPage (pictures: training_figures.h)
//
// A records file holds no names; a trainee is called by the first letters of the pseudonym, or by the code if the user
// typed it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/training/report/lump_statistics.h"
#include "palpate/training/report/training_statistics.h"
#include "palpate/training/site.h"

namespace palpate::app {

struct TrainingReportSettings {
  std::filesystem::path file;
  std::string trainee;       ///< a code, or a pseudonym or its beginning; empty: the class
  std::string only_class;    ///< its word; empty: all
  bool whole_class = false;  ///< also where there is but one trainee
};

/// The back that coverage is drawn on, with the sites on it.
struct ReportBack {
  mesh::TriangleMesh skin;
  training::SiteSet sites;
};

struct TrainingReport {
  std::filesystem::path file;
  bool of_class = false;
  std::string name;  ///< the trainee's name, as it may be shown
  std::string class_words;
  training::TrainingRecord record;
  training::TrainingStatistics statistics;  ///< for the trainee alone, or for all
  /// A trainee's report: the class's occasions, where enough others were there.
  std::vector<training::Occasion> others;
  std::vector<training::LumpGroup> lumps;  ///< for the same trainees
};

/// Throws Error if the file is not a records file or does not hold the trainee or class.
TrainingReport trainingReport(const TrainingReportSettings& settings, const Progress& progress);

/// Every number of the report.
Json trainingReportJson(const TrainingReport& report);

/// The report's main results, one sentence per result.
std::vector<std::string> trainingSentences(const TrainingReport& report);

/// One HTML page that needs nothing else, well-formed, with all numbers as JSON in it. Draws its pictures.
std::string trainingPage(const TrainingReport& report, const Progress& progress);

/// Limits of the numbers here, in English, for tr().
inline constexpr const char* kNotShown = toTranslate(
    "These numbers show how small a difference of stiffness a trainee finds on this simulator, with this device. They "
    "do not show skill on patients: whether it carries over has not been tested yet.");

/// A trainee may see quartiles of others' results only where at least this many keep each from being recognised.
inline constexpr int kMinOthers = 5;

/// "pre-test", "practice 3".
std::string occasionName(training::SessionKind kind, int nth);
/// Where a cell of a table has nothing to say.
inline constexpr const char* kNoValue = "–";
/// "not yet".
std::string verdictName(training::Verdict verdict);
/// "compliance".
std::string changeMeaningName(training::ChangeMeaning meaning);
/// 018f3c1e-... -> "018f3c1e".
std::string shortPseudonym(const training::Uuid& id);
/// 0.1834 -> "18 %", 0.0734 -> "7.3 %".
std::string formatChange(double change);
/// "18 % (13 to 25 %)".
std::string formatThreshold(const training::ThresholdSummary& threshold);
/// 1763853600000 -> "2025-11-22".
std::string formatDay(std::int64_t utc_ms);

// The tables of a training report, as in its page; empty without data.

/// Source of the numbers: file, class, times, devices, protocols, versions.
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
/// Force and speed, or time (TrialMeasure::of_touch).
std::string measuresTable(const training::TrialStatistics& tests, const training::TrialStatistics& practice,
                          bool of_touch);
std::string answersTable(const training::TrialStatistics& trials, const std::string& what);
std::string qualitySection(const TrainingReport& report);

// Sections about sessions with lumps; empty without any.

std::string lumpSections(const TrainingReport& report);
std::vector<std::string> lumpSentences(const TrainingReport& report);
Json lumpGroupsJson(const TrainingReport& report);

/// A heading that unfolds its section.
std::string foldedHtml(const std::string& heading, const std::string& html);

}  // namespace palpate::app
