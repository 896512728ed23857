// Force shading: a smooth stand-in for the facets under a point finger.
#pragma once

#include <optional>

#include "palpate/contact/finger.h"

namespace palpate::contact {

struct ShadedProxy {
  Vec3 position = Vec3::Zero();  ///< on the facets
  Vec3 normal = Vec3::Zero();    ///< unit, blended from the vertices
  double depth_mm = 0.0;         ///< from the tip along the normal
};

/// The place of the skin whose blended normal meets the tip, looked for from the proxy of the walk. Nothing when there
/// is none nearby: bumps smaller than the depth, borders.
std::optional<ShadedProxy> shadedProxy(const Surface& surface, const SurfacePoint& proxy, const Vec3& tip) noexcept;

}  // namespace palpate::contact
