// Relaxing skin under a finger: pressed and held, pressed and released at several paces, left alone, dragged.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/contact/finger_state.h"

namespace palpate::study {

/// One reading of the skin, and a finger's forces on it.
struct RelaxingSkin {
  std::string name;
  contact::Relaxation relaxation;
  std::vector<double> held_n = {};   ///< at heldTimes()
  std::vector<double> dent_mm = {};  ///< at returnTimes(), since the finger left
  double friction_low = 0.0;         ///< tangential over normal force while it slips
  double friction_high = 0.0;
};

/// A press and its release, each as long, of the offered skin.
struct PressCycle {
  double stroke_s = 0.0;
  std::vector<double> depth_mm;
  std::vector<double> force_n;
  double lost_share = 0.0;  ///< share of the hand's work on the way down
};

struct RelaxationMeasurement {
  double depth_mm = 0.0;
  std::vector<RelaxingSkin> skins = {};  ///< none, as offered, as dead beef has it
  std::vector<PressCycle> cycles = {};   ///< from the fastest on
};

/// Seconds since the finger arrived.
std::vector<double> heldTimes();
std::vector<double> returnTimes();

RelaxationMeasurement measureRelaxation(bool quick, const Progress& progress);

// Findings from a measurement of relaxing skin, in sentences whose verdicts its numbers decide.

/// Share of the immediate force lost after `seconds` of holding, at the nearest of heldTimes().
double lostForceShare(const RelaxingSkin& skin, double seconds);

/// Recorded losses of dead beef and those of the skin that models it, at 0.2, 0.5, 1 and 10 s: shares of the force
/// (docs/explanation/force-laws.md).
struct BeefLoss {
  double seconds = 0.0;
  double recorded = 0.0;
  double lost = 0.0;
};
std::vector<BeefLoss> beefLosses(const RelaxationMeasurement& found);

/// Largest difference allowed.
inline constexpr double kBeefBar = 0.02;

std::vector<std::string> relaxationFindings(const RelaxationMeasurement& found);

}  // namespace palpate::study
