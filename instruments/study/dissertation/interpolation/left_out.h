// How well an interpolation predicts a measured ellipse that it has not seen (leave one out).
//
// An ellipse map of a few key points is exact at every key whatever lies between, so being exact says nothing. The
// ellipse at an unmeasured place counts: each measured point is left out in turn and predicted from the others.
// Based on: Ji (2008), section 5.2; Stone, "Cross-validatory choice and assessment of statistical predictions", 1974.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "palpate/maps/key_points.h"

namespace palpate::study {

enum class Interpolator : std::uint8_t {
  mean,        ///< one ellipse everywhere: the mean of the keys
  gri,         ///< the engine's: Gaussian radial interpolation over a basic circle of 150 mm
  gri_mean,    ///< the same over the mean of the keys
  thin_plate,  ///< the surface that bends least
  plane,       ///< polynomial of degree 1, least squares
  quadratic    ///< polynomial of degree 2
};
inline constexpr std::array kInterpolators{Interpolator::mean,       Interpolator::gri,   Interpolator::gri_mean,
                                           Interpolator::thin_plate, Interpolator::plane, Interpolator::quadratic};

/// An ellipse that was measured, or the mirror image of one.
struct PlacedTensor {
  Vec2 place_mm = Vec2::Zero();
  maps::LogTensor tensor = maps::LogTensor::Zero();
  int point = 1;  ///< P1 to P5; a mirror image has the number of what it mirrors
  bool mirrored = false;
};
using TensorSet = std::vector<PlacedTensor>;

/// The means of the subjects with P6 and P7, as the engine takes them.
TensorSet meanSet(maps::ForceDirection force);
/// One set a subject, each with mirror images of the subject's own P4 and P5.
std::vector<TensorSet> subjectSets(maps::ForceDirection force);

using TensorField = std::function<maps::LogTensor(const Vec2& place_mm)>;

/// Nothing where the keys do not determine it.
std::optional<TensorField> fieldThrough(const TensorSet& keys, Interpolator interpolator, double effect_radius_mm);

/// Root mean square distance in mm between two concentric boundaries, over all directions.
double boundaryRmsMm(const maps::LogTensor& a, const maps::LogTensor& b);

struct LeftOutErrors {
  double rms_mm = 0.0;       ///< error of the boundary, over all points predicted
  double most_mm = 0.0;      ///< the worst point
  double size_rms_mm = 0.0;  ///< error of the half major axis
  int predicted = 0;
  int undetermined = 0;           ///< points that the rest does not determine
  std::vector<double> each_mm{};  ///< error of the boundary, one a point predicted
};

/// Each point of each set predicted from the rest of its set; its mirror image is left out with it.
LeftOutErrors leftOutErrors(const std::vector<TensorSet>& sets, Interpolator interpolator, double effect_radius_mm);

/// How far a subject's boundary is from the mean of the other subjects at the same point: no map can predict it.
double subjectScatterMm(const std::vector<TensorSet>& subjects);

}  // namespace palpate::study
