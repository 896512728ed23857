// Trials counted: how often right at which change, which site was taken for which, how long, how hard and how fast, and
// which places were felt. Of one trainee or of many: it is the same counting.
//
// Every number can be had again from the exported table of trials and visits by plain counting (tools/check_report.py
// does): quantiles lie between neighbours on a straight line, intervals of shares are Wilson's.
// Based on: Wilson, J. Am. Stat. Assoc. 22:209, 1927.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "palpate/training/records/rows.h"

namespace palpate::training {

/// A trial with the number of places that its block asked about.
struct ChosenTrial {
  const TrialRow* row = nullptr;
  int choices = 12;
  double felt_ms = 300.0;  ///< a place counts as felt when it was pressed so long (ExplorationSettings)
};

/// Neither a warm-up nor left out: it informs about the trainee.
bool countsForResults(const TrialRow& trial);
/// Why a trial other than a warm-up does not count; empty: it counts.
std::string exclusionReason(const TrialRow& trial);

/// Summary of a set of values; all 0 where there are none.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0, least = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, greatest = 0.0;
};
Spread computeSpread(std::vector<double> values);

/// The 95 % interval of the share `part` / `whole`; `whole` > 0.
struct ShareInterval {
  double low = 0.0, high = 1.0;
};
ShareInterval wilsonInterval(int part, int whole);

/// Right ones of the answers, lumps found of those hidden.
struct Rate {
  int part = 0;
  int whole = 0;
  void count(bool is_part) {
    ++whole;
    part += is_part ? 1 : 0;
  }
  double share() const { return whole > 0 ? static_cast<double>(part) / whole : 0.0; }
  ShareInterval interval() const { return whole > 0 ? wilsonInterval(part, whole) : ShareInterval{}; }
};

/// An answer to a change (or to a change in units of something), and how often such answers are expected to be right.
struct PlacedAnswer {
  double place = 0.0;
  bool correct = false;
  double chance = 0.0;    ///< 1 / places felt
  double expected = 0.0;  ///< by a fitted function, if any
};

/// Answers in a box [from, to) of places, or at one place.
struct AnswerBox {
  double from = 0.0, to = 0.0;
  double middle = 0.0;  ///< geometric mean of the places
  Rate right = {};
  double chance = 0.0, expected = 0.0;  ///< means
  double corrected() const;             ///< (share - chance) / (1 - chance): 0 for a guesser
};

/// Boxes between two places, even on a logarithmic scale; leaves out values outside, and empty boxes.
struct BoxScale {
  double from = 0.03, to = 1.0 + 1e-9;  ///< all changes: 100 % too
  int boxes = 10;
};
std::vector<AnswerBox> answerBoxes(std::span<const PlacedAnswer> answers, const BoxScale& scale);

/// Counts of values in boxes of this width from 0; the last box also has all that is more.
struct Histogram {
  double width = 1.0;
  std::vector<int> counts;
};

struct SiteFelt {
  int site = 0;
  int trials = 0;           ///< in which it could have been felt: warm-ups left out
  int felt = 0;             ///< trials in which it was pressed hard and long enough
  double presses = 0.0;     ///< a trial, on average over all
  double dwell_s = 0.0;     ///< the same
  double peak_force_n = 0;  ///< mean over the trials that touched it
  double greatest_force_n = 0.0;
  double deepest_mm = 0.0;
};

/// Rows: the true site; columns: the answer, and last none.
struct SiteAnswers {
  int sites = 0;
  std::vector<int> counts;
  int at(int site_true, int answer) const;  ///< from 1; answer 0: none
  int of(int site_true) const;              ///< all answers
};

/// Where wrong answers went, of the twelve sites in two columns (1 to 6, 7 to 12).
struct WrongAnswers {
  int beside = 0;      ///< the next level of the same side
  int other_side = 0;  ///< the same level
  int elsewhere = 0;
  int none = 0;  ///< time was over
};

struct TrialStatistics {
  // Trials put to the trainee (trialCounts).
  int shown = 0;
  int warm_up = 0;
  int excluded = 0;
  int counted = 0;
  int correct = 0;       ///< counted trials that were right
  int timeouts = 0;      ///< warm-ups left out
  int not_all_felt = 0;  ///< fewer places felt than there are, warm-ups left out
  int easy = 0;          ///< counted ones at the top level, that only a lapse can miss
  int easy_wrong = 0;
  std::vector<AnswerBox> levels;  ///< each change, rising
  std::vector<AnswerBox> boxes;   ///< the same, neighbours together
  std::vector<SiteFelt> felt;     ///< each site
  SiteAnswers answers;            ///< answers in the counted trials
  WrongAnswers wrong;
  // Over trials other than warm-ups (trialMeasures).
  Spread seconds, seconds_correct, seconds_wrong;
  Spread places_felt;
  Spread mean_force_n, peak_force_n, speed_mm_per_s;
  Spread search_force_n, palpate_force_n;  ///< trials with any search, with any palpation
  Histogram seconds_bins, search_force_bins, palpate_force_bins, speed_bins;
};

TrialStatistics trialStatistics(std::span<const ChosenTrial> trials);

/// A count of trials, described once.
struct TrialCount {
  const char* name;  ///< in JSON
  int TrialStatistics::*count;
  const char* words = nullptr;  ///< in the table of checks, in English, for tr(); null: not in it
};
std::span<const TrialCount> trialCounts();

/// A number that trials have, summarised over those that pass, described once.
struct TrialMeasure {
  const char* name;  ///< in JSON
  Spread TrialStatistics::*spread;
  const char* words;  ///< in a table, in English, for tr()
  int decimals;
  bool of_touch;  ///< how the skin was touched; else how long it took
  bool (*passes)(const TrialRow&);
  double (*value)(const TrialRow&);
  // The histogram, where it has one: boxes fine enough to see a shape, few enough for a few hundred trials.
  const char* histogram_name = nullptr;  ///< in JSON
  Histogram TrialStatistics::*histogram = nullptr;
  double box_width = 0.0;
  int boxes = 0;
};
std::span<const TrialMeasure> trialMeasures();

}  // namespace palpate::training
