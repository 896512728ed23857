// One finger's motion, tick by tick: how fast it moved, when it touched, when it searched and when it palpated.
//
//   samples of one finger ─► FingerMotion ─ speeds ─► ContactRuns, PhaseRuns ─► contacts, phases
//
// Memory for a few ticks only; recording_statistics.h collects what comes out. The rules are this program's own: no
// norm says when palpation begins. docs/reference/recordings.md has them in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "palpate/trace/sample.h"

namespace palpate::trace {

/// A speed is the way of so long a time over that time. An encoder's step of 0.05 mm is 50 mm/s from one tick to the
/// next but 2.5 mm/s over 20 ms, and no hand stops and goes within them.
inline constexpr double kSpeedWindowS = 0.02;
/// A finger that leaves the skin no longer than this has not left it: faster than anybody taps.
inline constexpr double kJoinedGapS = 0.02;
/// The ruler that paths are measured with: what trembles less goes nowhere.
inline constexpr double kPathStepMm = 0.1;
/// Below it a touch is light: 1 mm into skin of 0.5 N/mm, which finds its way but presses nothing.
inline constexpr double kLightForceN = 0.5;
/// Faster than this a finger dwells nowhere: a fingertip of 16 mm has left its place within 0.8 s.
inline constexpr double kDwellSpeedMmPerS = 20.0;
/// A shorter phase belongs to the one around it: no purpose changes four times a second.
inline constexpr double kMinPhaseS = 0.25;

/// How many ticks last so long; at least one.
std::uint64_t ticksIn(double seconds, double ticks_per_s);

/// mm/s; NaN where not known: in the first ticks, after a gap, after the finger was put elsewhere. That of the proxy
/// begins again when the skin is touched or left: the way down to it is none over it.
struct FingerSpeeds {
  double proxy = 0.0;
  double tip = 0.0;
};

class FingerMotion {
 public:
  explicit FingerMotion(double ticks_per_s);
  FingerSpeeds add(const Sample& sample);

 private:
  struct Place {
    std::uint64_t tick;
    Vec3 proxy;
    Vec3 tip;
  };
  /// NaN for a time that is too short.
  double speedOver(std::uint64_t ticks, double way_mm) const;

  double ticks_per_s_;
  std::uint64_t window_ticks_;
  std::deque<Place> places_;  ///< of the window
  bool touching_ = false;
  std::uint64_t turned_ = 0;  ///< the tick in which the skin was touched or left
};

/// The longest run of ticks that touch, shorter breaks than kJoinedGapS left out of account.
struct Contact {
  std::uint32_t finger = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t touching = 0;  ///< ticks; means are over them
  double peak_force_n = 0.0;
  double mean_force_n = 0.0;
  double peak_depth_mm = 0.0;
  double path_mm = 0.0;            ///< of the proxy over the skin, in steps of kPathStepMm
  Vec3 peak_place = Vec3::Zero();  ///< the proxy at the peak force
  std::uint64_t ticks() const { return last_tick - first_tick + 1; }
};

class ContactRuns {
 public:
  explicit ContactRuns(double ticks_per_s);
  /// A contact that is seen to have ended.
  std::optional<Contact> add(const Sample& sample);
  /// Returns the contact that is still under way.
  std::optional<Contact> finish();

 private:
  std::uint64_t gap_ticks_;
  std::optional<Contact> open_;
  double force_sum_n_ = 0.0;
  Vec3 counted_ = Vec3::Zero();  ///< the path is measured up to here
  Vec3 last_ = Vec3::Zero();
};

enum class Phase : std::uint8_t {
  away,       ///< off the skin
  search,     ///< on it, and lighter than kLightForceN or faster than kDwellSpeedMmPerS
  palpation,  ///< pressing in one place
};
inline constexpr std::size_t kPhases = 3;

Phase phaseOf(bool touching, double force_n, double proxy_speed_mm_per_s);

struct PhaseSpan {
  std::uint32_t finger = 0;
  Phase phase = Phase::away;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t ticks() const { return last_tick - first_tick + 1; }
};

/// A phase begins where what it is has held for kMinPhaseS. Where ticks are missing for longer than kJoinedGapS, one
/// ends and another begins.
class PhaseRuns {
 public:
  PhaseRuns(std::uint32_t finger, double ticks_per_s);
  std::optional<PhaseSpan> add(std::uint64_t tick, Phase now);
  std::optional<PhaseSpan> finish() const;

 private:
  void begin(std::uint64_t tick, Phase now);

  std::uint64_t gap_ticks_;
  std::uint64_t least_ticks_;
  bool begun_ = false;
  PhaseSpan current_;
  Phase next_ = Phase::away;      ///< what may follow
  std::uint64_t next_begin_ = 0;  ///< since then
};

}  // namespace palpate::trace
