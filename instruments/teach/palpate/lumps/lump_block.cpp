#include "palpate/lumps/lump_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/order_statistics.h"
#include "palpate/base/random.h"
#include "palpate/lumps/lump_observer.h"

namespace palpate::lumps {

namespace {

constexpr int kKinds = kGrades * kGrades * kGrades;

/// The lumps of one body of an examination lie so far apart that none is felt with another.
constexpr double kApartMm = 45.0;

// The walk along ln C: a factor of 2 until two turns, then of 1.5.
const double kFirstStep = elementary::log(2.0);
const double kLaterStep = elementary::log(1.5);
constexpr int kFirstTurns = 2;
/// Number of kinds nearest to the walk's cue, of which one is drawn: a level must not reveal the kind.
constexpr std::size_t kDrawnFrom = 3;

/// A stream of its own for each body, whatever was drawn before.
Random bodyRandomStream(std::uint64_t seed, std::uint64_t body) {
  Random mixed(seed ^ (body * 0xd1342543de82ef95ull));
  return Random(mixed.bits());
}

void shuffle(std::vector<int>& numbers, Random& random) {
  for (std::size_t i = numbers.size(); i > 1; --i) std::swap(numbers[i - 1], numbers[random.below(i)]);
}

HiddenLump ofKind(int kind) {
  return {.size = kind / (kGrades * kGrades), .depth = kind / kGrades % kGrades, .hardness = kind % kGrades};
}

double lnCue(double cue) {
  constexpr double kLeast = 1e-4;  // cue that cannot be felt at all
  return elementary::log(std::max(cue, kLeast));
}

bool foundAll(const LumpTrial& trial, const LumpTask& task) {
  const std::vector<MatchedFinding> all = matchFindings(trial, task);
  const auto belongs = [](const MatchedFinding& one) { return one.lump.has_value(); };
  return static_cast<std::size_t>(std::ranges::count_if(all, belongs)) == trial.hidden.size();
}

/// Places for the lumps of one body, far enough from each other.
std::vector<Vec2> placesApart(const std::vector<Vec2>& places, std::size_t count, Random& random) {
  constexpr int kTries = 2000;
  for (int i = 0; i < kTries; ++i) {
    std::vector<Vec2> drawn;
    while (drawn.size() < count) drawn.push_back(places[random.below(places.size())]);
    bool apart = true;
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < a; ++b) apart = apart && (drawn[a] - drawn[b]).norm() >= kApartMm;
    }
    if (apart) return drawn;
  }
  throw Error(
      "lump session: three lumps do not fit into one body; choose smaller or shallower ones ([lump] of the protocol)");
}

}  // namespace

std::vector<MatchedFinding> matchFindings(const LumpTrial& trial, const LumpTask& task) {
  struct Pair {
    double distance_mm;
    std::size_t finding;
    std::size_t lump;
  };
  std::vector<MatchedFinding> all(trial.findings.size());
  std::vector<Pair> pairs;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (!trial.findings[f].place_mm) continue;
    for (std::size_t i = 0; i < trial.hidden.size(); ++i) {
      const double distance = (*trial.findings[f].place_mm - trial.hidden[i].place_mm).norm();
      if (!all[f].error_mm || distance < *all[f].error_mm) all[f].error_mm = distance;
      if (distance <= task.hitMm(trial.hidden[i].size)) pairs.push_back({distance, f, i});
    }
  }
  std::ranges::sort(pairs, {}, [](const Pair& pair) { return std::tuple(pair.distance_mm, pair.finding, pair.lump); });
  std::vector<bool> taken(trial.hidden.size(), false);
  for (const Pair& pair : pairs) {
    if (all[pair.finding].lump || taken[pair.lump]) continue;
    all[pair.finding].lump = pair.lump;
    taken[pair.lump] = true;
  }
  return all;
}

bool isRight(const LumpTrial& trial, const LumpTask& task) {
  return trial.findings.size() == trial.hidden.size() && foundAll(trial, task);
}

LumpBlock::LumpBlock(LumpBlockSettings settings, std::uint64_t seed) : settings_(std::move(settings)), seed_(seed) {
  if (settings_.places.empty()) throw Error("lump session: no place has room for a lump");
  draw();
}

LumpBlock LumpBlock::resumed(LumpBlockSettings settings, std::string_view state) {
  LumpState read = parseLumpState(state);
  if (read.exam != settings.exam || read.trials.empty()) {
    throw Error::inFile("state of a block", "not of this kind of lump session");
  }
  LumpBlock block;
  block.settings_ = std::move(settings);
  block.seed_ = read.seed;
  block.trials_ = std::move(read.trials);
  if (block.number() > block.bodies()) throw Error::inFile("state of a block", "more bodies than its settings allow");
  return block;
}

