// Eighteen lumps, each in a sheet of its own. Every stroke is one of the engine's finger.
#include "teach/study/lump_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/elements/stack_solver.h"
#include "palpate/lumps/lump_sheet.h"
#include "teach/study/asked_test.h"

namespace palpate::study {

using lumps::LumpCue;
using lumps::LumpObserver;

namespace {

constexpr double kNotPrinted = std::numeric_limits<double>::quiet_NaN();
/// Resolution of the pattern in the fits: finer ones add hardly anything for lumps this deep.
constexpr std::size_t kTaxels = 8;
constexpr double k95 = 1.96;

// ------------------------------------------------------------------------------------------- printed values

/// A later study with the same kind of set, quoted in works that cite "Lump detection is enhanced in silicone breast
/// models simulating postmenopausal breast tissue" (1996).
ExaminedGroup laterStudy() {
  ExaminedGroup group{.name = "later", .words = "Later study", .figures = {}};
  group.figures = {{"size_1_0", "1.0 cm", 78.0, true, {.size = 2}}, {"size_0_3", "0.3 cm", 38.0, true, {.size = 0}},
                   {"hard", "hard", 61.0, false, {.hardness = 2}},  {"soft", "soft", 52.0, false, {.hardness = 0}},
                   {"medium", "medium", 63.0, false, {.depth = 0}}, {"deep", "deep", 53.0, false, {.depth = 1}}};
  return group;
}

/// "Physicians' abilities to detect lumps in silicone breast models" (JAMA 1985): 80 physicians.
ExaminedGroup studyOf1985() {
  ExaminedGroup group{.name = "jama_1985", .words = "Physicians of 1985", .figures = {}};
  group.figures = {{"size_1_0", "1.0 cm", 87.0, true, {.size = 2}},
                   {"size_0_3", "0.3 cm", 14.0, true, {.size = 0}},
                   {"hard", "hard", 56.0, false, {.hardness = 2}},
                   {"soft", "soft", 40.0, false, {.hardness = 0}},
                   {"mean", "all", 44.0, false, {}},
                   {"easiest", "1.0 hard", 94.0, false, {.size = 2, .hardness = 2}},
                   {"hardest", "0.3 soft", 4.0, false, {.size = 0, .hardness = 0}},
                   {"hardest_deep", "0.3 soft deep", 0.0, false, {.size = 0, .hardness = 0, .depth = 1}},
                   {"medium", "medium", kNotPrinted, false, {.depth = 0}},
                   {"deep", "deep", kNotPrinted, false, {.depth = 1}}};
  return group;
}

// ------------------------------------------------------------------------------------------- the set, felt

bool matches(const LumpsOfSet& wanted, const LumpsOfSet& lump) {
  const auto fits = [](std::size_t a, std::size_t b) { return a == LumpsOfSet::kAll || a == b; };
  return fits(wanted.size, lump.size) && fits(wanted.hardness, lump.hardness) && fits(wanted.depth, lump.depth);
}

lumps::LumpSheet makeLumpSheet(const SiliconeSet& set) {
  constexpr double kMatrixMm = 40.0;  // so thick that the board below is not felt
  constexpr double kDeepestMm = 14.0;
  elements::StackSettings settings;
  settings.press.depths_mm = {2.0, 4.0, 6.0, 8.0, 10.0, 12.0, kDeepestMm};
  settings.press.field_depths_mm = elements::fieldDepths(kDeepestMm);
  settings.drag.reset();
  const tissue::LayerStack stack{
      .layers = {{"skin", set.skin_mm, set.skin_kpa}, {"silicone", kMatrixMm, set.matrix_kpa}}};
  return lumps::LumpSheet(elements::solveStack(stack, settings).press.table);
}

tissue::LumpShape makeBall(double diameter_mm, double young_kpa, double centre_mm) {
  const double half = 0.5 * diameter_mm;
  return {.half_axes_mm = {half, half, half}, .depth_mm = centre_mm - half, .young_kpa = young_kpa};
}

/// Strokes past one lump, at distances from 0 to half of what strokes are apart.
using Strokes = std::vector<std::vector<LumpCue>>;

struct FeltLump {
  LumpsOfSet which;
  lumps::ComparedSkin skin;
  Strokes strokes = {};
};

struct FeltSet {
  lumps::LumpSheet sheet;
  double depth_mm = 0.0;
  std::vector<FeltLump> lumps;
};

FeltSet feltSet(const SiliconeSet& set) {
  constexpr double kStepMm = 0.5;
  FeltSet felt{.sheet = makeLumpSheet(set), .lumps = {}};
  felt.depth_mm = felt.sheet.depthAt(set.press_n);
  for (std::size_t size = 0; size < set.diameters_mm.size(); ++size) {
    for (std::size_t hardness = 0; hardness < set.young_kpa.size(); ++hardness) {
      for (std::size_t depth = 0; depth < set.centres_mm.size(); ++depth) {
        const auto ball = makeBall(set.diameters_mm[size], set.young_kpa[hardness], set.centres_mm[depth]);
        felt.lumps.push_back({{size, hardness, depth}, felt.sheet.with(ball)});
      }
    }
  }
  parallelFor(felt.lumps.size(), [&](std::size_t i) {
    FeltLump& lump = felt.lumps[i];
    for (double beside = 0.0; beside <= 0.5 * lumps::kStrokesApartMm; beside += kStepMm) {
      lump.strokes.push_back(lumps::strokePast(lump.skin, beside, felt.depth_mm, kTaxels));
    }
  });
  return felt;
}

/// How often a large group finds a lump, %: the mean over evenly drawn strokes.
double expectedPercentFound(const FeltLump& lump, const LumpObserver& observer) {
  double sum = 0.0;
  const std::size_t last = lump.strokes.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double share = i == 0 || i == last ? 0.5 : 1.0;
    sum += share * lumps::detectionProbability(lumps::maxClarity(lump.strokes[i], observer), observer);
  }
  return 100.0 * sum / static_cast<double>(last);
}

double expectedPercentFound(const FeltSet& set, const LumpsOfSet& wanted, const LumpObserver& observer) {
  double sum = 0.0;
  double count = 0.0;
  for (const FeltLump& lump : set.lumps) {
    if (!matches(wanted, lump.which)) continue;
    sum += expectedPercentFound(lump, observer);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

// ------------------------------------------------------------------------------------------- the fit

/// The middle of a bracket, halved until it is narrow; `rises(x)`: the root lies above x.
template <class Rises>
double rootBetween(double low, double high, const Rises& rises) {
  constexpr int kRounds = 40;
  for (int i = 0; i < kRounds; ++i) {
    const double middle = std::sqrt(low * high);
    (rises(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Fits the observer who finds the largest and the smallest lumps as often as is printed: a Weber fraction for each
/// spread, and the spread that separates the sizes this far.
LumpObserver fittedObserver(const FeltSet& set, double large_percent, double small_percent) {
  LumpObserver observer{.taxels = kTaxels};
  const auto weber_at = [&](double spread) {
    observer.spread = spread;
    return rootBetween(1e-4, 10.0, [&](double weber) {
      observer.pattern_weber = weber;
      return expectedPercentFound(set, {.size = 2}, observer) > large_percent;
    });
  };
  const double spread = rootBetween(0.1, 30.0, [&](double tried) {
    observer.pattern_weber = weber_at(tried);
    return expectedPercentFound(set, {.size = 0}, observer) < small_percent;
  });
  observer.pattern_weber = weber_at(spread);
  observer.spread = spread;
  return observer;
}

// ------------------------------------------------------------------------------------------- trainees

/// Streams of random numbers that no two parts of the study share.
enum class LumpPart : std::uint64_t { later = 1, jama_1985, detection = 10, sizes = 20 };

std::uint64_t personSeed(const LumpPlan& plan, LumpPart part, std::size_t person) {
  constexpr std::uint64_t kApart = 7000;  // a number of its own, which the quoted figures come from
  return runSeed(plan.seed, kApart + static_cast<std::uint64_t>(part), person);
}

/// One person examines the set: which lumps were found.
std::vector<bool> examined(const FeltSet& set, const LumpObserver& observer, Random random) {
  const double skill = lumps::drawSkill(observer, random);
  std::vector<bool> found;
  for (const FeltLump& lump : set.lumps) {
    const double beside_mm = lumps::drawStroke(random);
    const auto cues = lumps::strokePast(lump.skin, beside_mm, set.depth_mm, observer.taxels);
    found.push_back(lumps::finds(lumps::maxClarity(cues, observer), skill, observer, random));
  }
  return found;
}

struct MeanOfPeople {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Mean of shares, in percent, with its 95 % interval.
MeanOfPeople meanWithInterval(const std::vector<double>& shares) {
  const auto count = static_cast<double>(shares.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double share : shares) {
    sum += share;
    squares += share * share;
  }
  const double mean = sum / count;
  const double error = std::sqrt(std::max(0.0, squares / count - mean * mean) / std::max(1.0, count - 1.0));
  return {100.0 * mean, 100.0 * std::max(0.0, mean - k95 * error), 100.0 * std::min(1.0, mean + k95 * error)};
}

void examine(const FeltSet& set, const LumpPlan& plan, LumpPart part, ExaminedGroup& group) {
  std::vector<std::vector<bool>> people(plan.people);
  parallelFor(plan.people,
              [&](std::size_t i) { people[i] = examined(set, group.observer, Random(personSeed(plan, part, i))); });
  for (DetectionFigure& figure : group.figures) {
    std::vector<double> shares;
    for (const std::vector<bool>& found : people) {
      double hits = 0.0;
      double all = 0.0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (!matches(figure.lumps, set.lumps[i].which)) continue;
        hits += found[i] ? 1.0 : 0.0;
        all += 1.0;
      }
      shares.push_back(hits / all);
    }
    const MeanOfPeople mean = meanWithInterval(shares);
    figure.found = mean.mean;
    figure.low = mean.low;
    figure.high = mean.high;
    figure.expected = expectedPercentFound(set, figure.lumps, group.observer);
  }
  LumpObserver force_only = group.observer;
  force_only.field = false;
  group.force_only_mean = expectedPercentFound(set, {}, force_only);
  group.force_only_smallest = expectedPercentFound(set, {.size = 0}, force_only);
  group.expected_mean = expectedPercentFound(set, {}, group.observer);
  group.expected_easiest = expectedPercentFound(set, {.size = 2, .hardness = 2}, group.observer);
  group.expected_hardest = expectedPercentFound(set, {.size = 0, .hardness = 0}, group.observer);
}

// ------------------------------------------------------------------------------------------- two presses

/// The clearest of a stroke right over a lump, of the contrast of Yu et al. and of another size.
LumpCue clearestCue(const FeltSet& set, double diameter_mm, const LumpObserver& observer) {
  constexpr double kTopMm = 5.5;
  constexpr double kRatio = 16.0;
  const double half = 0.5 * diameter_mm;
  const tissue::LumpShape lump{.half_axes_mm = {half, half, half}, .depth_mm = kTopMm, .stiffness_ratio = kRatio};
  const auto cues = lumps::strokePast(set.sheet.with(lump), 0.0, set.depth_mm, observer.taxels);
  return *std::max_element(cues.begin(), cues.end(), [&](const LumpCue& a, const LumpCue& b) {
    return lumps::computeClarity(a, observer) < lumps::computeClarity(b, observer);
  });
}

/// Relative difference of two cues: Weber fractions refer to what is felt already.
LumpCue moreThan(const LumpCue& more, const LumpCue& less) {
  return {.force = (1.0 + more.force) / (1.0 + less.force) - 1.0,
          .pattern = (1.0 + more.pattern) / (1.0 + less.pattern) - 1.0};
}

/// Every person answers a few times; noise of 1 in each press.
void answer(const LumpPlan& plan, LumpPart part, std::size_t row, TwoPresses& presses) {
  constexpr int kTrials = 10;
  std::vector<double> shares(plan.people);
  for (std::size_t i = 0; i < plan.people; ++i) {
    Random random(personSeed(plan, part, i) + row);
    int right = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const double with = presses.d_prime + random.normal();
      right += with > random.normal() ? 1 : 0;
    }
    shares[i] = right / static_cast<double>(kTrials);
  }
  const MeanOfPeople mean = meanWithInterval(shares);
  presses.found = mean.mean;
  presses.low = mean.low;
  presses.high = mean.high;
  presses.expected = 100.0 * lumps::twoIntervals(presses.d_prime);
}

/// Yu et al., "Towards high fidelity remote palpation system": 12 people.
void measureTwoPresses(const FeltSet& set, const LumpObserver& later, LumpMeasurement& found) {
  constexpr double kSmallMm = 5.0;
  constexpr double kLargeMm = 7.0;
  const auto clearest_cue_at = [&](double diameter_mm, const LumpObserver& observer) {
    return clearestCue(set, diameter_mm, observer);
  };
  const auto with = [&](std::size_t taxels) {
    LumpObserver observer = later;
    observer.taxels = taxels;
    return observer;
  };
  found.detection = {{"force_only", "force alone", 0, 50.0},
                     {"pattern2", "2 x 2", 2, kNotPrinted},
                     {"pattern4", "4 x 4", 4, 98.0},
                     {"pattern8", "8 x 8", 8, kNotPrinted}};
  found.sizes = {{"force_only", "force alone", 0, 64.0}, {"pattern4", "4 x 4", 4, 86.0}};
  for (std::size_t i = 0; i < found.detection.size(); ++i) {
    TwoPresses& row = found.detection[i];
    const LumpObserver observer = with(row.taxels);
    row.d_prime = lumps::computeClarity(clearest_cue_at(kSmallMm, observer), observer);
    answer(found.plan, LumpPart::detection, i, row);
  }
  for (std::size_t i = 0; i < found.sizes.size(); ++i) {
    TwoPresses& row = found.sizes[i];
    const LumpObserver observer = with(row.taxels);
    row.d_prime = lumps::computeClarity(
        moreThan(clearest_cue_at(kLargeMm, observer), clearest_cue_at(kSmallMm, observer)), observer);
    answer(found.plan, LumpPart::sizes, i, row);
  }
}

// ------------------------------------------------------------------------------------------- assumed otherwise

struct OtherSet {
  std::string words;
  SiliconeSet set;
};

std::vector<OtherSet> otherSets(const SiliconeSet& set) {
  const auto changed = [&](const std::string& words, const auto& change) {
    OtherSet other{words, set};
    change(other.set);
    return other;
  };
  return {changed("centres 7.5 and 11.5 mm deep",
                  [](SiliconeSet& s) {
                    s.centres_mm = {7.5, 11.5};
                  }),
          changed("centres 9 and 13 mm deep",
                  [](SiliconeSet& s) {
                    s.centres_mm = {9.0, 13.0};
                  }),
          changed("centres 8 and 16 mm deep",
                  [](SiliconeSet& s) {
                    s.centres_mm = {8.0, 16.0};
                  }),
          changed("lumps of 30, 60, 120 kPa",
                  [](SiliconeSet& s) {
                    s.young_kpa = {30.0, 60.0, 120.0};
                  }),
          changed("lumps of 60, 170, 400 kPa",
                  [](SiliconeSet& s) {
                    s.young_kpa = {60.0, 170.0, 400.0};
                  }),
          changed("a matrix of 18 kPa", [](SiliconeSet& s) { s.matrix_kpa = 18.0; }),
          changed("a skin of 1 mm", [](SiliconeSet& s) { s.skin_mm = 1.0; }),
          changed("a press of 2 N", [](SiliconeSet& s) { s.press_n = 2.0; })};
}

void evaluateOtherSets(const Progress& progress, LumpMeasurement& found) {
  const std::vector<OtherSet> others = otherSets(found.set);
  const ExaminedGroup& later = found.groups.front();
  for (std::size_t i = 0; i < others.size(); ++i) {
    report(progress, "assumed otherwise", static_cast<double>(i) / static_cast<double>(others.size()));
    const FeltSet set = feltSet(others[i].set);
    AssumedOtherwise row{.words = others[i].words, .expected = {}};
    row.observer = fittedObserver(set, later.figure("size_1_0").printed, later.figure("size_0_3").printed);
    for (const DetectionFigure& figure : later.figures) {
      row.expected.push_back(expectedPercentFound(set, figure.lumps, row.observer));
    }
    found.otherwise.push_back(std::move(row));
  }
}

/// Right over every lump.
void collectCues(const FeltSet& felt, LumpMeasurement& found) {
  const std::size_t depths = found.set.centres_mm.size();
  for (std::size_t i = 0; i < felt.lumps.size(); i += depths) {
    const LumpsOfSet& which = felt.lumps[i].which;
    CueRow row{found.set.diameters_mm[which.size], found.set.young_kpa[which.hardness], {}};
    for (std::size_t depth = 0; depth < depths; ++depth) {
      const std::vector<LumpCue>& over = felt.lumps[i + depth].strokes.front();
      row.by_depth[depth] = over[over.size() / 2];
    }
    found.cues.push_back(row);
  }
}

}  // namespace

const DetectionFigure& ExaminedGroup::figure(std::string_view name_of) const {
  for (const DetectionFigure& one : figures) {
    if (one.name == name_of) return one;
  }
  throw Error(fmt::format("unknown figure of the {}: {}", words, name_of));
}

double ExaminedGroup::worstPoints() const {
  double worst = 0.0;
  for (const DetectionFigure& one : figures) {
    if (!one.fitted && std::isfinite(one.printed)) worst = std::max(worst, std::abs(one.found - one.printed));
  }
  return worst;
}

LumpPlan lumpPlan(const StudySettings& settings) {
  LumpPlan plan;
  if (settings.quick) plan = {.people = 100, .otherwise = false};
  plan.people = settings.cases.value_or(plan.people);
  plan.seed = settings.seed.value_or(plan.seed);
  return plan;
}

LumpMeasurement measureLumps(const LumpPlan& plan, const Progress& progress) {
  LumpMeasurement found{.plan = plan};
  report(progress, "strokes past eighteen lumps", 0.0);
  const FeltSet set = feltSet(found.set);
  found.groups = {laterStudy(), studyOf1985()};
  for (ExaminedGroup& group : found.groups) {
    report(progress, group.words, 0.0);
    group.observer = fittedObserver(set, group.figure("size_1_0").printed, group.figure("size_0_3").printed);
    examine(set, plan, group.name == "later" ? LumpPart::later : LumpPart::jama_1985, group);
  }
  collectCues(set, found);
  measureTwoPresses(set, found.groups.front().observer, found);
  if (plan.otherwise) evaluateOtherSets(progress, found);
  return found;
}

}  // namespace palpate::study
