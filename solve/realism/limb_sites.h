// The eight sites of a limb that were pressed, and what a calibrated limb has there.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace palpate::lab {

struct LimbSite {
  std::string_view code;  ///< in the list
  std::string_view name;
  double bone_radius_mm = 0.0;  ///< typical of an adult's shaft: radius and ulna, humerus, tibia, femur
  /// Young's modulus of its muscle at rest: fitted to the people with odd numbers alone, skin and fat as everywhere
  /// (docs/explanation/realism.md says how).
  double muscle_kpa = 0.0;
};

std::span<const LimbSite> limbSites();
/// Null for another word.
const LimbSite* siteNamed(std::string_view code);
/// "LA_A, LA_P, ..."
std::string siteCodes();

}  // namespace palpate::lab
