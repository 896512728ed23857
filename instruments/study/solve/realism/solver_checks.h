// The tissue solver against independent knowledge: Hertz, its own energy, finer meshes and shorter steps.
//
// docs/explanation/tissue.md has the same checks as bars of tests; here they are figures that a study can print.
#pragma once

#include <optional>
#include <vector>

#include "palpate/tissue/layered_table.h"

namespace palpate::lab {

/// A small press on a deep block of one material.
struct HertzCheck {
  double force_error = 0.0;    ///< fraction, absolute
  double contact_error = 0.0;  ///< error of the contact's radius: fraction, absolute
};
/// Throws Error where the press is not solved. A second or two.
HertzCheck checkHertz();

/// Work of the sphere against the energy that is stored: fraction of it, absolute. Throws Error as solvePress.
double energyError(const tissue::LayerStack& stack, double depth_mm);

/// One press on meshes of falling element size.
struct RefinedPress {
  std::vector<double> fineness;  ///< PressSettings::fineness, each twice the one before
  std::vector<double> force_n;   ///< as many
  /// From the differences of the last three; nothing unless they converge.
  std::optional<double> order;
  /// Index for the finest of the three: fraction of the force (gridConvergence).
  double grid_convergence = 0.0;
  /// The mesh that tables are solved on (fineness 1) against the finest: fraction, absolute.
  double default_error = 0.0;
};
/// Throws Error where a mesh does not reach the depth. `levels`: from fineness 0.5 on; at least 3.
RefinedPress refinePress(const tissue::LayerStack& stack, double depth_mm, std::size_t levels = 3);

/// The force with steps a third as long, fraction, absolute.
double stepError(const tissue::LayerStack& stack, double depth_mm);

/// Richardson's estimate from three results on meshes each twice as fine as the one before; none where they do not come
/// nearer and nearer from one side. Based on: Roache, "Perspective: A method for uniform reporting of grid refinement
/// studies", J. Fluids Eng. 116 (1994).
std::optional<double> observedOrder(double coarse, double middle, double fine);

/// The grid convergence index of the finest: 1.25 times the error by the order; 3 times the last difference where the
/// order is undefined.
double gridConvergence(double coarse, double middle, double fine);

}  // namespace palpate::lab
