// Published examinations of lumps in silicone, repeated by simulated trainees whose finger is the engine's.
//
//   layers, solved ─ LumpSheet with a lump each ─┬─ strokes at every distance ─ fittedObserver ─► LumpObserver
//                                                └─ strokes of trainees ─► found or not ─► compared with print
//
// Numbers that are printed are those of the studies that docs/explanation/lumps.md names.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/lumps/lump_observer.h"
#include "report/page/study_page.h"

namespace palpate::study {

/// A set of silicone breasts: every size with every hardness at every depth. Sizes are printed, the rest is assumed.
struct SiliconeSet {
  std::array<double, 3> diameters_mm = {3.0, 5.0, 10.0};
  std::array<double, 3> young_kpa = {40.0, 90.0, 200.0};
  std::array<double, 2> centres_mm = {8.0, 12.0};
  double matrix_kpa = 12.0;
  double skin_mm = 1.5;
  double skin_kpa = 100.0;
  double press_n = 3.1;  ///< 12 mm deep
};

/// Which lumps of a set a figure is the mean of: indices into its arrays; kAll: every one.
struct LumpsOfSet {
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  std::size_t size = kAll;
  std::size_t hardness = kAll;
  std::size_t depth = kAll;
};

struct DetectionFigure {
  std::string name;      ///< for programs
  std::string words;     ///< for people
  double printed = 0.0;  ///< %; NaN: no number is printed
  bool fitted = false;   ///< the observer's numbers are chosen so that this comes out
  LumpsOfSet lumps = {};
  double expected = 0.0;  ///< %, of a large group
  double found = 0.0;     ///< %, by the trainees
  double low = 0.0;       ///< 95 % interval of it, over people
  double high = 0.0;
};

struct ExaminedGroup {
  std::string name;  ///< for programs
  std::string words;
  lumps::LumpObserver observer = {};
  std::vector<DetectionFigure> figures;
  double expected_mean = 0.0;        ///< %, of all lumps, in a large group
  double expected_easiest = 0.0;     ///< %, of the largest hard ones
  double expected_hardest = 0.0;     ///< %, of the smallest soft ones
  double force_only_mean = 0.0;      ///< %, for the same observer without the pattern
  double force_only_smallest = 0.0;  ///< %, for lumps of 0.3 cm

  /// Throws Error for a name that there is not.
  const DetectionFigure& figure(std::string_view name_of) const;
  /// Largest error of the trainees against printed values that were not fitted, points.
  double worstPoints() const;
};

/// Two presses, one over a lump (or over the larger): which?
struct TwoPresses {
  std::string name;  ///< for programs
  std::string words;
  std::size_t taxels = 0;
  double printed = 0.0;  ///< %; NaN: none
  double d_prime = 0.0;
  double expected = 0.0;  ///< %
  double found = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The six figures of the later study if something that is assumed were otherwise, fitted again.
struct AssumedOtherwise {
  std::string words;
  lumps::LumpObserver observer = {};
  std::vector<double> expected;  ///< as ExaminedGroup::figures
};

/// The cue for a finger right over a lump.
struct CueRow {
  double diameter_mm = 0.0;
  double young_kpa = 0.0;
  std::array<lumps::LumpCue, 2> by_depth;
};

struct LumpPlan {
  std::size_t people = 1000;  ///< in each group
  std::uint64_t seed = 1;
  bool otherwise = true;  ///< whether the assumptions are varied
};
LumpPlan lumpPlan(const StudySettings& settings);

struct LumpMeasurement {
  // Points that predicted figures may be off by. Those of 1985 are of one study that is known by its abstract.
  static constexpr double kLaterBarPoints = 5.0;
  static constexpr double k1985BarPoints = 10.0;
  LumpPlan plan;
  SiliconeSet set{};
  std::vector<ExaminedGroup> groups{};  ///< the later study, that of 1985
  std::vector<TwoPresses> detection{};  ///< force alone, 2 x 2, 4 x 4, 8 x 8 taxels
  std::vector<TwoPresses> sizes{};      ///< 5 or 7 mm: force alone, 4 x 4
  std::vector<AssumedOtherwise> otherwise{};
  std::vector<CueRow> cues{};
};

/// The same for any number of threads.
LumpMeasurement measureLumps(const LumpPlan& plan, const Progress& progress);

/// Sentences whose verdicts their numbers decide.
std::vector<std::string> lumpFindings(const LumpMeasurement& found);

// `palpate study lumps`: what people find, by force alone and by the pattern under a fingertip.

Study lumpStudy();

}  // namespace palpate::study
