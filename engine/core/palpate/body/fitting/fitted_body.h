// The bones and landmarks of a fitted body, in the scan's frame and under its skin.
//
// body_fit.h, or a file of it -> here -> what a world knows of a body (scene/world.h).
#pragma once

#include <vector>

#include "palpate/body/fitting/body_fit.h"
#include "palpate/body/torso.h"

namespace palpate::body {

/// Those bones that are under the scan's skin, and those landmarks that it shows, on its skin.
struct FittedBody : BonesUnderSkin {
  std::vector<double> expected_mm;  ///< expected error of each landmark
};

/// No bone comes nearer to the scan's skin than this, mm.
inline constexpr double kMinFittedCoverMm = 3;

/// Throws Error when the scan is another one than the fit's, or moved.
FittedBody fittedBody(const TemplateBody& body, const BodyFit& fit, const mesh::TriangleMesh& scan);

}  // namespace palpate::body
