// Shapes and contacts that the deformation tests share.
#pragma once

#include <cmath>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"
#include "palpate/deform/deformer.h"
#include "palpate/mesh/triangle_mesh.h"
#include "support/mesh_zoo.h"

namespace palpate::test {

using namespace deform;

/// A closed torso: an ellipsoid 320 mm wide, 560 mm long and 200 mm deep.
inline mesh::TriangleMesh torso(int levels = 4) {
  mesh::TriangleMesh body = zoo::sphere(1.0, levels);
  for (Vec3& p : body.positions) p = p.cwiseProduct(Vec3(160.0, 280.0, 100.0));
  return body;
}

/// The triangle of a mesh whose centre is nearest to a point.
inline Index triangleNear(const mesh::TriangleMesh& mesh, const Vec3& point) {
  Index best = 0;
  double distance = INFINITY;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const double d = (centreOf(mesh, mesh.triangles[t]) - point).norm();
    if (d < distance) {
      distance = d;
      best = t;
    }
  }
  return best;
}

/// A finger at a place of a triangle, pressing straight in.
inline Contact press(const mesh::TriangleMesh& mesh, Index triangle, double depth_mm,
                     const Vec3& weights = Vec3::Ones() / 3) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  Contact contact;
  contact.anchor = weights[0] * mesh.positions[a] + weights[1] * mesh.positions[b] + weights[2] * mesh.positions[c];
  contact.anchor_triangle = triangle;
  contact.normal = mesh::areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).normalized();
  contact.depth_mm = depth_mm;
  contact.normal_region = normalRegion(contact.normal, depth_mm, {});
  contact.tangential_region = maps::liftedOntoSurface({60.0, 0.8, 0.7}, contact.normal);
  return contact;
}

/// The same finger, dragging the skin along.
inline Contact drag(Contact contact, const Vec3& along) {
  const Vec3 n = contact.normal.normalized();
  contact.drag_mm = along - along.dot(n) * n;
  return contact;
}

/// Any press and drag anywhere on the mesh, with any ellipses.
inline Contact anyContact(const mesh::TriangleMesh& mesh, Random& random) {
  const auto triangle = static_cast<Index>(random.below(mesh.triangles.size()));
  Vec3 weights = random.uniform3();
  Contact contact = press(mesh, triangle, random.uniform(-2.0, 15.0), weights / weights.sum());
  const auto ellipse = [&] {
    return maps::liftedOntoSurface({random.uniform(5, 90), random.uniform(0.3, 1.0), random.uniform(0, 3.1)},
                                   contact.normal);
  };
  contact.normal_region = ellipse();
  contact.tangential_region = ellipse();
  if (random.uniform() < 0.7) {
    contact = drag(contact, {random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(-25, 25)});
  }
  return contact;
}

inline std::vector<std::uint32_t> bits(const DeformedSurface& surface) {
  std::vector<std::uint32_t> all;
  const auto append = [&](std::span<const float> values) {
    for (const float value : values) all.push_back(std::bit_cast<std::uint32_t>(value));
  };
  for (int axis = 0; axis < 3; ++axis) {
    append(surface.position(axis));
    append(surface.normal(axis));
    append(surface.displacement(axis));
  }
  append(surface.strain());
  return all;
}

}  // namespace palpate::test
