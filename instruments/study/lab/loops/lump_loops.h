// Checks that lumps give no energy away: fixed ones along closed paths, mobile ones under simulated hands.
//
// The oracle is the energy itself (contact::lumpEnergy, the skin's own) against the work of the forces that were felt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "palpate/base/progress.h"

namespace palpate::lab {

/// A point or a fingertip without friction goes along a closed path over fixed lumps and returns to where it was.
struct ClosedPathsPlan {
  std::size_t paths = 10000;
  double step_mm = 0.01;  ///< length of a step, on average
  std::uint64_t seed = 1;
  std::size_t threads = 0;  ///< 0: as many as there are processors
};

struct ClosedPathsFigures {
  /// The work of the lumps' forces over the most that they stored, of the worst path and on average, with steps so
  /// long.
  struct BySteps {
    double step_mm = 0.0;
    double worst_share = 0.0;
    double mean_share = 0.0;
  };
  std::size_t paths = 0;
  std::size_t ticks = 0;
  std::size_t lumps = 0;          ///< drawn
  double worst_work_n_mm = 0.0;   ///< work of the path with the worst share, at the plan's step
  double stored_n_mm = 0.0;       ///< the most that its lumps stored
  std::vector<BySteps> by_steps;  ///< at the plan's step, at twice and at four times as long ones
  double worstShare() const { return by_steps.empty() ? 0.0 : by_steps.front().worst_share; }
};

/// The work is summed by the trapezium rule, whose error falls with the square of the step.
ClosedPathsFigures measureClosedPaths(const ClosedPathsPlan& plan, const Progress& progress = {});

/// Devices and hands off their nominal values (random_loops.h) follow random goals over a mobile lump for some seconds
/// and then stay. Every second path has two fingers on one lump.
struct HeldLumpsPlan {
  std::size_t paths = 400;
  double seconds = 4.0;  ///< length of a path; for the last fifth the goals stay
  std::uint64_t seed = 1;
  std::size_t threads = 0;  ///< 0: as many as there are processors
};

struct HeldLumpsFigures {
  std::size_t paths = 0;
  std::size_t with_two_fingers = 0;
  std::size_t felt = 0;  ///< paths whose lump has moved by a tenth of a millimetre or more
  /// Largest energy returned beyond the stored one, N mm: skin and lumps gave this much more than they got.
  double given_back_n_mm = 0.0;
  double lost_n_mm = 0.0;       ///< by friction and drag of the lump, at most
  std::size_t oscillating = 0;  ///< tip or lump swings on at the end
  double farthest_mm = 0.0;     ///< farthest motion of a lump
};

HeldLumpsFigures measureHeldLumps(const HeldLumpsPlan& plan, const Progress& progress = {});

/// Random devices and hands, kicked and tapped over the middle of the stiffest lump that a scene can have.
struct StiffestLumpPlan {
  std::size_t systems = 100;
  double delay_ticks = 1.0;
  std::size_t threads = 0;
};

struct StiffestLumpFigures {
  std::size_t systems = 0;
  double slope_n_per_mm = 0.0;       ///< largest of skin and lump together
  std::size_t oscillating = 0;       ///< still after a kick
  std::size_t oscillating_bare = 0;  ///< the same without the passivity controller
  double port_energy_mj = 0.0;       ///< the most that the device gave after a tap at 0.5 m/s
};

StiffestLumpFigures measureStiffestLump(const StiffestLumpPlan& plan, const Progress& progress = {});

}  // namespace palpate::lab
