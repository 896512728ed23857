#include "palpate/training/report/trial_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/order_statistics.h"

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

template <double TrialRow::*Value>
double valueOf(const TrialRow& row) {
  return row.*Value;
}
double placesFelt(const TrialRow& row) { return row.sites_felt; }

bool isAny(const TrialRow&) { return true; }
bool isTouched(const TrialRow& row) { return row.peak_force_n > 0.0; }
bool isCountedRight(const TrialRow& row) { return countsForResults(row) && row.correct; }
bool isCountedWrong(const TrialRow& row) { return countsForResults(row) && !row.correct; }
bool hasSearched(const TrialRow& row) { return row.search_force_n > 0.0; }
bool hasPalpated(const TrialRow& row) { return row.palpate_force_n > 0.0; }

constexpr std::array kTrialCounts = {
    TrialCount{"shown", &TrialStatistics::shown, toTranslate("trials shown")},
    TrialCount{"warm_up", &TrialStatistics::warm_up, toTranslate("warm-up, not counted")},
    TrialCount{"excluded", &TrialStatistics::excluded, toTranslate("left out")},
    TrialCount{"counted", &TrialStatistics::counted, toTranslate("counted")},
    TrialCount{"correct", &TrialStatistics::correct},
    TrialCount{"timeouts", &TrialStatistics::timeouts, toTranslate("no answer in time")},
    TrialCount{"not_all_felt", &TrialStatistics::not_all_felt, toTranslate("not all places felt")},
    TrialCount{"easy", &TrialStatistics::easy, toTranslate("easy trials (lapse check)")},
    TrialCount{"easy_wrong", &TrialStatistics::easy_wrong, toTranslate("of them wrong")}};

/// In the order of the tables.
constexpr std::array kTrialMeasures = {
    TrialMeasure{"seconds", &TrialStatistics::seconds, toTranslate("time (s)"), 1, false, isAny,
                 valueOf<&TrialRow::seconds>, "seconds_boxes", &TrialStatistics::seconds_bins, 5.0, 24},
    TrialMeasure{"seconds_correct", &TrialStatistics::seconds_correct, toTranslate("time of right answers (s)"), 1,
                 false, isCountedRight, valueOf<&TrialRow::seconds>},
    TrialMeasure{"seconds_wrong", &TrialStatistics::seconds_wrong, toTranslate("time of wrong answers (s)"), 1, false,
                 isCountedWrong, valueOf<&TrialRow::seconds>},
    TrialMeasure{"places_felt", &TrialStatistics::places_felt, toTranslate("places felt"), 0, false, isAny, placesFelt},
    TrialMeasure{"search_force_n", &TrialStatistics::search_force_n, toTranslate("mean force while searching (N)"), 2,
                 true, hasSearched, valueOf<&TrialRow::search_force_n>, "search_force_boxes",
                 &TrialStatistics::search_force_bins, 0.25, 40},
    TrialMeasure{"palpate_force_n", &TrialStatistics::palpate_force_n, toTranslate("mean force while palpating (N)"), 2,
                 true, hasPalpated, valueOf<&TrialRow::palpate_force_n>, "palpate_force_boxes",
                 &TrialStatistics::palpate_force_bins, 0.25, 40},
    TrialMeasure{"mean_force_n", &TrialStatistics::mean_force_n, toTranslate("mean force in contact (N)"), 2, true,
                 isTouched, valueOf<&TrialRow::mean_force_n>},
    TrialMeasure{"peak_force_n", &TrialStatistics::peak_force_n, toTranslate("peak force (N)"), 2, true, isTouched,
                 valueOf<&TrialRow::peak_force_n>},
    TrialMeasure{"speed_mm_per_s", &TrialStatistics::speed_mm_per_s, toTranslate("mean speed (mm/s)"), 0, true,
                 isTouched, valueOf<&TrialRow::mean_speed_mm_per_s>, "speed_boxes", &TrialStatistics::speed_bins, 10.0,
                 30}};

