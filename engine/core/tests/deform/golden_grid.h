// The reference grid of fsmd_grid.json: 21 x 21 vertices, 10 mm apart, flat.
#pragma once

#include <numbers>

#include "core/tests/deform/shapes.h"
#include "support/golden.h"

namespace palpate::test {

inline mesh::TriangleMesh goldenGrid() {
  mesh::TriangleMesh mesh;
  for (int j = 0; j < 21; ++j) {
    for (int i = 0; i < 21; ++i) mesh.positions.emplace_back(10.0 * (i - 10), 10.0 * (j - 10), 0.0);
  }
  for (Index j = 0; j < 20; ++j) {
    for (Index i = 0; i < 20; ++i) {
      const Index a = j * 21 + i;
      mesh.triangles.push_back({a, a + 1, a + 22});
      mesh.triangles.push_back({a, a + 22, a + 21});
    }
  }
  return mesh;
}

/// The contact of a case: both parts in its one ellipse.
inline Contact goldenContact(const mesh::TriangleMesh& grid, const nlohmann::json& c) {
  Contact contact;
  contact.anchor = vec3(c["O"]);
  contact.anchor_triangle = triangleNear(grid, contact.anchor);
  contact.normal = vec3(c["N"]);
  contact.depth_mm = c["depth"];
  contact.drag_mm = vec3(c["tangential"]);
  const double half_major = c["half_major"];
  const double direction = c["deg"].get<double>() * std::numbers::pi / 180.0;
  const auto ellipse = maps::canonicalEllipse(half_major, half_major / c["ratio"].get<double>(), direction);
  contact.normal_region = contact.tangential_region = maps::liftedOntoSurface(ellipse, contact.normal);
  return contact;
}

}  // namespace palpate::test
