// How people find lumps: how a press differs from the same press without the lumps, and how often people notice the
// difference.
//
//   what a tick felt, Lumps, PressureGround ─ computeCue ─┐
//   a place, pressed with its lumps and without ─────┴─► LumpCue ─ computeClarity ─► C ─ detectionProbability ─► how
//   often it is found
//
// C = sqrt((force / its Weber fraction)^2 + (pattern / its Weber fraction)^2), found with P = 0.98 Phi(ln C / s). s is
// the spread of technique, attention and search, not of the senses alone. Fitted to groups of people who examined
// silicone breasts (docs/explanation/lumps.md), not to any one person.
#pragma once

#include <cstddef>
#include <memory>

#include "palpate/base/random.h"
#include "palpate/base/vec.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/pressure_field.h"

namespace palpate::lumps {

/// Strokes of a search lie so far apart, mm: a fingertip's width.
inline constexpr double kStrokesApartMm = 16.0;
/// Share of completely clear lumps that people miss by inattention.
inline constexpr double kInattention = 0.02;

/// Probability below x of a standard normal.
double standardNormalBelow(double x) noexcept;

struct LumpObserver {
  double force_weber = 0.08;     ///< clinicians' Weber fraction of the force (De Carvalho 2019)
  double pattern_weber = 0.036;  ///< for a taxel's pressure; fitted: 0.036 and 3.4, or 0.080 and 1.5 (1985)
  double spread = 3.4;           ///< s, of ln C
  bool field = true;             ///< feels the pattern; false: the force alone
  std::size_t taxels = 8;        ///< along a side of a fingertip that feels the pattern; 0 as without a field
};

/// Throws Error naming what makes no sense.
void check(const LumpObserver& observer);

/// Changes that lumps make to a press, over the same press without them at the same depth.
struct LumpCue {
  double force = 0.0;    ///< change of the normal force, as a share; negative over softer lumps
  double pattern = 0.0;  ///< the greatest rise of a taxel over itself; over softer lumps the greatest fall; >= 0
};

/// The cue in one tick. The press without lumps is FingerOutput without its lump_force: no second finger is needed.
/// Nothing for a finger that touches nothing. `taxels`: 0, or 2 to 16. No allocation; any thread.
LumpCue computeCue(const contact::FingerOutput& felt, const contact::Lumps* lumps,
                   const contact::PressureGround& ground, std::size_t taxels) noexcept;

/// The same of two presses that were felt, one with the lumps and one without, at one depth.
LumpCue computeCue(const contact::FingerOutput& with, const contact::FingerOutput& without, const contact::Lumps* lumps,
                   const contact::PressureGround& ground, std::size_t taxels) noexcept;

/// C >= 0; 1 is found half the time.
double computeClarity(const LumpCue& cue, const LumpObserver& observer) noexcept;

/// P that a person of the group finds a lump this clear.
double detectionProbability(double clarity, const LumpObserver& observer) noexcept;

/// P of naming, of two presses, the one over the lump: d' = C.
double twoIntervals(double clarity) noexcept;

// Simulated trainees: half of the spread (of its square) is between people, half between lumps.

/// Draws how much better than others a person is, in ln C: once per person.
double drawSkill(const LumpObserver& observer, Random& random);
/// Whether a person of this skill finds it: drawn once a lump.
bool finds(double clarity, double skill, const LumpObserver& observer, Random& random);
/// How far from the lump the nearest of evenly laid strokes passes, mm, to either side.
double drawStroke(Random& random);

// Presses for the sake of the cue, by contact::step, as for a finger of a simulator or of a servo loop.

/// One skin felt twice, with its lumps and without. Immutable; any number of threads.
class ComparedSkin {
 public:
  /// Throws Error for settings that contact::check refuses.
  ComparedSkin(contact::Surface surface, std::shared_ptr<const contact::PressureGround> ground,
               const contact::FingerSettings& finger);

  struct Press {
    contact::FingerOutput with;
    contact::FingerOutput without;
    bool reached = false;  ///< the force came before the tissue, or the finger's greatest depth, ended
  };
  /// Down onto a place of the skin along its normal, until the skin without lumps pushes with this force; then as deep
  /// over the lumps.
  Press press(const Vec3& place, const Vec3& normal, double force_n) const;
  LumpCue cue(const Press& press, std::size_t taxels) const noexcept;

  const contact::Surface& surface() const { return with_; }
  const contact::PressureGround& ground() const { return *ground_; }
  const contact::FingerSettings& finger() const { return finger_; }

 private:
  contact::Surface with_;
  contact::Surface without_;
  std::shared_ptr<const contact::PressureGround> ground_;
  contact::FingerSettings finger_;
};

}  // namespace palpate::lumps
