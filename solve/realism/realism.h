// How far what the product feels and shows is from finite elements: its own run-time path on a flat slab.
//
//   table or library ─ scene::buildOn(flat skin over bone) ─► World ─ contact::step ─► force
//                                                              └─ engine::LivingSkin ─► surface ─► against the truth
// Nothing here knows how the product blends or displaces. Area-weighted RMS over 40 mm, divided by the depth of the
// centre; "vector" has the way outward too. docs/explanation/realism.md.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "palpate/elements/drag_solver.h"
#include "palpate/scene/world.h"
#include "solve/realism/fem_cases.h"

namespace palpate::lab {

/// What is judged.
struct ShapeError {
  double normal_rms = 0.0;  ///< fractions of the centre's depth
  double vector_rms = 0.0;
  double worst = 0.0;  ///< of the normal part, at a point
};

struct PressError {
  ShapeError shape;
  double force_n = 0.0;
  double force_error = 0.0;  ///< (felt - true) / true
};

/// A flat skin of 180 mm over bone so deep, felt and seen as a scene with this tissue model makes it. `tissue`: of
/// TissueModel::layered. `stiffness_n_per_mm`: what the map says for the other two.
std::shared_ptr<const scene::World> flatWorld(scene::TissueModel model,
                                              std::shared_ptr<const tissue::LayeredTissue> tissue, double thickness_mm,
                                              double stiffness_n_per_mm);

/// A press of the case's depth in the middle of it.
PressError pressError(const scene::World& world, const FemCase& truth, const std::vector<double>& radii_mm);

/// The force in N on a finger of this radius (0: a point), pressed into the middle.
double pressedForce(const scene::World& world, double radius_mm, double depth_mm);

/// A drag of the skin: RMS over 60 mm along and across, a square, of the share that follows.
double dragError(const scene::World& world, const elements::DragField& truth);

}  // namespace palpate::lab
