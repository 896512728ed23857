// A node that is far away counts as one dipole with its first correction; triangles nearby by their exact solid angles.
// Data flow: box_tree.cpp -> here -> hunt_judge.h. A query is O(log n) where the point is not on the surface.
// Based on: Barill, Dickson, Schmidt, Levin, Jacobson, "Fast winding numbers for soups and clouds" (2018), Taylor
// expansion to its second term; Van Oosterom and Strackee, "The solid angle of a plane triangle" (1983).
#include "lab/judges/fast_winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {
namespace {

/// A node replaces its triangles from this many times its radius on. The paper's beta: 2 is its choice with one more
/// term; without it the middle of a ball, where all errors add up, needs 4.
constexpr double kFarOverRadius = 4.0;
constexpr double kFullAngle = 4.0 * std::numbers::pi;

/// Solid angle of a triangle seen from the origin as a share of all directions.
double windingShare(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double up = a.dot(b.cross(c));
  const double along = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return up == 0.0 && along == 0.0 ? 0.0 : 2.0 * std::atan2(up, along) / kFullAngle;
}

}  // namespace

FastWinding::FastWinding(const BoxTree& tree) : tree_(tree), dipoles_(tree.nodes().size()) {
  for (Index node = 0; node < dipoles_.size(); ++node) summarise(node);
}

void FastWinding::summarise(Index node) {
  const BoxNode& box = tree_.nodes()[node];
  Dipole& dipole = dipoles_[node];
  double total = 0.0;
  for (Index slot = box.first; slot < box.last; ++slot) {
    const auto& [a, b, c] = tree_.corners(slot);
    const Vec3 area = 0.5 * mesh::areaVector2(a, b, c);
    dipole.area += area;
    dipole.centre += area.norm() * (a + b + c) / 3.0;
    total += area.norm();
  }
  dipole.centre = total > 0.0 ? Vec3(dipole.centre / total) : Vec3(0.5 * (box.low + box.high));
  double radius2 = 0.0;
  for (Index slot = box.first; slot < box.last; ++slot) {
    const auto& [a, b, c] = tree_.corners(slot);
    dipole.spread += ((a + b + c) / 3.0 - dipole.centre) * 0.5 * mesh::areaVector2(a, b, c).transpose();
    for (const Vec3* corner : {&a, &b, &c}) radius2 = std::max(radius2, (*corner - dipole.centre).squaredNorm());
  }
  dipole.far2 = kFarOverRadius * kFarOverRadius * radius2;
}

double FastWinding::at(const Vec3& point) const {
  double sum = 0.0;
  std::array<Index, 96> open;  // median splits: two entries a level
  std::size_t size = 0;
  open[size++] = 0;
  while (size > 0) {
    const Index at = open[--size];
    const Dipole& dipole = dipoles_[at];
    const Vec3 r = dipole.centre - point;
    const double r2 = r.squaredNorm();
    if (r2 > dipole.far2) {
      const double r3 = r2 * std::sqrt(r2);
      const double second = dipole.spread.trace() - 3.0 * r.dot(dipole.spread * r) / r2;
      sum += (r.dot(dipole.area) + second) / (kFullAngle * r3);
      continue;
    }
    const BoxNode& node = tree_.nodes()[at];
    if (node.right != 0) {
      open[size++] = node.right;
      open[size++] = at + 1;
      continue;
    }
    for (Index slot = node.first; slot < node.last; ++slot) {
      const auto& [a, b, c] = tree_.corners(slot);
      sum += windingShare(a - point, b - point, c - point);
    }
  }
  return sum;
}

}  // namespace palpate::lab
