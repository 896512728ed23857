// Layered tissue of every thickness, ready to be asked at 60 Hz: tables of stacks turned into curves and blended.
//
// Tables (made by the solver, fitted, or the library's) ─ here, at load ─► nodes, thin to thick ─ a contact's thickness
// and depth ─► curves for `deform`; and the rows of a force law for `contact` (ForceLaw::layered). Blends are linear in
// the coefficients and in the logarithm of the thickness; docs/explanation/tissue.md says how far they are from solved
// stacks.
#pragma once

#include <span>
#include <vector>

#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_curve.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::tissue {

/// The force over the depth under a finger of one radius.
struct FingerSecants {
  double radius_mm = 0.0;
  std::vector<double> secants;  ///< N/mm, one per depth of the node
};

/// A stack's response as curves: a table without its radii.
struct LayeredNode {
  double thickness_mm = 0.0;         ///< of all layers
  std::vector<double> depths_mm;     ///< increasing
  std::vector<double> secants;       ///< force over depth there, N/mm, under the sphere that it was solved for
  std::vector<PressCurves> presses;  ///< there; all of one radius
  DragCurve drag;
  double tangential_over_normal = 0.7;
  /// By radius, increasing, the solved sphere's among them; none: every finger pushes as that one.
  std::vector<FingerSecants> fingers = {};
};

/// A table's own radii, where it has any; otherwise forces change with the radius as in the shipped stack that is
/// nearest in thickness and fat (fingersLikeLibrary). Throws Error for a table that check() refuses or that has too few
/// radii.
LayeredNode nodeOf(const LayeredTable& table);

/// Solved forces as LayeredNode::fingers, at the node's depths: beyond what was solved the force goes straight on.
std::vector<FingerSecants> fingersOf(const std::vector<FingerForces>& solved, double indenter_radius_mm,
                                     const LayeredNode& node);

/// Between two nodes; depths of `a`, beyond the last of `b` what that has. Secants blend as logarithms.
LayeredNode blended(const LayeredNode& a, const LayeredNode& b, double share);

/// The node with forces that grow by at most so much per mm, whatever the finger: as if something softer gave way
/// before it.
LayeredNode softenedTo(double most_n_per_mm, LayeredNode node);

/// Immutable; any number of threads.
class LayeredTissue {
 public:
  /// Thicknesses must differ; any order. Throws Error for none.
  explicit LayeredTissue(std::vector<LayeredNode> nodes);

  // Thicknesses beyond the thinnest and the thickest node count as theirs, depths likewise. No allocation.

  PressCurves pressAt(double thickness_mm, double depth_mm) const noexcept;
  DragCurve dragAt(double thickness_mm) const noexcept;
  /// k_t / k_n.
  double tangentialAt(double thickness_mm) const noexcept;
  /// F / d at a depth under a finger of this radius, N/mm: beyond the solved depths straight on, but no steeper than
  /// the stiffest tissue (kStiffestTissue). Straight between two radii; beyond them the first or last counts.
  double secantAt(double thickness_mm, double depth_mm, double finger_mm = kFingertipMm) const noexcept;
  /// The deepest that the skin goes here, mm: what was solved, and never to the bone.
  double deepestAt(double thickness_mm) const noexcept;

  double thinnest() const noexcept { return nodes_.front().thickness_mm; }
  double thickest() const noexcept { return nodes_.back().thickness_mm; }

  /// Whether the force depends on the finger's radius.
  bool knowsRadius() const noexcept;

  /// The law of all these places: rows by radius and thickness.
  LayeredForce forceRows() const;

 private:
  struct Between {
    const LayeredNode* a;
    const LayeredNode* b;
    double share;
  };
  Between between(double thickness_mm) const noexcept;

  std::vector<LayeredNode> nodes_;
};

}  // namespace palpate::tissue
