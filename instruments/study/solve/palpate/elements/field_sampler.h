// The field of a press (tissue::PressField) read off the solver's own points, and the pattern of its pressure.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/elements/press_model.h"
#include "palpate/tissue/press_field.h"

namespace palpate::elements {

/// Press by press, at depths that increase.
class FieldSampler {
 public:
  FieldSampler(const PressModel& model, const tissue::LayerStack& stack);

  void add(double depth_mm, const Eigen::VectorXd& displacement);
  /// Without any press: empty.
  tissue::PressField field() const;

 private:
  /// Points of one layer: the same heights in every column.
  struct LayerPoints {
    std::vector<double> depths_mm;      ///< at rest, increasing
    std::vector<std::size_t> elements;  ///< column by column, from the axis: the layer's first from above
    std::size_t rows = 0;               ///< rows of elements
  };

  const PressModel& model_;
  tissue::PressField knots_;   ///< without densities
  std::vector<double> radii_;  ///< radii of the solver's points
  std::vector<LayerPoints> layers_;
  std::vector<std::vector<float>> shear_;  ///< one list per press, by row and radius
  std::vector<std::vector<float>> volume_;
};

/// Means over rings of this width from the middle, kPa: force along the axis over projected area.
std::vector<double> ringPressures(const std::vector<ContactRing>& rings, double width_mm);

/// q fitted to rings of half a millimetre, c where the skin leaves the sphere.
tissue::PressurePattern fitPressurePattern(const std::vector<ContactRing>& rings);

/// Pressures of a pattern with a sum of 1 N, over rings of this width.
std::vector<double> ringPressures(const tissue::PressurePattern& pattern, double width_mm, std::size_t count);

}  // namespace palpate::elements
