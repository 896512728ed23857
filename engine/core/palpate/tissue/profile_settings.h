// Which displacement profile is wanted: the settings from which a ProfileCurve is made.
//
// Scene files and callers fill this; profile_curve.h evaluates it. Every length is a share of the deformation region:
// location ratio q, 0 under the finger, 1 on the rim.
// Based on: Ji, dissertation 2008, sections 4.1 to 4.3 and Table 4.2; docs/reference/deformation-forms.md says what
// each form is for.
#pragma once

#include <cstdint>
#include <vector>

namespace palpate::tissue {

enum class ProfileKind : std::uint8_t {
  half_gaussian,  ///< (4.1) in closed form
  table,          ///< the half Gaussian through a stored array (4.3)
  sharp,          ///< under a sharp object: the Gaussian without the part between its inflection points (Fig 4.4)
  cosine,         ///< half a period of the cosine (Table 4.2)
  logarithm,      ///< Table 4.2
  two_gaussians,  ///< with a bulge around the finger
  power,          ///< (1 + (q/s)^2)^-p, windowed: the heavy tail of a drag
  user,           ///< from a table of the user's
};

/// Treatment of the rest of a curve that has not come down to 0 at the rim (E18).
enum class ProfileRim : std::uint8_t {
  lowered,  ///< subtracted and stretched back to 1: no step
  step,     ///< kept: the printed form, 0.2 % of the depth for the Gaussian
  smooth,   ///< faded out over the last fifth: neither a step nor a kink
};

enum class TableLookup : std::uint8_t { nearest, linear };

enum class UserInterpolation : std::uint8_t { monotone_cubic, linear };

/// One row of a user's curve.
struct ProfileKnot {
  double q = 0.0;
  double value = 0.0;
};

/// (1 - w) exp(-(q/narrow)^2) + w exp(-(q/wide)^2). The defaults are the fit to a finite element model of a bony site
/// (2 mm skin, 4 mm fat, 9 mm muscle; 5 to 10 mm deep) with the rim at twice the half Gaussian's radius: the bulge
/// lies where the half Gaussian has ended.
struct TwoGaussians {
  double narrow = 0.235;
  double wide = 0.5;
  double wide_weight = -0.2;  ///< w; below 0 makes a bulge
};

/// (1 + (q/width)^2)^-exponent. The exponent fits a drag over layered tissue of a mid back (finite elements, 0.83); the
/// width puts a tenth of the drag where the half Gaussian has it, at q = 0.61.
struct PowerTail {
  double width = 0.16;
  double exponent = 0.83;
};

struct ProfileSettings {
  ProfileKind kind = ProfileKind::half_gaussian;
  ProfileRim rim = ProfileRim::lowered;
  std::size_t table_entries = 700;  ///< at least 2; 700 is the dissertation's choice
  TableLookup lookup = TableLookup::nearest;
  TwoGaussians two_gaussians;
  PowerTail power;
  std::vector<ProfileKnot> knots;  ///< kind user: as readProfileKnots gives them
  UserInterpolation interpolation = UserInterpolation::monotone_cubic;
};

}  // namespace palpate::tissue
