// One pass over the triangles, one over the edges, each measure sorted once.
#include "cli/model/triangle_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/mesh/topology.h"

namespace palpate::app {

namespace {

ShapeSpread computeSpread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
  };
  return {values.front(), at(0.01), at(0.5), at(0.99), values.back()};
}

/// Sides and area of a triangle.
struct Measures {
  double a, b, c, area;

  Measures(const mesh::TriangleMesh& mesh, const Triangle& t)
      : a((mesh.positions[t[1]] - mesh.positions[t[2]]).norm()),
        b((mesh.positions[t[2]] - mesh.positions[t[0]]).norm()),
        c((mesh.positions[t[0]] - mesh.positions[t[1]]).norm()),
        area(0.5 * mesh::areaVector2(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).norm()) {}

  double aspect() const { return a * b * c * (a + b + c) / (16 * area * area); }
  /// Opposite the shortest side: the sine is twice the area over the other two.
  double smallestAngleDeg() const {
    const double others = a * b * c / std::min({a, b, c});
    return std::asin(std::min(1.0, 2 * area / others)) * kDegPerRad;
  }
};

std::vector<double> computeFoldAngles(const mesh::TriangleMesh& mesh) {
  std::vector<double> folds;
  folds.reserve(3 * mesh.triangles.size() / 2);
  const auto area = [&](const mesh::EdgeUse& use) {
    const Triangle& t = mesh.triangles[use.half_edge / 3];
    return mesh::areaVector2(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  };
  mesh::forEachEdge(mesh::edgeUses(mesh), [&](Index, Index, std::span<const mesh::EdgeUse> sides) {
    if (sides.size() != 2) return;
    const Vec3 one = area(sides[0]);
    const Vec3 other = area(sides[1]);
    if (one.isZero(0) || other.isZero(0)) return;
    folds.push_back(std::atan2(one.cross(other).norm(), one.dot(other)) * kDegPerRad);
  });
  return folds;
}

Json asJson(const ShapeSpread& spread) {
  return {{"least", spread.least}, {"p1", spread.p1}, {"p50", spread.p50}, {"p99", spread.p99}, {"most", spread.most}};
}

}  // namespace

TriangleShapes triangleShapes(const mesh::TriangleMesh& mesh) {
  std::vector<double> aspects;
  std::vector<double> angles;
  std::vector<double> areas;
  double area_sum = 0;
  double edge_sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Measures measures(mesh, t);
    if (!(measures.area > 0)) continue;
    aspects.push_back(measures.aspect());
    angles.push_back(measures.smallestAngleDeg());
    areas.push_back(measures.area);
    area_sum += measures.area;
    edge_sum += measures.a + measures.b + measures.c;
  }
  TriangleShapes shapes;
  const auto count = static_cast<double>(std::max<std::size_t>(areas.size(), 1));
  double squares = 0;
  for (double& area : areas) {
    area /= area_sum / count;
    squares += (area - 1) * (area - 1);
  }
  shapes.area_deviation = std::sqrt(squares / count);
  shapes.mean_edge_mm = edge_sum / (3 * count);
  shapes.fold_deg = computeSpread(computeFoldAngles(mesh));
  shapes.aspect = computeSpread(std::move(aspects));
  shapes.angle_deg = computeSpread(std::move(angles));
  shapes.area_of_mean = computeSpread(std::move(areas));
  return shapes;
}

std::string asText(const TriangleShapes& shapes) {
  const ShapeSpread& fold = shapes.fold_deg;
  const ShapeSpread& angle = shapes.angle_deg;
  const ShapeSpread& area = shapes.area_of_mean;
  return fmt::format(
      "edges       {:.3g} mm long; fold {:.2g} degrees in the middle, 99 % below {:.3g}, the sharpest {:.3g}\n"
      "triangles   smallest angle {:.3g} degrees in the middle, 1 % below {:.3g}, the least {:.3g}; aspect at most "
      "{:.3g}\n"
      "areas       deviate by {:.2g} of their mean; from {:.2g} to {:.3g} of it\n",
      shapes.mean_edge_mm, fold.p50, fold.p99, fold.most, angle.p50, angle.p1, angle.least, shapes.aspect.most,
      shapes.area_deviation, area.least, area.most);
}

Json asJson(const TriangleShapes& shapes) {
  Json json;
  json["mean_edge_mm"] = shapes.mean_edge_mm;
  json["fold_deg"] = asJson(shapes.fold_deg);
  json["aspect"] = asJson(shapes.aspect);
  json["smallest_angle_deg"] = asJson(shapes.angle_deg);
  json["area_of_mean"] = asJson(shapes.area_of_mean);
  json["area_deviation"] = shapes.area_deviation;
  return json;
}

}  // namespace palpate::app
