// The deformation ellipses that were measured on five people, subject by subject, and their averages.
//
// Each row is the 2 mm contour round one point of one back while a stick dragged the skin up (towards the shoulder) or
// down (towards the waist). From here dissertationKeyPoints() (key_points.h) makes the built-in key points.
// Based on: Ji, dissertation 2008, section 5.1 and Appendix C; the log-Euclidean mean: see ellipse.h.
#pragma once

#include <span>
#include <vector>

#include "palpate/maps/ellipse.h"

namespace palpate::maps {

/// Direction of the stick's pull. All five subjects were dragged up, three of them also down; the two are not alike
/// (E31).
enum class ForceDirection : unsigned char { up, down };

enum class Averaging : unsigned char {
  plain,      ///< printed form: means of the axes, of the subjects' ratios and of the angles in degree
  tensorial,  ///< the log-Euclidean mean: knows that an axis has no sense and that a near-circle has hardly one (E30)
};

/// P1 to P5; P6 and P7 were not measured but mirrored.
inline constexpr int kMeasuredPoints = 5;

/// A row of Appendix C as printed: full axes. In four rows "major" is the shorter one (E30).
struct MeasuredEllipse {
  ForceDirection force = ForceDirection::up;
  int point = 1;    ///< 1 to 5
  int subject = 1;  ///< 1 to 5
  double major_cm = 0.0;
  double minor_cm = 0.0;
  double direction_deg = 90.0;  ///< the printed major axis against +x

  double majorOverMinor() const { return major_cm / minor_cm; }
};

/// All 40 rows in the printed order.
std::span<const MeasuredEllipse> appendixC();

/// The rows of one point (1 to 5), one per subject; empty for another number.
std::vector<MeasuredEllipse> measuredAt(ForceDirection force, int point);

/// An "Ave" row of Appendix C, not rounded.
struct PlainMean {
  double major_cm = 0.0;
  double minor_cm = 0.0;
  double major_over_minor = 1.0;  ///< mean of the subjects' unrounded ratios
  double direction_deg = 90.0;    ///< arithmetic mean
};

/// Rows must not be empty (both functions).
PlainMean plainMean(std::span<const MeasuredEllipse> rows);
/// Canonical half axes; a row whose "major" axis is the shorter one is an ellipse across its printed direction.
Ellipse tensorialMean(std::span<const MeasuredEllipse> rows);

/// Mean direction of undirected axes and how much they agree: 1 all alike, 0 no preference. At P5 it is 0.46: its
/// direction is hardly determined (E30).
struct AxialMean {
  double direction_deg = 90.0;  ///< in [0, 180)
  double resultant = 0.0;
};
AxialMean axialMean(std::span<const MeasuredEllipse> rows);

/// The mean as the dissertation's last table prints and uses it: rounded to 0.1 cm, 0.001 and 0.1 degree.
Ellipse asPrinted(const PlainMean& mean);

/// The mean as an ellipse. Plain: asPrinted.
Ellipse meanEllipse(std::span<const MeasuredEllipse> rows, Averaging averaging);

}  // namespace palpate::maps
