// Distance of the product's feel and look from finite elements: its own run-time path on a flat slab.
//
//   table or library ─ scene::buildOn(flat skin over bone) ─► World ─ contact::step ─► force
//                                                              └─ engine::LivingSkin ─► surface ─► against the truth
// Nothing here knows how the product blends or displaces. Area-weighted RMS over 40 mm, divided by the depth of the
// centre; "vector" has the way outward too. docs/explanation/tissue.md.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/elements/drag_solver.h"
#include "palpate/scene/world.h"
#include "solve/realism/fem_cases.h"

namespace palpate::lab {

/// Errors of a shape.
struct ShapeError {
  double normal_rms = 0.0;  ///< fractions of the centre's depth
  double vector_rms = 0.0;
  double worst = 0.0;  ///< largest of the normal part, at a point
};

struct PressError {
  ShapeError shape;
  double force_n = 0.0;
  double force_error = 0.0;  ///< (felt - true) / true
};

/// A flat skin of 180 mm over bone so deep, felt and seen as a scene with this tissue model makes it. `tissue`: of
/// TissueModel::layered. `stiffness_n_per_mm`: the map's value for the other two.
std::shared_ptr<const scene::World> flatWorld(scene::TissueModel model,
                                              std::shared_ptr<const tissue::LayeredTissue> tissue, double thickness_mm,
                                              double stiffness_n_per_mm);

/// A press of the case's depth in the middle of it.
PressError pressError(const scene::World& world, const FemCase& truth, const std::vector<double>& radii_mm);

/// The force in N on a finger of this radius (0: a point), pressed into the middle.
double pressedForce(const scene::World& world, double radius_mm, double depth_mm);

/// A drag of the skin: RMS over 60 mm along and across, a square, of the share that follows.
double dragError(const scene::World& world, const elements::DragField& truth);

// The figure for realism: a row for each solved press, with the layered, the Gaussian and the literal skin.

/// A stack, solved; and the tissue that the product has for it.
struct JudgedStack {
  std::string name;
  FemCases truth = {};
  std::optional<elements::DragField> drag = {};  ///< solved too
  std::shared_ptr<const tissue::LayeredTissue> tissue = nullptr;
  double thickness_mm = 0.0;
};

struct JudgedPress {
  std::string name;
  double depth_mm = 0.0;
  bool layered_stack = false;  ///< more than one modulus
  double true_force_n = 0.0;
  PressError layered;
  PressError gaussian;
  PressError literal;
};

struct JudgedDrag {
  std::string name;
  bool layered_stack = false;
  double layered_rms = 0.0;  ///< fractions of the drag
  double gaussian_rms = 0.0;
};

/// Worst errors of layered stacks, for presses of at least `from_mm`.
struct WorstErrors {
  double normal_rms = 0.0;
  double vector_rms = 0.0;
  double force_error = 0.0;
};

struct RealismFigures {
  std::vector<JudgedPress> presses;
  std::vector<JudgedDrag> drags;
  std::vector<std::string> left_out;

  WorstErrors worst(PressError JudgedPress::*of, double from_mm) const;
  double worstDrag(double JudgedDrag::*of) const;
};

/// Shallower presses are shown, but their shape does not count.
inline constexpr double kJudgedFromMm = 5.0;

RealismFigures judgeRealism(const std::vector<JudgedStack>& stacks, const Progress& progress = {});

}  // namespace palpate::lab
