// Places of the body whose skin follows a curve of its own: the profile of 1.5 and ch. 6 "specified on different part
// of the body", in the place of the layers' curves or of those of [deformation].
//
// A profile becomes a curve of the kind that layered tissue has (tissue/layered_curve.h), which a contact can bring
// with it: so either way to displace the skin draws it, next to layers and half Gaussians elsewhere. Towards the edge
// of a place curves and regions go over into those around it. Forces stay as they are.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/deform/contact.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// How a profile and the curve that stands for it may differ, as a share of the depth or the drag.
inline constexpr double kMaxCurveError = 0.05;

struct FittedCurve {
  tissue::LayeredCurve curve;
  double error = 0.0;  ///< the largest difference
};

/// The curve nearest to a profile; 1 in the middle. `bend`: kPressBend or kDragBend. Throws Error for a profile that is
/// none.
FittedCurve fittedCurve(const tissue::ProfileSettings& profile, double bend);

struct PlaceCurve {
  Vec2 centre_mm = Vec2::Zero();
  double radius_mm = 0.0;
  double edge_softness = 0.0;
  double region = 1.0;
  tissue::LayeredCurve press, drag;
};

struct PlaceCurves {
  tissue::LayeredCurve press, drag;  ///< of the rest of a body without layers
  std::vector<PlaceCurve> places;
};

/// Those of a scene whose places are numbers already; null where it has none. A note for each place goes to `notes`.
/// Throws Error for a file that cannot be read and for a profile that no curve comes near enough (kMaxCurveError).
std::shared_ptr<const PlaceCurves> placeCurvesOf(const Scene& scene, const deform::FormSettings& forms,
                                                 std::vector<std::string>& notes);

/// The contact as it is at its place. `plain`: the same with the regions of [deformation], without layers. No
/// allocation; any thread.
deform::Contact withPlaceCurve(const PlaceCurves& curves, const deform::Contact& plain,
                               deform::Contact contact) noexcept;

}  // namespace palpate::scene