bool LumpBlock::finished() const { return number() >= bodies() && trial().over; }

LumpQuestion LumpBlock::question() const {
  const LumpTrial& now = trial();
  if (now.over) return LumpQuestion::none;
  if (now.findings.empty()) return settings_.exam ? LumpQuestion::place : LumpQuestion::there;
  const LumpFinding& last = now.findings.back();
  if (!last.place_mm) return LumpQuestion::place;
  if (last.size == LumpFinding::kUnsaid) return LumpQuestion::size;
  if (last.depth == LumpFinding::kUnsaid) return LumpQuestion::depth;
  if (last.hardness == LumpFinding::kUnsaid) return LumpQuestion::hardness;
  if (last.mobile == LumpFinding::kUnsaid) return LumpQuestion::mobile;
  return LumpQuestion::place;
}

bool LumpBlock::answer(int choice) {
  LumpTrial& now = trials_.back();
  const LumpQuestion asked = question();
  const bool two = asked == LumpQuestion::there || asked == LumpQuestion::mobile;
  if (choice < 0 || choice >= (two ? 2 : kGrades)) return false;
  switch (asked) {
    case LumpQuestion::there:
      if (choice == 1) now.findings.emplace_back();
      now.over = choice == 0;
      return true;
    case LumpQuestion::size:
      now.findings.back().size = choice;
      return true;
    case LumpQuestion::depth:
      now.findings.back().depth = choice;
      return true;
    case LumpQuestion::hardness:
      now.findings.back().hardness = choice;
      return true;
    case LumpQuestion::mobile:
      now.findings.back().mobile = choice;
      now.over = !settings_.exam || now.findings.size() >= kMaxFindings;
      return true;
    case LumpQuestion::place:
    case LumpQuestion::none:
      break;
  }
  return false;
}

bool LumpBlock::answer(const Vec2& place_mm) {
  if (question() != LumpQuestion::place || !place_mm.allFinite()) return false;
  LumpTrial& now = trials_.back();
  if (settings_.exam) {
    now.findings.push_back({.place_mm = place_mm});
    return true;
  }
  now.findings.back().place_mm = place_mm;
  // A false place has no kind to ask about.
  now.over = !matchFindings(now, settings_.task).back().lump;
  return true;
}

bool LumpBlock::noMore() {
  if (!settings_.exam || question() != LumpQuestion::place) return false;
  trials_.back().over = true;
  return true;
}

void LumpBlock::next() {
  if (trial().over && !finished()) draw();
}

std::string LumpBlock::state() const {
  return lumpStateText({.seed = seed_, .exam = settings_.exam, .trials = trials_});
}

// ---- drawn

void LumpBlock::draw() {
  LumpTrial trial;
  const auto number = static_cast<std::uint64_t>(trials_.size()) + 1;
  settings_.exam ? drawExam(trial) : drawPractice(trial, number);
  for (HiddenLump& lump : trial.hidden) lump.cue = settings_.cue_of ? settings_.cue_of(lump) : 1.0;
  trials_.push_back(std::move(trial));
}

const std::vector<double>& LumpBlock::logCuesByKind() {
  if (!ln_cue_of_kinds_.empty()) return ln_cue_of_kinds_;
  for (int kind = 0; kind < kKinds; ++kind) {
    HiddenLump lump = ofKind(kind);
    lump.place_mm = settings_.places[settings_.places.size() / 2];
    ln_cue_of_kinds_.push_back(lnCue(settings_.cue_of ? settings_.cue_of(lump) : 1.0));
  }
  return ln_cue_of_kinds_;
}

double LumpBlock::aimedLnCue() const {
  double aim = elementary::log(settings_.task.start_cue);
  int found_in_a_row = 0;
  int turns = 0;
  int went = 0;
  for (const LumpTrial& trial : trials_) {
    if (trial.hidden.empty()) continue;
    const bool found = foundAll(trial, settings_.task);
    found_in_a_row = found ? found_in_a_row + 1 : 0;
    if (found && found_in_a_row < 2) continue;
    found_in_a_row = 0;
    const int goes = found ? -1 : 1;
    if (went != 0 && goes != went) ++turns;
    went = goes;
    aim += goes * (turns < kFirstTurns ? kFirstStep : kLaterStep);
  }
  return aim;
}

