// What the swept arrays say of Figure 4.9: the results, and sentences made of nothing but them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dissertation/profile/array_quality.h"

namespace palpate::study {

inline constexpr std::array kPrintedArrays{20, 130, 700};
inline constexpr std::array kArraySizes{10, 20, 50, 130, 300, 700, 2000, 7000};

/// Vertices 9.7 mm apart are those of the dissertation's back (2962 triangles on 350 x 400 mm).
inline constexpr double kPrintedSpacing = 9.7;
inline constexpr std::array kVertexSpacings{kPrintedSpacing, 1.0, 0.25};

/// A pixel of a life-size view on a monitor of 24 inch and 1920 columns.
inline constexpr double kPixelMm = 0.28;
/// A turn of 0.57 degree makes a matte surface lit from 45 degree brighter or darker by 1 %, about the least that an
/// eye tells between areas side by side (Weber fraction of brightness).
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

/// A paragraph each, most important first.
std::vector<std::string> profileFindings(const ProfileResults& results);

}  // namespace palpate::study