Histogram makeHistogram(const std::vector<double>& values, double width, int boxes) {
  Histogram histogram{.width = width, .counts = std::vector<int>(static_cast<std::size_t>(boxes), 0)};
  for (const double value : values) {
    const double box = std::clamp(std::floor(value / width), 0.0, static_cast<double>(boxes - 1));
    ++histogram.counts[static_cast<std::size_t>(box)];
  }
  return histogram;
}

std::vector<PlacedAnswer> placedAnswers(Trials trials) {
  std::vector<PlacedAnswer> answers;
  for (const ChosenTrial& trial : trials) {
    if (!countsForResults(*trial.row)) continue;
    answers.push_back({.place = trial.row->change,
                       .correct = trial.row->correct,
                       .chance = 1.0 / std::max(trial.row->sites_felt, 1)});
  }
  return answers;
}

/// Sums, until finishBox().
void addAnswer(AnswerBox& box, const PlacedAnswer& answer) {
  box.right.count(answer.correct);
  box.middle += std::log(answer.place);
  box.chance += answer.chance;
  box.expected += answer.expected;
}

void finishBox(AnswerBox& box, double from, double to) {
  box.from = from;
  box.to = to;
  box.middle = std::exp(box.middle / box.right.whole);
  box.chance /= box.right.whole;
  box.expected /= box.right.whole;
}

std::vector<AnswerBox> answersByChange(std::span<const PlacedAnswer> answers) {
  std::map<double, AnswerBox> levels;
  for (const PlacedAnswer& answer : answers) addAnswer(levels[answer.place], answer);
  std::vector<AnswerBox> all;
  for (auto& [change, level] : levels) {
    finishBox(level, change, change);
    level.middle = change;  // to the bit
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

/// Times, forces, speeds; warm-ups are left out.
void measureTrials(Trials trials, TrialStatistics& statistics) {
  for (const TrialMeasure& measure : kTrialMeasures) {
    std::vector<double> values;
    for (const ChosenTrial& trial : trials) {
      if (trial.row->kind != TrialKind::warm_up && measure.passes(*trial.row))
        values.push_back(measure.value(*trial.row));
    }
    if (measure.histogram != nullptr) {
      statistics.*measure.histogram = makeHistogram(values, measure.box_width, measure.boxes);
    }
    statistics.*measure.spread = computeSpread(std::move(values));
  }
}

}  // namespace

std::span<const TrialCount> trialCounts() { return kTrialCounts; }

std::span<const TrialMeasure> trialMeasures() { return kTrialMeasures; }

bool countsForResults(const TrialRow& trial) {
  return trial.kind != TrialKind::warm_up && exclusionReason(trial).empty();
}

std::string exclusionReason(const TrialRow& trial) {
  if (trial.kind == TrialKind::warm_up) return {};
  if (!trial.excluded.empty()) return trial.excluded;
  return trial.sites_felt < 2 ? "fewer than two places felt" : "";  // as a block has it: nothing to compare with
}

Spread computeSpread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {.count = values.size(),
          .mean = sum / static_cast<double>(values.size()),
          .least = values.front(),
          .lower_quartile = palpate::quantileOf(values, 0.25),
          .median = palpate::quantileOf(values, 0.5),
          .upper_quartile = palpate::quantileOf(values, 0.75),
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
    addAnswer(boxes[static_cast<std::size_t>(place)], answer);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].right.whole == 0) continue;
    finishBox(boxes[i], scale.from * std::exp(width * static_cast<double>(i)),
              scale.from * std::exp(width * static_cast<double>(i + 1)));
  }
  std::erase_if(boxes, [](const AnswerBox& box) { return box.right.whole == 0; });
  return boxes;
}

double AnswerBox::corrected() const { return chance < 1.0 ? (right.share() - chance) / (1.0 - chance) : 0.0; }

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
  const std::vector<PlacedAnswer> answers = placedAnswers(trials);
  statistics.levels = answersByChange(answers);
  statistics.boxes = answerBoxes(answers, {});
  statistics.felt = feltSites(trials);
  statistics.answers = tallyAnswers(trials);
  statistics.wrong = classifyWrongAnswers(statistics.answers);
  measureTrials(trials, statistics);
  return statistics;
}

}  // namespace palpate::training
