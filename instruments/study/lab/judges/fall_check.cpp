// A small automaton over ticks, from outside to entered to held or fallen. A tick with force needs no question, so only
// the others pay for the side of their tip. A tip released near a border may have left there: its past is unknown.
// Data flow: tips and forces of a run -> here, afterwards -> FallReport.
#include "lab/judges/fall_check.h"

#include <algorithm>

namespace palpate::lab {
namespace {

/// Fingers solve their contact to 3e-4 r; this leaves them room and is still 8 um for a fingertip.
constexpr double kFeasibleShare = 0.999;

enum class Past { unknown, outside, entered, held, fallen };

/// Walks through the ticks and tracks the tip's state.
class FallJudge {
 public:
  FallJudge(SurfaceSide& surface, double radius) : surface_(surface), reach_(2.0 * radius) {}

  void add(const Observation& tick, std::size_t index) {
    if (tick.has_force) {
      if (past_ == Past::outside) ++report_.first_contacts;
      endWait(index);
      past_ = Past::held;
      held_at_ = tick.tip;
      return;
    }
    switch (surface_.sideOf(tick.tip, reach_)) {
      case Side::unknown:
        endWait(index), past_ = Past::unknown;
        break;
      case Side::outside:
        endWait(index), past_ = Past::outside;
        break;
      case Side::on_surface:
        break;
      case Side::inside:
        addInside(tick, index);
        break;
    }
  }
  FallReport finish(std::size_t ticks) {
    endWait(ticks);
    return report_;
  }

 private:
  /// A tip that came from outside is inside, without a force.
  void addInside(const Observation& tick, std::size_t index) {
    if (past_ == Past::held && surface_.sideOf(held_at_, reach_) == Side::unknown)
      past_ = Past::unknown;  // released at a border
    if (past_ == Past::unknown) return;
    if (past_ == Past::outside) {
      ++report_.first_contacts;
      entry_ = index;
      waiting_ = true;
      past_ = Past::entered;
    }
    if (tick.touching) return;
    if (past_ != Past::fallen) ++report_.events;
    past_ = Past::fallen;
    ++report_.ticks;
    if (!report_.first_tick) report_.first_tick = index;
  }
  /// The wait for a first force ends with the force, or with the tip's leaving.
  void endWait(std::size_t index) {
    if (waiting_) report_.first_contact_delay_ticks = std::max(report_.first_contact_delay_ticks, index - entry_);
    waiting_ = false;
  }

  SurfaceSide& surface_;
  double reach_;
  Past past_ = Past::unknown;
  Vec3 held_at_ = Vec3::Zero();
  std::size_t entry_ = 0;
  bool waiting_ = false;  ///< for the first force since `entry_`
  FallReport report_;
};

}  // namespace

FallReport checkFalls(SurfaceSide& surface, std::span<const Observation> ticks, double radius) {
  FallJudge judge(surface, radius);
  for (std::size_t k = 0; k < ticks.size(); ++k) judge.add(ticks[k], k);
  return judge.finish(ticks.size());
}

SphereReport checkSphere(SurfaceSide& surface, std::span<const Observation> ticks, double radius) {
  SphereReport report;
  for (const Observation& tick : ticks) {
    const NearestPoint nearest = surface.nearestTo(tick.touching ? tick.centre : tick.tip);
    const Vec3& from = tick.touching ? tick.centre : tick.tip;
    if (nearest.on_border || nearest.pseudo_normal.dot(from - nearest.point) < 0.0) continue;
    const bool near = nearest.distance < kFeasibleShare * radius;
    if (tick.touching) {
      report.least_distance = std::min(report.least_distance, nearest.distance / radius);
      report.infeasible_ticks += near ? 1 : 0;
    } else {
      report.missed_ticks += near ? 1 : 0;
    }
  }
  return report;
}

}  // namespace palpate::lab
