#include "palpate/training/report/trial_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpate::training {

namespace {

/// The normal distribution's quantile for 95 % on two sides.
constexpr double kTwoSided95 = 1.959963984540054;
/// The two columns of the twelve sites.
constexpr int kTwelveSites = 12;
constexpr int kSitesASide = 6;

/// A dwell is a sum of ticks of a millisecond, and must not miss its mark by rounding (exploration.cpp).
constexpr double kHalfTickMs = 0.5;

using Trials = std::span<const ChosenTrial>;

/// Boxes of the histograms: fine enough to see a shape, few enough for a few hundred trials.
constexpr double kForceBox = 0.25;  // N
constexpr int kForceBoxes = 40;
constexpr double kSpeedBox = 10.0;  // mm/s
constexpr int kSpeedBoxes = 30;
constexpr double kSecondsBox = 5.0;
constexpr int kSecondsBoxes = 24;

/// Values of the trials that pass; warm-ups never do.
template <class Passes, class Value>
std::vector<double> valuesWhere(Trials trials, const Passes& passes, const Value& value) {
  std::vector<double> values;
  for (const ChosenTrial& trial : trials) {
    if (trial.row->kind != TrialKind::warm_up && passes(*trial.row)) values.push_back(value(*trial.row));
  }
  return values;
}

Histogram makeHistogram(const std::vector<double>& values, double width, int boxes) {
  Histogram histogram{.width = width, .counts = std::vector<int>(static_cast<std::size_t>(boxes), 0)};
  for (const double value : values) {
    const double box = std::clamp(std::floor(value / width), 0.0, static_cast<double>(boxes - 1));
    ++histogram.counts[static_cast<std::size_t>(box)];
  }
  return histogram;
}

double correctedForChance(double share, double chance) {
  return chance < 1.0 ? (share - chance) / (1.0 - chance) : 0.0;
}

double guessProbability(const TrialRow& trial) { return 1.0 / std::max(trial.sites_felt, 1); }

std::vector<LevelAccuracy> computeLevelAccuracies(Trials trials) {
  std::map<double, LevelAccuracy> levels;
  for (const ChosenTrial& trial : trials) {
    if (!countsForResults(*trial.row)) continue;
    LevelAccuracy& level = levels[trial.row->change];
    ++level.trials;
    level.correct += trial.row->correct ? 1 : 0;
    level.chance += guessProbability(*trial.row);
  }
  std::vector<LevelAccuracy> all;
  for (auto& [change, level] : levels) {
    level.change = change;
    level.share = static_cast<double>(level.correct) / level.trials;
    level.interval = wilsonInterval(level.correct, level.trials);
    level.chance /= level.trials;
    level.corrected = correctedForChance(level.share, level.chance);
    all.push_back(level);
  }
  return all;
}

int mostSites(Trials trials) {
  int sites = 0;
  for (const ChosenTrial& trial : trials) sites = std::max(sites, trial.choices);
  return sites;
}

std::vector<SiteFelt> feltSites(Trials trials) {
  std::vector<SiteFelt> sites(static_cast<std::size_t>(mostSites(trials)));
  std::vector<int> touched(sites.size(), 0);
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].site = static_cast<int>(i) + 1;
  for (const ChosenTrial& trial : trials) {
    if (trial.row->kind == TrialKind::warm_up) continue;
    for (std::size_t i = 0; i < static_cast<std::size_t>(trial.choices); ++i) ++sites[i].trials;
    for (const SiteVisit& visit : trial.row->visits) {
      if (visit.site < 1 || visit.site > trial.choices) continue;
      const auto i = static_cast<std::size_t>(visit.site) - 1;
      ++touched[i];
      sites[i].felt += visit.dwell_ms >= trial.felt_ms - kHalfTickMs ? 1 : 0;
      sites[i].presses += visit.presses;
      sites[i].dwell_s += 1e-3 * visit.dwell_ms;
      sites[i].peak_force_n += visit.peak_force_n;
      sites[i].greatest_force_n = std::max(sites[i].greatest_force_n, visit.peak_force_n);
      sites[i].deepest_mm = std::max(sites[i].deepest_mm, visit.deepest_mm);
    }
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i].presses /= std::max(sites[i].trials, 1);
    sites[i].dwell_s /= std::max(sites[i].trials, 1);
    sites[i].peak_force_n /= std::max(touched[i], 1);
  }
  return sites;
}

