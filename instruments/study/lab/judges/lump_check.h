// Faults of lumps under a finger along a path. Uses their energies (tissue/lump_energy.h), their places and its own
// geometry; nothing of `contact` but plain data.
#pragma once

#include <span>
#include <vector>

#include "lab/judges/hunt_judge.h"
#include "palpate/contact/lump_force.h"

namespace palpate::lab {

/// Checks all fingers of a body at once: a finding counts ticks of the path, not of a finger.
class LumpCheck {
 public:
  LumpCheck(const contact::Lumps& lumps, const contact::FingerSettings& settings, std::size_t fingers);

  /// Before the first finger of a tick is felt: where the lumps were and are, and the presses that moved them.
  void moved(const contact::LumpPlaces& before, const contact::LumpPlaces& after,
             std::span<const contact::LumpPress> presses);
  /// The next tick of a finger, in their order; `press` as the finger remembers it.
  void add(std::size_t finger, const contact::LumpPress& press, const contact::LumpPlaces& places,
           const contact::FingerOutput& felt);
  /// Adds the findings.
  void addTo(HuntReport& report) const;

 private:
  struct Last {
    bool known = false;
    Vec3 tip = Vec3::Zero();
    Vec3 force = Vec3::Zero();
  };
  void judgeForce(const contact::LumpPress& press, const contact::LumpPlaces& places,
                  const contact::FingerOutput& felt);
  void judgeForceStep(const Last& last, const contact::FingerOutput& felt);
  void reportFault(Fault fault, const char* what, double measured, double bound);

  const contact::Lumps& lumps_;
  contact::FingerSettings settings_;
  std::vector<Last> last_;
  double steepest_n_per_mm_ = 0.0;  ///< sum over all lumps
  double shifted_mm_ = 0.0;         ///< in this tick, of the lump that moved most
  std::size_t tick_ = 0;
  std::array<Finding, kFaults> findings_;
};

}  // namespace palpate::lab
