// The shape of pressed skin from measured places: which form, how wide, how well it predicts places it has not seen.
//
//   skin_profiles.cpp ─ places of one depth ─► here: each form fitted ─► a table of layered tissue, a user's profile
//
// The skin goes down by u0 f(r), f(0) = 1. Places count by the area around them and by their number, half and half, so
// that neither the middle nor the wide rest rules. Misses are given as the project scores shapes: RMS over the area
// within 40 mm, over u0. Described in docs/explanation/tissue.md.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/tissue/fitting/bounded_fit.h"
#include "palpate/tissue/layered_table.h"
#include "palpate/tissue/profile_settings.h"

namespace palpate::tissue {

// The skin under a press as it was measured or simulated: places by their distance from the axis, depth by depth.

/// Under one depth of the indenter. By radius.
struct SkinProfile {
  double depth_mm = 0.0;
  std::vector<double> radius_mm;   ///< radius of the place at rest, >= 0
  std::vector<double> down_mm;     ///< into the body
  std::vector<double> outward_mm;  ///< away from the axis; empty: not measured
};

/// A header names the columns depth_mm, r_mm, down_mm and, where it was measured, outward_mm; other columns are left
/// alone. Rows of one depth belong together. By depth. Throws Error: file:line for a row that is not that, the file's
/// name when it holds no row. Files of at most 64 MB.
std::vector<SkinProfile> readSkinProfiles(const std::filesystem::path& file);

/// The same from text; messages call the file `name`.
std::vector<SkinProfile> parseSkinProfiles(std::string_view text, std::string_view name);

enum class ProfileForm : std::uint8_t {
  half_gaussian,  ///< radius_mm, where it has ended: the dissertation's
  power_tail,     ///< (1 + (r / width_mm)^2)^-exponent
  two_gaussians,  ///< narrow_mm, wide_mm, wide_weight: with a bulge where the weight is below 0
  measured,       ///< through the places themselves
};
inline constexpr std::array kProfileForms = {ProfileForm::half_gaussian, ProfileForm::power_tail,
                                             ProfileForm::two_gaussians, ProfileForm::measured};
std::string_view nameOf(ProfileForm form);

/// A smooth curve over the radius.
struct RadialCurve {
  std::vector<ProfileKnot> knots;  ///< q is the radius, mm
  std::vector<double> slopes;
};

struct ProfileFit {
  ProfileForm form = ProfileForm::half_gaussian;
  double depth_mm = 0.0;
  double surface_mm = 0.0;  ///< u0; the indenter's depth where no place within 2 mm of the axis was measured
  bool surface_measured = false;
  std::vector<FittedNumber> numbers = {};
  // The sideways motion: two terms amplitude (r / s) exp(1/2 - r^2 / 2 s^2), mm; 0 where it was not measured.
  std::array<double, 2> outward_mm = {};
  std::array<double, 2> outward_width_mm = {1.0, 1.0};
  RadialCurve measured_down = {};  ///< shares of u0; of the measured form
  RadialCurve measured_outward = {};
  double rms = 0.0;  ///< RMS of the way down, a fraction of u0
  double unseen_rms = 0.0;
  std::optional<double> vector_rms = {};  ///< with the sideways motion, where it was measured
  double largest_miss = 0.0;              ///< in the way down, a fraction of u0
  std::size_t places = 0;
};

/// Shares of u0 at a radius at rest.
double downShare(const ProfileFit& fit, double radius_mm);
double outwardShare(const ProfileFit& fit, double radius_mm);

/// Throws Error, which names the depth, for fewer than 6 places at different radii, or skin that does not go down.
ProfileFit fitProfile(const SkinProfile& profile, ProfileForm form);

/// The form that predicts unseen places best over all depths; of those nearly as good (within a twentieth) the one with
/// the fewest numbers. `fits`: per depth all forms in the order of kProfileForms.
ProfileForm bestForm(std::span<const std::vector<ProfileFit>> fits);

/// Radii of a table up to this: half a millimetre apart to 40 mm, two beyond.
std::vector<double> tableRadii(double to_mm);

/// A shape of a table; the force and the radius of the contact are left at 0.
PressedShape shapeOf(const ProfileFit& fit, const std::vector<double>& radii_mm);

/// One curve for all depths, for a scene's own profile (user_profile.h), and the region it needs.
struct SharedProfile {
  double radius_mm = 0.0;  ///< radius of the region at no depth, and ...
  double radius_per_depth = 0.0;
  std::vector<ProfileKnot> knots;
  double rms = 0.0;  ///< over all shapes within 40 mm, a fraction of u0
};

/// The region ends at six times the radius of half the depth, or where the table ends.
SharedProfile sharedProfile(const std::vector<double>& radii_mm, std::span<const PressedShape> shapes);

}  // namespace palpate::tissue