SiteAnswers tallyAnswers(Trials trials) {
  SiteAnswers answers{.sites = mostSites(trials), .counts = {}};
  const auto columns = static_cast<std::size_t>(answers.sites) + 1;
  answers.counts.assign(static_cast<std::size_t>(answers.sites) * columns, 0);
  for (const ChosenTrial& trial : trials) {
    const TrialRow& row = *trial.row;
    if (!countsForResults(row) || row.site_true < 1 || row.site_true > answers.sites) continue;
    const bool known = row.site_answer >= 1 && row.site_answer <= answers.sites;
    const auto column = known ? static_cast<std::size_t>(row.site_answer) - 1 : columns - 1;
    ++answers.counts[(static_cast<std::size_t>(row.site_true) - 1) * columns + column];
  }
  return answers;
}

WrongAnswers classifyWrongAnswers(const SiteAnswers& answers) {
  WrongAnswers wrong;
  for (int truth = 1; truth <= answers.sites; ++truth) {
    wrong.none += answers.at(truth, 0);
    for (int answer = 1; answer <= answers.sites; ++answer) {
      if (answer == truth) continue;
      const bool twelve = answers.sites == kTwelveSites;
      const bool same_side = (answer - 1) / kSitesASide == (truth - 1) / kSitesASide;
      int& where = twelve && same_side && std::abs(answer - truth) == 1 ? wrong.beside
                   : twelve && std::abs(answer - truth) == kSitesASide  ? wrong.other_side
                                                                        : wrong.elsewhere;
      where += answers.at(truth, answer);
    }
  }
  return wrong;
}

void countTrials(Trials trials, TrialStatistics& statistics) {
  for (const ChosenTrial& trial : trials) {
    const TrialRow& row = *trial.row;
    ++statistics.shown;
    if (row.kind == TrialKind::warm_up) {
      ++statistics.warm_up;
      continue;
    }
    statistics.timeouts += row.timed_out ? 1 : 0;
    statistics.not_all_felt += row.sites_felt < trial.choices ? 1 : 0;
    if (!countsForResults(row)) {
      ++statistics.excluded;
      continue;
    }
    ++statistics.counted;
    statistics.correct += row.correct ? 1 : 0;
    if (row.kind != TrialKind::easy) continue;
    ++statistics.easy;
    statistics.easy_wrong += row.correct ? 0 : 1;
  }
}

/// Times, forces, speeds.
void measureTrials(Trials trials, TrialStatistics& statistics) {
  const auto all = [](const TrialRow&) { return true; };
  const auto touched = [](const TrialRow& row) { return row.peak_force_n > 0.0; };
  const auto counted_as = [](bool right) {
    return [right](const TrialRow& row) { return countsForResults(row) && row.correct == right; };
  };
  const auto member = [](double TrialRow::*value) { return [value](const TrialRow& row) { return row.*value; }; };
  const auto some = [](double TrialRow::*value) { return [value](const TrialRow& row) { return row.*value > 0.0; }; };
  const auto places = [](const TrialRow& row) { return static_cast<double>(row.sites_felt); };
  const std::vector<double> seconds = valuesWhere(trials, all, member(&TrialRow::seconds));
  const std::vector<double> search =
      valuesWhere(trials, some(&TrialRow::search_force_n), member(&TrialRow::search_force_n));
  const std::vector<double> palpate =
      valuesWhere(trials, some(&TrialRow::palpate_force_n), member(&TrialRow::palpate_force_n));
  const std::vector<double> speed = valuesWhere(trials, touched, member(&TrialRow::mean_speed_mm_per_s));
  statistics.seconds = computeSpread(seconds);
  statistics.seconds_correct = computeSpread(valuesWhere(trials, counted_as(true), member(&TrialRow::seconds)));
  statistics.seconds_wrong = computeSpread(valuesWhere(trials, counted_as(false), member(&TrialRow::seconds)));
  statistics.places_felt = computeSpread(valuesWhere(trials, all, places));
  statistics.mean_force_n = computeSpread(valuesWhere(trials, touched, member(&TrialRow::mean_force_n)));
  statistics.peak_force_n = computeSpread(valuesWhere(trials, touched, member(&TrialRow::peak_force_n)));
  statistics.speed_mm_per_s = computeSpread(speed);
  statistics.search_force_n = computeSpread(search);
  statistics.palpate_force_n = computeSpread(palpate);
  statistics.seconds_bins = makeHistogram(seconds, kSecondsBox, kSecondsBoxes);
  statistics.search_force_bins = makeHistogram(search, kForceBox, kForceBoxes);
  statistics.palpate_force_bins = makeHistogram(palpate, kForceBox, kForceBoxes);
  statistics.speed_bins = makeHistogram(speed, kSpeedBox, kSpeedBoxes);
}

