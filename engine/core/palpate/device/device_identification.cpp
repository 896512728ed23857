// Between two turning points the friction has one sign, and the motion is linear in the unknowns:
//
//   x(t) = x0 + v0 t + (1/m) JJF(t - delay) - (b/m) J(x - x0) - (c/m) s t^2/2 + (g/m) t^2/2
//   J: integral over time
//
// so each half swing gives linear equations; integrals, not derivatives, because the places are counts of an encoder.
// A half swing that begins with a jump of the spring begins at rest (v0 = 0) when the force arrives. That gives the
// delay: the one that leaves the least residual.
#include "palpate/device/device_identification.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "palpate/base/dense_solve.h"
#include "palpate/base/error.h"

namespace palpate::device {

namespace {

constexpr double kStiffest = 0.2;  // N/mm
constexpr double kUnknownForce = 0.5;
constexpr double kMaxForce = 2.0;
constexpr double kForceShare = 0.2;
constexpr double kStronger = 1.4;
constexpr double kFreely = 1.25;  // reaches
/// A released device stays within this many reaches, and slower than that, mm/s.
constexpr double kMaxReaches = 2.5;
constexpr double kMaxSpeed = 2000.0;
constexpr double kMaxGapTicks = 2.0;  // no driver holds its force for longer
/// Within this for so long, a device rests, mm.
constexpr double kStill = 0.15;
constexpr double kStillS = 0.1;
constexpr double kMinSwingS = 0.15;
constexpr double kLongestSwingS = 2.0;
constexpr double kLongestRestS = 4.0;
constexpr double kLongestS = 60.0;

/// A half swing moves the device at least this far, mm, and turns back by at least as much.
constexpr double kMinSwing = 1.5;
constexpr double kTurn = 0.3;
constexpr double kTrimS = 0.004;  // left out at a turning point: its tick is not known so well
constexpr std::size_t kMinSamples = 12;
constexpr double kLongestDelay = 8.0;  // ticks
/// 1 kg = 1e-3 N s^2/mm.
constexpr double kKilogram = 1e-3;

/// Ticks [from, until) in which the device moves one way.
struct HalfSwing {
  std::size_t from = 0;
  std::size_t until = 0;
  double sign = 1.0;
  bool from_rest = false;  ///< `from` is the jump of the spring
};

/// The ticks at the farthest place of the way that begins at `from`, before it turns back: it turns in one of them.
struct Turn {
  std::size_t first = 0;
  std::size_t last = 0;
};

Turn turnOf(const std::vector<double>& place, std::size_t from, std::size_t end, double sign) {
  Turn turn{from, from};
  for (std::size_t k = from; k < end; ++k) {
    const double ahead = sign * (place[k] - place[turn.first]);
    if (ahead > 0.0) turn.first = k;
    if (ahead >= 0.0) turn.last = k;
    if (ahead < -kTurn) break;
  }
  return turn;
}

/// Those after one jump of the spring.
void addHalfSwings(const SwingRecord& record, std::size_t jump, std::size_t end, std::vector<HalfSwing>& all) {
  const std::vector<double>& place = record.place_mm;
  const auto trim = static_cast<std::size_t>(std::ceil(kTrimS / record.tick_s));
  double sign = record.force_n[jump] > 0.0 ? 1.0 : -1.0;
  for (std::size_t from = jump; from < end;) {
    const Turn turn = turnOf(place, from, end, sign);
    if (std::abs(place[turn.first] - place[from]) < kMinSwing) return;
    const std::size_t begin = from == jump ? jump : from + trim;
    if (begin + kMinSamples + trim < turn.first) all.push_back({begin, turn.first - trim, sign, from == jump});
    from = turn.last;
    sign = -sign;
  }
}

std::vector<HalfSwing> halfSwings(const SwingRecord& record) {
  std::vector<HalfSwing> all;
  for (std::size_t i = 0; i < record.jumps.size(); ++i) {
    const std::size_t end = i + 1 < record.jumps.size() ? record.jumps[i + 1] : record.place_mm.size();
    addHalfSwings(record, record.jumps[i], end, all);
  }
  return all;
}

/// The factors of 1/m, b/m, c/m, g/m, and the place itself; N s^2, mm s, s^2, s^2, mm.
constexpr int kColumns = 5;
using Row = Eigen::Matrix<double, 1, kColumns>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, kColumns>;
using Normal = Eigen::Matrix<double, kColumns, kColumns>;

/// The force at the motor in the part of a tick's interval that begins at `at`, in ticks since the record's begin.
double forceAt(const SwingRecord& record, double at, double delay) {
  const double command = std::floor(at - delay + 1e-9);
  if (command < 0.0) return 0.0;
  return record.force_n[std::min(static_cast<std::size_t>(command), record.force_n.size() - 1)];
}

/// The columns of one half swing. The motor's force changes once within each interval, where the delay ends.
Rows buildSwingRows(const SwingRecord& record, const HalfSwing& swing, double delay) {
  const double onset = static_cast<double>(swing.from) + (swing.from_rest ? delay : 0.0);
  const double part = delay - std::floor(delay);
  const auto count = static_cast<Eigen::Index>(swing.until - swing.from);
  Rows rows(count, kColumns);
  double impulse = 0.0;  // J F
  double pushed = 0.0;   // JJ F
  double travelled = 0.0;
  const auto pass = [&](double from, double until) {
    const double begin = std::max(from, onset);
    if (!(until > begin)) return;
    const double seconds = (until - begin) * record.tick_s;
    const double force = forceAt(record, begin, delay);
    pushed += (impulse + 0.5 * force * seconds) * seconds;
    impulse += force * seconds;
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t k = swing.from + static_cast<std::size_t>(i);
    const auto at = static_cast<double>(k);
    const double time_s = std::max(0.0, at - onset) * record.tick_s;
    const double constant = 0.5 * time_s * time_s;
    rows.row(i) << pushed, -travelled, -swing.sign * constant, constant, record.place_mm[k];
    pass(at, at + part);
    pass(at + part, at + 1.0);
    const double middle = 0.5 * (record.place_mm[k] + record.place_mm[std::min(k + 1, record.place_mm.size() - 1)]);
    travelled += (middle - record.place_mm[swing.from]) * record.tick_s;
  }
  return rows;
}

/// Takes the place and, unless it began at rest, the speed of the begin out of all columns.
void removeBegin(Rows& rows, bool from_rest) {
  rows.rowwise() -= Row(rows.colwise().mean());
  if (from_rest) return;
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(rows.rows(), -1.0, 1.0);
  rows -= line * (line.transpose() * rows) / line.squaredNorm();
}

struct Fit {
  Eigen::Vector4d shares = Eigen::Vector4d::Zero();  ///< 1/m, b/m, c/m, g/m
  double squares = std::numeric_limits<double>::infinity();
  std::size_t samples = 0;
};

Fit fitWith(const SwingRecord& record, const std::vector<HalfSwing>& swings, double delay) {
  Normal normal = Normal::Zero();
  Fit fit;
  for (const HalfSwing& swing : swings) {
    Rows rows = buildSwingRows(record, swing, delay);
    removeBegin(rows, swing.from_rest);
    normal += rows.transpose() * rows;
    fit.samples += static_cast<std::size_t>(rows.rows());
  }
  // Columns of one size: newtons and millimetres are far apart.
  const Eigen::Vector4d size = normal.diagonal().head<4>().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::Matrix4d scaled =
      size.cwiseInverse().asDiagonal() * normal.topLeftCorner<4, 4>() * size.cwiseInverse().asDiagonal();
  const Eigen::Vector4d wanted = normal.topRightCorner<4, 1>().cwiseQuotient(size);
  fit.shares = solved(scaled, wanted).cwiseQuotient(size);
  fit.squares = std::max(0.0, normal(4, 4) - normal.topRightCorner<4, 1>().dot(fit.shares));
  return fit;
}

/// The delay that leaves the least: coarse, then by thirds.
double bestDelay(const SwingRecord& record, const std::vector<HalfSwing>& swings) {
  constexpr double kCoarse = 0.25;
  const auto left = [&](double delay) { return fitWith(record, swings, delay).squares; };
  double best = 0.0;
  double least = left(0.0);
  for (double delay = kCoarse; delay <= kLongestDelay; delay += kCoarse) {
    const double squares = left(delay);
    if (squares < least) best = delay;
    least = std::min(least, squares);
  }
  double low = std::max(0.0, best - kCoarse);
  double high = best + kCoarse;
  while (high - low > 1e-4) {
    const double third = (high - low) / 3.0;
    (left(low + third) < left(high - third) ? high : low) += left(low + third) < left(high - third) ? -third : third;
  }
  return 0.5 * (low + high);
}

}  // namespace

SwingPlan swingPlan(const Capabilities& able, double tick_s) {
  return {.tick_s = tick_s,
          .most_force_n = able.max_force_n > 0.0 ? std::min(kMaxForce, kForceShare * able.max_force_n) : kUnknownForce};
}

Swings::Swings(const SwingPlan& plan) : plan_(plan), force_n_(plan.first_force_n) {
  const auto ticks = static_cast<std::size_t>(kLongestS / plan.tick_s) + 1;
  record_.tick_s = plan.tick_s;
  record_.place_mm.reserve(ticks);
  record_.force_n.reserve(ticks);
  record_.jumps.reserve(static_cast<std::size_t>(kLongestS / kMinSwingS));
}

Vec3 Swings::stop(const char* why) noexcept {
  trouble_ = why;
  finished_ = true;
  return Vec3::Zero();
}

/// Null: this tick may have a force.
const char* Swings::refusal(std::uint64_t tick, const Vec3& tip) const noexcept {
  if (!tip.allFinite()) return "the device has no position";
  const std::size_t known = record_.place_mm.size();
  if (known == 0) return nullptr;
  const double gap = static_cast<double>(tick) - static_cast<double>(known) + 1.0;
  if (gap > 1.0 + kMaxGapTicks) return "the loop was away for too long";
  if ((tip - start_).norm() > kMaxReaches * plan_.reach_mm) return "it went too far away";
  const double step = std::abs(tip.x() - start_.x() - record_.place_mm.back());
  if (step > kMaxSpeed * plan_.tick_s * gap) return "it moved too fast";
  if (static_cast<double>(tick) * plan_.tick_s >= kLongestS) return "it took too long";
  const bool restless = !swinging_ && static_cast<double>(phase_ticks_) * plan_.tick_s > kLongestRestS;
  return restless ? "it does not come to rest; it is held, or not balanced" : nullptr;
}

/// Ticks that were left out: the force stayed, the device went on its way.
void Swings::fillGap(std::uint64_t tick, double place) noexcept {
  while (!record_.place_mm.empty() && record_.place_mm.size() < tick) {
    const double left = static_cast<double>(tick - record_.place_mm.size() + 1);
    const double before = record_.place_mm.back();
    record_.place_mm.push_back(before + (place - before) / left);
    record_.force_n.push_back(record_.force_n.back());
  }
}

void Swings::watchRest(double place) noexcept {
  ++phase_ticks_;
  ++still_ticks_;
  if (std::abs(place - still_place_) <= kStill) return;
  still_place_ = place;
  still_ticks_ = 0;
}

/// Towards the start, so that swings do not wander off.
void Swings::beginSwing(double place) noexcept {
  swinging_ = true;
  from_ = place;
  rest_place_ = place + (place > 0.0 ? -plan_.reach_mm : plan_.reach_mm);
  travelled_ = 0.0;
  phase_ticks_ = still_ticks_ = 0;
  record_.jumps.push_back(record_.place_mm.size());
}

/// The next one begins from a rest without force: under the spring a device may creep, too slowly to be seen. A swing
/// that hardly passes the spring's rest place is friction more than anything else.
void Swings::endSwing() noexcept {
  swinging_ = false;
  phase_ticks_ = still_ticks_ = 0;
  const bool free = travelled_ >= kFreely * plan_.reach_mm || force_n_ >= plan_.most_force_n;
  if (free) ++swung_;
  if (!free) force_n_ = std::min(plan_.most_force_n, kStronger * force_n_);
}

double Swings::springForce(double place) const noexcept {
  const double stiffness = std::min(kStiffest, force_n_ / plan_.reach_mm);
  return std::clamp(stiffness * (rest_place_ - place), -plan_.most_force_n, plan_.most_force_n);
}

Vec3 Swings::tick(std::uint64_t tick, const Vec3& tip) noexcept {
  if (finished_) return Vec3::Zero();
  if (const char* why = refusal(tick, tip)) return stop(why);
  if (record_.place_mm.empty()) start_ = tip;
  const double place = tip.x() - start_.x();
  fillGap(tick, place);
  watchRest(place);
  const auto still = [&] { return static_cast<double>(still_ticks_) * plan_.tick_s >= kStillS; };
  const double phase_s = static_cast<double>(phase_ticks_) * plan_.tick_s;
  if (swinging_ && phase_s >= kMinSwingS && (still() || phase_s >= kLongestSwingS)) endSwing();
  if (!swinging_ && still() && swung_ >= plan_.swings) return stop(nullptr);
  if (!swinging_ && still()) beginSwing(place);
  travelled_ = std::max(travelled_, std::abs(place - from_));
  const double force = swinging_ ? springForce(place) : 0.0;
  record_.place_mm.push_back(place);
  record_.force_n.push_back(force);
  return {force, 0.0, 0.0};
}

DeviceIdentification identify(const SwingRecord& record) {
  const std::vector<HalfSwing> swings = halfSwings(record);
  const bool from_rest = std::any_of(swings.begin(), swings.end(), [](const HalfSwing& s) { return s.from_rest; });
  if (swings.size() < 2 || !from_rest) {
    throw Error(
        "the device did not swing: it is held, is at a mechanical stop, or its friction exceeds the allowed force");
  }
  DeviceIdentification found;
  found.delay_ticks = bestDelay(record, swings);
  const Fit fit = fitWith(record, swings, found.delay_ticks);
  const double per_mass = fit.shares[0];
  if (!(per_mass > 0.0)) throw Error("the device's motion does not follow the force; no mass fits");
  found.mass_kg = 1.0 / per_mass / kKilogram;
  found.damping_n_s_per_mm = fit.shares[1] / per_mass;
  found.friction_n = fit.shares[2] / per_mass;
  found.bias_n = fit.shares[3] / per_mass;
  found.residual_mm = std::sqrt(fit.squares / static_cast<double>(fit.samples));
  found.swings = swings.size();
  return found;
}

}  // namespace palpate::device
