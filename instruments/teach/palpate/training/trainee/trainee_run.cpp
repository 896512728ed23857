#include "palpate/training/trainee/trainee_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/order_statistics.h"

namespace palpate::training {

namespace {

// How a person's presses differ from each other: in place (each way), in force and in time (of the logarithm).
constexpr double kBesideSdMm = 1.5;
constexpr double kMaxBesideMm = 4.0;
constexpr double kForceSd = 0.10;
constexpr double kHoldSd = 0.10;

/// Time to decide, and to read a text.
constexpr double kThinkS = 0.6;

std::uint64_t traineeSeed(const Session& session, const ObserverSettings& observer) {
  Hash hash;
  hash.add(observer.seed);
  hash.add(session.plan().seed);
  for (const char letter : session.plan().row.id) hash.add(static_cast<std::uint64_t>(letter));
  return hash.value();
}

MeantPress meantPress(const ObserverSettings& observer, Random& random) {
  const auto beside = [&] { return std::clamp(kBesideSdMm * random.normal(), -kMaxBesideMm, kMaxBesideMm); };
  const double x = beside();
  const double y = beside();
  const double force = observer.press_n * std::exp(kForceSd * random.normal());
  return {.beside_mm = Vec2(x, y), .force_n = force, .hold_s = observer.press_s * std::exp(kHoldSd * random.normal())};
}

}  // namespace

std::vector<double> TraineeRun::FeltSites::ratios() const {
  if (stiffness_n_per_mm.empty()) return {};
  const double base = medianOf(stiffness_n_per_mm);
  std::vector<double> ratios;
  for (const double stiffness : stiffness_n_per_mm) ratios.push_back(base > 0.0 ? stiffness / base : 1.0);
  return ratios;
}

TraineeRun::TraineeRun(Session& session, Touching& touching, const TraineeOrders& orders, std::int64_t start_ms)
    : SittingRun(session, touching, orders, start_ms, traineeSeed(session, orders.observer)),
      session_(session),
      place_mm_(session.plan().sites.sites.front().place_mm) {
  orders_.observer.meaning = settingsOf(session.plan().protocol, session.plan().kind).block.meaning;
  each_tick_ = [this](const trace::Sample& sample) {
    const Moment moment = now();
    session_.feel(sample, moment);
    session_.tick(moment);
  };
}

Moment SittingRun::now() const {
  const double seconds = static_cast<double>(touching_.tick()) * touching_.tickS();
  return {.s = seconds, .utc_ms = start_ms_ + std::llround(1000.0 * seconds), .tick = touching_.tick()};
}

bool SittingRun::stops() const {
  return (orders_.most_trials > 0 && answers_ >= orders_.most_trials) || (orders_.stop && orders_.stop());
}

void SittingRun::run() {
  storeNewRows();
  while (sitting_.screen() != Screen::finished) {
    if (stops()) {
      sitting_.leave(now());
    } else {
      walkScreen();
    }
    storeNewRows();
  }
}

void TraineeRun::walkScreen() {
  if (session_.hidden() != held_) {
    held_ = session_.hidden();
    touching_.change(held_);
  }
  switch (session_.screen()) {
    case Screen::device_check:
      return checkDevice();
    case Screen::familiarisation:
      return compareTwo();
    case Screen::instruction:
      touching_.rest(kThinkS, each_tick_);
      return session_.next(now());
    case Screen::trial:
      return tryTrial();
    case Screen::feedback:
      return readFeedback();
    case Screen::block_summary:
      // A session is a block, also where practice would go on.
      touching_.mark("end of block");
      return session_.showsProgress() ? session_.leave(now()) : session_.next(now());
    case Screen::free_exploration:
      for (const Site& site : session_.plan().sites.sites) pressSite(site.number);
      return session_.next(now());
    case Screen::finished:
      return;
  }
}

/// Presses as firmly as requested, even for a trainee who presses too lightly later.
void TraineeRun::checkDevice() {
  constexpr int kMaxTries = 3;
  const double asked_n = 2.0 * session_.plan().protocol.exploration.force_n;
  for (int i = 0; i < kMaxTries && session_.screen() == Screen::device_check; ++i) {
    MeantPress meant = meantPress(orders_.observer, random_);
    meant.force_n = std::max(meant.force_n, asked_n);
    touching_.press(session_.plan().sites.sites.front(), meant, each_tick_);
    session_.next(now());
  }
  if (session_.screen() == Screen::device_check) throw Error("trainee: the device check felt no press");
}

/// Familiarisation: each of the two, then on, or the one that gave way less.
void TraineeRun::compareTwo() {
  const FamiliarPlaces pair = *session_.familiarPlaces();
  felt_ = {};
  for (const int number : {pair.first, pair.second}) pressSite(number);
  if (!session_.asks()) {
    session_.next(now());
    if (session_.asks() || session_.screen() != Screen::familiarisation) return;
    return session_.next(now());  // "Press both places first" to one who presses too lightly
  }
  const bool second = felt_.sites.size() == 2 && felt_.stiffness_n_per_mm[1] > felt_.stiffness_n_per_mm[0];
  session_.answer(second ? pair.second : pair.first, now());
}

bool TraineeRun::pressSite(int number) {
  const Site& site = *session_.plan().sites.numbered(number);
  const FeltPress press = touching_.press(site, meantPress(orders_.observer, random_), each_tick_);
  place_mm_ = site.place_mm;
  if (!(press.depth_mm > 0.0)) return false;
  felt_.sites.push_back(number);
  felt_.stiffness_n_per_mm.push_back(press.stiffness());
  return true;
}

/// From where the finger is always to the nearest that is left: down one side, and up the other.
void TraineeRun::search(int trial) {
  const SiteSet& sites = session_.plan().sites;
  std::vector<int> left = sitesSearched(orders_.observer, sites.choices(), random_);
  felt_ = {};
  const auto away = [&](int number) { return (sites.numbered(number)->place_mm - place_mm_).squaredNorm(); };
  while (!left.empty()) {
    const auto nearest = std::ranges::min_element(left, {}, away);
    pressSite(*nearest);
    left.erase(nearest);
    const bool over = session_.screen() != Screen::trial || session_.trialNumber() != trial;
    if (over || (orders_.stop && orders_.stop())) return;
  }
}

void TraineeRun::tryTrial() {
  const int trial = session_.trialNumber();
  touching_.mark(fmt::format("trial {}", trial));
  search(trial);
  if (session_.screen() == Screen::trial && session_.trialNumber() == trial) touching_.rest(kThinkS, each_tick_);
  // The time may have run out meanwhile, and a stop may have been requested.
  const bool over = session_.screen() != Screen::trial || session_.trialNumber() != trial;
  if (!over && stops()) return;
  if (!over) {
    const std::vector<double> ratios = felt_.ratios();
    answer(decide(felt_.sites, ratios, orders_.observer, orders_.practised, session_.plan().sites.choices(), random_));
  }
  ++answers_;
  storeNewRows();
  if (orders_.answered) orders_.answered(session_.trials().back());
}

void TraineeRun::answer(int site) {
  touching_.mark(fmt::format("trial {} answered {}", session_.trialNumber(), site));
  // Answers again after "Two places were not pressed yet": it searched fewer on purpose.
  if (!session_.answer(site, now())) session_.answer(site, now());
}

void TraineeRun::readFeedback() {
  touching_.rest(kThinkS, each_tick_);
  if (!session_.trials().back().correct) pressSite(held_->site);
  session_.next(now());
}

void SittingRun::storeNewRows() {
  std::vector<Row> rows = sitting_.drainRows();
  if (orders_.save && !rows.empty()) orders_.save(std::move(rows));
}

}  // namespace palpate::training
