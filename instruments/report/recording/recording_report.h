// A recording as a report: its numbers, the body with what was felt on it, and their presentation.
//
//   RecordingReader ─► trace::measure ─┐
//   world ─► engine::builtWorld ─────┴─► RecordingReport ─► reportJson, reportPage (with pictures of report_figures.h)
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/body/torso.h"
#include "palpate/trace/recording_statistics.h"

namespace palpate::app {

/// The touched skin, or why it cannot be shown.
struct ReportBody {
  std::string name;  ///< name of the body that was touched longest; empty: none was
  std::optional<trace::TouchedSurface> surface;
  std::string tissue;                         ///< its tissue and force law as text; empty: it cannot be built
  std::string why_not;                        ///< a sentence; empty where there is a surface, or nothing was touched
  std::vector<std::string> notes;             ///< further sentences about the map
  std::vector<double> reach_mm;               ///< per finger, as the maps have it
  std::vector<body::SkinLandmark> landmarks;  ///< if one body was touched; empty: several, or it has no names
};

struct RecordingReport {
  std::filesystem::path file;
  trace::RecordingFacts facts;
  bool whole = true;  ///< false: only the part between --from and --to
  trace::RecordingStatistics statistics;
  std::vector<trace::RecordingEvent> events;
  std::vector<std::string> unsafe;  ///< fingers that felt more than is safe, with their limits; usually empty
  std::vector<std::string> bodies;  ///< per world that was felt, in the order of statistics.worlds
  ReportBody body;

  double secondsAt(std::uint64_t tick) const { return static_cast<double>(tick) / statistics.ticks_per_s; }
};

struct ReportSettings {
  std::filesystem::path file;
  /// Present place of the files that the scene names; empty: in the recording itself, else their recorded place.
  std::filesystem::path folder;
  trace::TickSpan span;
};

/// Throws Error for a file that is not a recording and for a damaged block; the report names a body that cannot be
/// built.
RecordingReport recordingReport(trace::RecordingReader& recording, const ReportSettings& settings,
                                const Progress& progress);

/// Every number of the report.
Json reportJson(const RecordingReport& report);

/// The report's main results, in sentences.
std::vector<std::string> reportSentences(const RecordingReport& report);

/// One HTML page that needs nothing else, well-formed. Draws its pictures.
std::string reportPage(const RecordingReport& report, const Progress& progress);
/// Stands in every page, near its beginning.
inline constexpr std::string_view kReportMark = "<meta name=\"generator\" content=\"palpate report\" />";

/// A bit of a status that was set in some ticks of a finger.
struct StatusLine {
  std::size_t finger = 0;
  std::string name;
  std::string_view meaning;
  trace::BitTally tally;
};
/// Actions of the limiter, and states of contact: finger by finger, bit by bit.
std::vector<StatusLine> safetyLines(const RecordingReport& report);
std::vector<StatusLine> contactLines(const RecordingReport& report);
/// Number of emergency stops: the largest of all fingers.
std::uint64_t emergencyStops(const RecordingReport& report);

/// 3725.4 -> "1 h 02 min 05 s", 12.34 -> "12.3 s".
std::string formatDuration(double seconds);
/// With `decimals` digits behind the point; a very large number, or one that is not finite, in short form.
std::string formatFixed(double value, int decimals);
/// "search", in the language of the page.
std::string_view phaseWord(trace::Phase phase);

}  // namespace palpate::app
