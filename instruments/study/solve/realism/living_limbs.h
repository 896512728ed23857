// The default layers against living limbs: the stiffness under the same probe, test by test.
//
//   list of tests ─ thickness, skin, fat ─► stack ─ elements::probeStiffness, between solved stacks ─► N/mm ─► over the
//   measured N/mm ─► figures of two halves of people
// People with odd numbers are for fitting and trying; those with even ones for judging, and nothing was fitted to them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "solve/realism/living_tests.h"

namespace palpate::lab {

// The eight pressed sites of a limb, and a calibrated limb's layers there.

struct LimbSite {
  std::string_view code;  ///< in the list
  std::string_view name;
  double bone_radius_mm = 0.0;  ///< typical of an adult's shaft: radius and ulna, humerus, tibia, femur
  /// Young's modulus of its muscle at rest: fitted to the people with odd numbers alone, skin and fat as everywhere
  /// (docs/explanation/tissue.md says how).
  double muscle_kpa = 0.0;
};

std::span<const LimbSite> limbSites();
/// Null for another word.
const LimbSite* siteNamed(std::string_view code);
/// "LA_A, LA_P, ..."
std::string siteCodes();

/// Limits of the covers that are distinguished, mm.
inline constexpr std::array<double, 6> kCoverLimitsMm = {8.0, 15.0, 25.0, 40.0, 60.0, 100.0};

struct LivingFigures {
  std::size_t tests = 0;
  double median_error = 0.0;  ///< |product / living - 1|
  double bias = 0.0;          ///< median of product / living - 1
  double spread_error = 0.0;  ///< median error after the one factor that takes the bias away
  struct Cover {
    double ratio = 0.0;  ///< median of product / living; 0 without tests
    std::size_t tests = 0;
  };
  std::array<Cover, kCoverLimitsMm.size() - 1> covers;

  double thinCoverRatio() const { return covers.front().ratio; }
};

/// Compares tests with their stiffness by the model, N/mm, in order.
LivingFigures livingFigures(std::span<const LivingTest> tests, std::span<const double> n_per_mm);

enum class LimbModel {
  body,          ///< the default layers as a body has them: skin of 2 mm, bone as a plane
  limb,          ///< the default moduli; the test's own skin, bone as a cylinder and the limb's free sides
  relaxed_limb,  ///< the same with the muscle of each site at rest (LimbSite)
};

/// Stiffness of each test's layers under the probe, N/mm. Solves some stacks: about half a minute for `relaxed_limb`.
std::vector<double> probeStiffnesses(std::span<const LivingTest> tests, LimbModel model, const Progress& progress = {});

/// The probe: 360 mm^2, as long as its picture is wide (37 mm) and a little more.
inline constexpr double kProbeLengthMm = 40.0;

}  // namespace palpate::lab