std::vector<AnswerBox> makeAnswerBoxes(Trials trials) {
  std::vector<PlacedAnswer> answers;
  for (const ChosenTrial& trial : trials) {
    if (!countsForResults(*trial.row)) continue;
    answers.push_back(
        {.place = trial.row->change, .correct = trial.row->correct, .chance = guessProbability(*trial.row)});
  }
  return answerBoxes(answers, {});
}

}  // namespace

bool countsForResults(const TrialRow& trial) {
  return trial.kind != TrialKind::warm_up && exclusionReason(trial).empty();
}

std::string exclusionReason(const TrialRow& trial) {
  if (trial.kind == TrialKind::warm_up) return {};
  if (!trial.excluded.empty()) return trial.excluded;
  return trial.sites_felt < 2 ? "fewer than two places felt" : "";  // as a block has it: nothing to compare with
}

double sortedQuantile(std::span<const double> sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Spread computeSpread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {.count = values.size(),
          .mean = sum / static_cast<double>(values.size()),
          .least = values.front(),
          .lower_quartile = sortedQuantile(values, 0.25),
          .median = sortedQuantile(values, 0.5),
          .upper_quartile = sortedQuantile(values, 0.75),
          .greatest = values.back()};
}

ShareInterval wilsonInterval(int part, int whole) {
  const double n = whole;
  const double p = part / n;
  const double z2 = kTwoSided95 * kTwoSided95;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = kTwoSided95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

std::vector<AnswerBox> answerBoxes(std::span<const PlacedAnswer> answers, const BoxScale& scale) {
  const double width = std::log(scale.to / scale.from) / scale.boxes;
  std::vector<AnswerBox> boxes(static_cast<std::size_t>(scale.boxes));
  for (const PlacedAnswer& answer : answers) {
    const double place = std::log(answer.place / scale.from) / width;
    if (!(place >= 0.0 && place < scale.boxes)) continue;
    AnswerBox& box = boxes[static_cast<std::size_t>(place)];
    ++box.trials;
    box.correct += answer.correct ? 1 : 0;
    box.middle += std::log(answer.place);
    box.chance += answer.chance;
    box.expected += answer.expected;
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    AnswerBox& box = boxes[i];
    if (box.trials == 0) continue;
    box.from = scale.from * std::exp(width * static_cast<double>(i));
    box.to = scale.from * std::exp(width * static_cast<double>(i + 1));
    box.share = static_cast<double>(box.correct) / box.trials;
    box.interval = wilsonInterval(box.correct, box.trials);
    box.middle = std::exp(box.middle / box.trials);
    box.chance /= box.trials;
    box.expected /= box.trials;
    box.corrected = correctedForChance(box.share, box.chance);
  }
  std::erase_if(boxes, [](const AnswerBox& box) { return box.trials == 0; });
  return boxes;
}

int SiteAnswers::at(int site_true, int answer) const {
  const int column = answer == 0 ? sites : answer - 1;
  return counts[static_cast<std::size_t>(site_true - 1) * static_cast<std::size_t>(sites + 1) +
                static_cast<std::size_t>(column)];
}

int SiteAnswers::of(int site_true) const {
  int sum = 0;
  for (int answer = 0; answer <= sites; ++answer) sum += at(site_true, answer);
  return sum;
}

TrialStatistics trialStatistics(std::span<const ChosenTrial> trials) {
  TrialStatistics statistics;
  countTrials(trials, statistics);
  statistics.levels = computeLevelAccuracies(trials);
  statistics.boxes = makeAnswerBoxes(trials);
  statistics.felt = feltSites(trials);
  statistics.answers = tallyAnswers(trials);
  statistics.wrong = classifyWrongAnswers(statistics.answers);
  measureTrials(trials, statistics);
  return statistics;
}

}  // namespace palpate::training