void LumpBlock::drawPractice(LumpTrial& trial, std::uint64_t number) {
  Random random = bodyRandomStream(seed_, number);
  const bool empty = random.uniform() < settings_.task.empty_share;
  const Vec2 place = settings_.places[random.below(settings_.places.size())];
  const bool mobile = random.uniform() < settings_.task.mobile_share;
  const std::uint64_t which = random.below(kDrawnFrom);
  if (empty) return;
  const std::vector<double>& plain = logCuesByKind();
  const auto [least, most] = std::ranges::minmax(plain);
  const double aim = std::clamp(aimedLnCue(), least, most);
  std::vector<int> kinds(kKinds);
  for (int i = 0; i < kKinds; ++i) kinds[static_cast<std::size_t>(i)] = i;
  std::ranges::sort(kinds, {},
                    [&](int kind) { return std::pair(std::abs(plain[static_cast<std::size_t>(kind)] - aim), kind); });
  HiddenLump lump = ofKind(kinds[which]);
  lump.place_mm = place;
  lump.mobile = mobile;
  trial.hidden.push_back(lump);
}

/// The number of a body sets which of three ways sizes go with hardnesses and which of two with depths; the order of
/// the bodies is drawn.
void LumpBlock::drawExam(LumpTrial& trial) {
  Random order = bodyRandomStream(seed_, 0);
  std::vector<int> bodies(kExamBodies);
  for (int i = 0; i < kExamBodies; ++i) bodies[static_cast<std::size_t>(i)] = i;
  shuffle(bodies, order);
  const int body = bodies[trials_.size()];
  Random random = bodyRandomStream(seed_, trials_.size() + 1);
  const std::vector<Vec2> places = placesApart(settings_.places, kExamLumpsOfBody, random);
  for (int size = 0; size < kExamLumpsOfBody; ++size) {
    const bool deep = (size + body / kGrades) % 2 != 0;
    trial.hidden.push_back({.place_mm = places[static_cast<std::size_t>(size)],
                            .size = size,
                            .depth = deep ? kGrades - 1 : 0,
                            .hardness = (size + body) % kGrades,
                            .mobile = random.uniform() < settings_.task.mobile_share});
  }
}

// ---- counted

namespace {

/// A lump that was looked for.
struct Sought {
  double ln_cue;
  bool found;
};

/// On a grid: ln C of the threshold, normal around 0 (what the group of the observer finds half the time), and the
/// spread among those that people show.
CueThreshold cueThreshold(const std::vector<Sought>& sought) {
  constexpr int kPoints = 121;
  constexpr double kReach = 6.0;  // ln C
  constexpr double kPriorSd = 2.0;
  constexpr double kAttention = 0.98;
  constexpr std::array kSpreads = {0.5, 1.0, 1.7, 2.5, 3.4};
  if (sought.empty()) return {};
  std::vector<WeighedValue> cues(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double place = kReach * (2.0 * i / (kPoints - 1) - 1.0);
    WeighedValue& cue = cues[static_cast<std::size_t>(i)];
    cue.value = elementary::exp(place);
    for (const double spread : kSpreads) {
      double weight = elementary::exp(-0.5 * elementary::square(place / kPriorSd));
      for (const Sought& lump : sought) {
        const double right = kAttention * standardNormalBelow((lump.ln_cue - place) / spread);
        weight *= lump.found ? right : 1.0 - right;
      }
      cue.weight += weight;
    }
  }
  return {
      .median = weighedQuantile(cues, 0.5), .low = weighedQuantile(cues, 0.025), .high = weighedQuantile(cues, 0.975)};
}

}  // namespace

LumpCounts countLumps(const std::vector<LumpTrial>& trials, const LumpTask& task) {
  LumpCounts counts;
  std::vector<Sought> sought;
  for (const LumpTrial& trial : trials) {
    if (!trial.over) continue;
    ++counts.bodies;
    const bool there = !trial.hidden.empty();
    const bool said = !trial.findings.empty();
    ++(there ? counts.with : counts.without);
    if (said) ++(there ? counts.said_with : counts.said_without);
    std::vector<bool> found(trial.hidden.size(), false);
    for (const MatchedFinding& finding : matchFindings(trial, task)) {
      if (finding.lump) found[*finding.lump] = true;
      if (!finding.lump) ++counts.false_places;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      ++counts.lumps;
      if (found[i]) ++counts.found;
      sought.push_back({lnCue(trial.hidden[i].cue), found[i]});
    }
  }
  counts.threshold = cueThreshold(sought);
  counts.passed =
      counts.lumps > 0 && counts.found >= task.mark_share * counts.lumps && counts.false_places <= task.most_false;
  return counts;
}

}  // namespace palpate::lumps
