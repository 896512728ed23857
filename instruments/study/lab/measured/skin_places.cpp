// Triangles are drawn by area, by search in its running sum; then a place within one.
// Based on: Turk, "Generating random points in triangles", Graphics Gems, 1990.
#include "lab/measured/model_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/random.h"

namespace palpate::study {

namespace {

std::array<Vec3, 3> cornersOf(const mesh::TriangleMesh& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

// Evenly spread over the triangle: the square root keeps points from crowding at the first corner.
SkinPlace placeIn(const std::array<Vec3, 3>& corners, Random& random) {
  const double from_first = std::sqrt(random.uniform());
  const double towards_third = random.uniform();
  const Vec3 opposite = (1.0 - towards_third) * corners[1] + towards_third * corners[2];
  return {(1.0 - from_first) * corners[0] + from_first * opposite,
          mesh::areaVector2(corners[0], corners[1], corners[2]).normalized()};
}

}  // namespace

std::vector<SkinPlace> skinPlaces(const mesh::TriangleMesh& mesh, int count, std::uint64_t seed) {
  std::vector<double> area_up_to;
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = cornersOf(mesh, t);
    area += mesh::areaVector2(corners[0], corners[1], corners[2]).norm();
    area_up_to.push_back(area);
  }
  if (!(area > 0.0)) throw Error("study: the model has no area for a finger");
  Random random(seed);
  std::vector<SkinPlace> places;
  for (int i = 0; i < count; ++i) {
    const auto at = std::upper_bound(area_up_to.begin(), area_up_to.end(), random.uniform(0.0, area));
    const auto triangle = static_cast<std::size_t>(std::min(at, area_up_to.end() - 1) - area_up_to.begin());
    places.push_back(placeIn(cornersOf(mesh, triangle), random));
  }
  return places;
}

double longestTriangleEdge(const mesh::TriangleMesh& mesh) {
  double longest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = cornersOf(mesh, t);
    for (int i = 0; i < 3; ++i) longest = std::max(longest, (corners[(i + 1) % 3] - corners[i]).norm());
  }
  return longest;
}

}  // namespace palpate::study
