// Tangential Laplacian smoothing with one projection by the field's value along the vertex normal a round.
//
// Based on: Ohtake and Belyaev, "Dual/primal mesh optimization for polygonized implicit surfaces" (2002), the idea of
// alternating a tangential move and a projection.
#include "palpate/body/relax.h"

#include <algorithm>
#include <vector>

namespace palpate::body {
namespace {

constexpr double kStep = 0.6;  // share of the way to the neighbours' middle; 1 would overshoot on stretched fans

struct Surroundings {
  Vec3 corner_sum = Vec3::Zero();  // of the other two corners of each triangle
  Vec3 area_sum = Vec3::Zero();
  int corners = 0;
};

std::vector<Surroundings> gather(const mesh::TriangleMesh& mesh) {
  std::vector<Surroundings> around(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    const Vec3 area = mesh::areaVector2(a, b, c);
    const Vec3 sum = a + b + c;
    for (const Index v : t) {
      around[v].corner_sum += sum - mesh.positions[v];
      around[v].area_sum += area;
      around[v].corners += 2;
    }
  }
  return around;
}

Vec3 moved(const Vec3& p, const Surroundings& around, const Field& field) {
  const bool in_plane = p.x() == 0.0;
  Vec3 normal = around.area_sum;
  Vec3 shift = around.corner_sum / std::max(around.corners, 1) - p;
  if (in_plane) normal.x() = shift.x() = 0.0;
  normal = normal.stableNormalized();
  shift -= normal.dot(shift) * normal;
  const Vec3 there = p + kStep * shift;
  // No projection is longer than the move before it could have needed.
  const double reach = 0.5 * shift.norm() + 0.1;
  return there - std::clamp(field(there), -reach, reach) * normal;
}

}  // namespace

void relaxOnSurface(mesh::TriangleMesh& mesh, const Field& field, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Surroundings> around = gather(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.positions[v] = moved(mesh.positions[v], around[v], field);
    }
  }
}

}  // namespace palpate::body
