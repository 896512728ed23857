// The meshes that stand in for the dissertation's models, which were never published.
#pragma once

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

inline constexpr std::size_t kBackTriangles = 2962;  ///< of the back of Figure 3.2
inline constexpr std::size_t kHandTriangles = 2818;  ///< of the hand of Appendix A (E13)

/// The built-in sheet of 350 x 400 x 120 mm without bones showing: made at once.
mesh::TriangleMesh backModel(std::size_t triangles = kBackTriangles);
/// The built-in hand; stands in for the bunny as the closed model.
mesh::TriangleMesh handModel();

/// The border of the back seen along z, a closed polygon in mm.
std::vector<Vec2> backOutline();
bool isInside(const std::vector<Vec2>& polygon, const Vec2& place);

}  // namespace palpate::study
