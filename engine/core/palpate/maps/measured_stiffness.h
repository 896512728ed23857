// Stiffness from measured key points: three ways through the same measurements, each with how far it is from them.
//
//   gri         the engine's default, exact at the keys, never beyond what was measured (gaussian_interpolation.h)
//   thin_plate  exact at the keys, the smoothest surface between them (thin_plate_spline.h)
//   polynomial  the trend, not exact at the keys (polynomial_surface.h)
// From here the scene and `palpate body map stiffness` get a value a vertex; stiffness_map.h then adds dysfunctions.
// Based on: Ji, dissertation 2008, section 5.2; the alternatives name their sources in their files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "palpate/maps/key_points.h"
#include "palpate/maps/polynomial_surface.h"
#include "palpate/maps/thin_plate_spline.h"

namespace palpate::maps {

/// In the order of the names in scene files.
enum class StiffnessInterpolation : std::uint8_t { gri, thin_plate, polynomial };

struct MeasuredStiffness {
  double effect_radius_mm = 200.0;  ///< gri: reach of a measured point in the map plane
  double basic_n_per_mm = 0.5;      ///< gri: outside the keys' reach
  StiffnessInterpolation interpolation = StiffnessInterpolation::gri;
  std::size_t polynomial_degree = 2;
};

/// Difference between the field and the measured values at the key points.
struct FitError {
  double rms = 0.0;
  double max = 0.0;
};

class MeasuredStiffnessField {
 public:
  /// Fits the key points that have a stiffness. Throws Error where thin_plate or polynomial has too few of them or they
  /// are too nearly in line; gri accepts any number, even none.
  explicit MeasuredStiffnessField(std::span<const KeyPoint> keys, const MeasuredStiffness& settings = {});

  /// As fitted: thin_plate and polynomial may run away beyond the key points. O(number of key points), no allocation.
  double fittedAt(const Vec2& place_mm) const noexcept;

  /// Kept within limits(), hence above 0 for thin_plate and polynomial.
  double at(const Vec2& place_mm) const noexcept;

  /// A quarter of the smallest to four times the largest measured value, and at least 0.01 N/mm; no limits for gri,
  /// which stays between its values by itself.
  const std::pair<double, double>& limits() const noexcept { return limits_; }

  /// N/mm. Covers the fitted key points; coincident keys that differ count with their difference from the mean.
  const FitError& fitError() const noexcept { return error_; }

 private:
  struct Gri {
    std::vector<KeyPoint> keys;
    double effect_radius_mm;
    double basic_n_per_mm;
    double at(const Vec2& place_mm) const noexcept;
  };
  using Field = std::variant<Gri, ThinPlateSpline, PolynomialSurface>;
  static Field fitted(const std::vector<KeyPoint>& keys, const MeasuredStiffness& settings);

  Field field_;
  std::pair<double, double> limits_;
  FitError error_;
};

struct StiffnessOfPositions {
  std::vector<double> n_per_mm;  ///< one per position
  std::size_t limited = 0;       ///< values that were clamped to the limits
  FitError error;
};

/// O(positions x key points). Throws Error like MeasuredStiffnessField.
StiffnessOfPositions measuredStiffness(std::span<const Vec3> positions, std::span<const KeyPoint> keys,
                                       const MeasuredStiffness& settings = {});

}  // namespace palpate::maps
