// Effect of a stored half Gaussian on pressed skin, and the cost of a look-up in it (Figure 4.9).
//
// A section of the skin from the finger to the rim is pressed once with the array and once with the curve itself; what
// the array adds in steps and in turns of the surface normal is what an eye or a light can notice.
// Based on: Ji (2008), section 4.2.1, (4.3).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "palpate/tissue/profile_curve.h"

namespace palpate::study {

/// The largest error in mm at the dissertation's deepest press of 10 mm.
double worstArrayError(int entries, tissue::TableLookup lookup);

/// The array of (4.3), with the step at the rim that the text has.
tissue::ProfileCurve arrayProfile(int entries, tissue::TableLookup lookup);
/// The closed form of the same curve.
tissue::ProfileCurve closedProfile();

/// A press of the skin with a vertex every `spacing_mm` along the radius.
struct SkinSection {
  double radius_mm = 150.0;  ///< radius of the region; the measured half axes of the dissertation are about this long
  double depth_mm = 10.0;    ///< (4.15)
  double spacing_mm = 1.0;
};

struct ArrayQuality {
  int entries = 0;
  double error_mm = 0.0;              ///< largest distance from the curve
  double step_mm = 0.0;               ///< largest that two neighbouring vertices differ beyond the curve's own slope
  double second_difference_mm = 0.0;  ///< largest z(i+1) - 2 z(i) + z(i-1), the curve's own included
  double turn_deg = 0.0;              ///< largest turn of the normal from facet to facet beyond the curve's own
};

/// The worst over several places of the vertices relative to the finger.
ArrayQuality arrayQuality(int entries, tissue::TableLookup lookup, const SkinSection& section);

/// The second difference and the turn that the exact curve has on the same vertices; error and step are 0.
ArrayQuality curveQuality(const SkinSection& section);

/// Slope of log(error) over log(entries), least squares: -1 for errors that halve with twice the entries.
double convergenceSlope(std::span<const ArrayQuality> sweep);

/// Nanoseconds for one bare look-up of (4.3) at scattered location ratios, best of several runs.
double lookupNanoseconds(int entries, tissue::TableLookup lookup, bool quick);
/// The same for the closed form that the engine takes (tissue/profile.h).
double closedFormNanoseconds(bool quick);

// Findings from the swept arrays about Figure 4.9: the results, and sentences made of nothing but them.

inline constexpr std::array kPrintedArrays{20, 130, 700};
inline constexpr std::array kArraySizes{10, 20, 50, 130, 300, 700, 2000, 7000};

/// Vertices 9.7 mm apart are those of the dissertation's back (2962 triangles on 350 x 400 mm).
inline constexpr double kPrintedSpacing = 9.7;
inline constexpr std::array kVertexSpacings{kPrintedSpacing, 1.0, 0.25};

/// A pixel of a life-size view on a monitor of 24 inch and 1920 columns.
inline constexpr double kPixelMm = 0.28;
/// A turn of 0.57 degree makes a matte surface lit from 45 degree brighter or darker by 1 %, about the least an eye
/// sees between areas side by side (Weber fraction of brightness).
inline constexpr double kVisibleTurnDeg = 0.57;

/// One array a size of kArraySizes.
using ArraySweep = std::vector<ArrayQuality>;

struct LookupTimes {
  std::vector<double> nearest;  ///< ns, one a size
  std::vector<double> linear;
  double closed = 0.0;
};

struct ProfileResults {
  std::array<ArraySweep, kVertexSpacings.size()> nearest;  ///< one a spacing
  std::array<ArraySweep, kVertexSpacings.size()> linear;
  LookupTimes timing;
};

/// A size of the sweep, and its place in kArraySizes.
const ArrayQuality& ofSize(const ArraySweep& all, int entries);
std::size_t indexOf(int entries);

/// Paragraphs, most important first.
std::vector<std::string> profileFindings(const ProfileResults& results);

}  // namespace palpate::study
