// Reports of `palpate tissue realism` next to its figure: with --living and with --radius, for people and for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "solve/realism/living_limbs.h"

namespace palpate::app {

// Results of `palpate tissue realism --living`, for people and for programs.

/// People with odd numbers, whom the limb's muscles were fitted to, and with even ones, whom nothing was fitted to.
struct LivingHalves {
  lab::LivingFigures odd;
  lab::LivingFigures even;
};

struct LivingReport {
  std::size_t people = 0;
  int left_out = 0;
  LivingHalves body;          ///< LimbModel::body
  LivingHalves limb;          ///< LimbModel::limb
  LivingHalves relaxed_limb;  ///< LimbModel::relaxed_limb
};

/// Throws Error as lab::readLivingTests does.
LivingReport judgeLiving(const std::filesystem::path& list_or_folder, const Progress& progress = {});

Json livingJson(const LivingReport& report);
std::string livingText(const LivingReport& report);

// `palpate tissue realism --radius`: the force on fingers of other radii than a fingertip's, next to finite elements.

/// One press of a sphere.
struct RadiusPress {
  std::string name;
  double radius_mm = 0.0;
  double depth_mm = 0.0;
  double true_force_n = 0.0;  ///< by finite elements
  double force_n = 0.0;       ///< felt by the finger
  double fingertip_n = 0.0;   ///< would be felt by a fingertip of 8 mm: the force before the radius counted
  double error() const { return force_n / true_force_n - 1.0; }
};

struct RadiusReport {
  std::vector<RadiusPress> presses;
  std::vector<std::string> left_out;  ///< where the solver finds no equilibrium
  /// Fraction; of this radius, or of all (0).
  double worst(double radius_mm = 0.0) const;
};

/// Solves spheres of 2, 4, 8, 12 and 16 mm at three depths each over six places of a body, and presses the product's
/// own fingers there (some two minutes).
RadiusReport judgeRadius(const Progress& progress = {});

std::string radiusText(const RadiusReport& report);
Json radiusJson(const RadiusReport& report);

}  // namespace palpate::app
