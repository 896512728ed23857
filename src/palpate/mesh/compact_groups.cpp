#include "palpate/mesh/compact_groups.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpate::mesh {

namespace {

/// Floats: half the memory to move, and a cut is as good a tenth of a micrometre beside the middle.
struct Placed {
  Vec3f point;
  Index place;  // in the given order
};

Vec3f finite(const Vec3& point) {
  return point.cast<float>().unaryExpr([](float x) { return std::isfinite(x) ? x : 0.0f; });
}

int longestAxis(std::span<const Placed> points) {
  Eigen::AlignedBox3f box;
  for (const Placed& placed : points) box.extend(placed.point);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  return axis;
}

/// How many of these points go to the lower half: whole groups of groups while there are several, then whole groups, a
/// power of two, so that no later cut falls within one.
std::size_t lowerHalf(std::size_t points) {
  const auto units_for = [](std::size_t n) { return (n + kCompactGroup - 1) / kCompactGroup; };
  const std::size_t groups = units_for(points);
  const std::size_t large = units_for(groups);
  const std::size_t lower = large > 1 ? (large + 1) / 2 * kCompactGroup : std::bit_ceil(groups) / 2;
  return lower * kCompactGroup;
}

void split(std::span<Placed> points) {
  if (points.size() <= kCompactGroup) {
    std::sort(points.begin(), points.end(), [](const Placed& a, const Placed& b) { return a.place < b.place; });
    return;
  }
  const int axis = longestAxis(points);
  const auto middle = static_cast<std::ptrdiff_t>(lowerHalf(points.size()));
  std::nth_element(points.begin(), points.begin() + middle, points.end(), [axis](const Placed& a, const Placed& b) {
    return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.place < b.place;
  });
  split(points.first(static_cast<std::size_t>(middle)));
  split(points.subspan(static_cast<std::size_t>(middle)));
}

}  // namespace

std::vector<Index> inCompactGroups(std::span<const Vec3> points, std::span<const Index> order) {
  std::vector<Placed> placed;
  placed.reserve(order.size());
  for (Index i = 0; i < order.size(); ++i) placed.push_back({finite(points[order[i]]), i});
  split(placed);
  std::vector<Index> sorted;
  sorted.reserve(order.size());
  for (const Placed& p : placed) sorted.push_back(order[p.place]);
  return sorted;
}

}  // namespace palpate::mesh
