// Nearest point of a triangle by Voronoi regions: corners first, then edges, then the face.
//
// Based on: Ericson, "Real-Time Collision Detection" (2005), section 5.1.5; the guard for slivers is our own.
#include "palpate/tree/closest_on_triangle.h"

#include <algorithm>

namespace palpate::tree {

namespace {

ClosestOnTriangle resultAt(const Vec3& closest, Feature feature, const Vec3& point) {
  return {closest, feature, (closest - point).squaredNorm()};
}

/// The place `t` of the way along an edge, or the corner there.
ClosestOnTriangle resultOnEdge(const std::array<Vec3, 3>& corners, int edge, double t, const Vec3& point) {
  const Vec3& start = corners[edge];
  const Vec3& end = corners[(edge + 1) % 3];
  if (t <= kOnBorder) return resultAt(start, cornerFeature(edge), point);
  if (t >= 1.0 - kOnBorder) return resultAt(end, cornerFeature((edge + 1) % 3), point);
  return resultAt(start + t * (end - start), edgeFeature(edge), point);
}

ClosestOnTriangle closestOnEdge(const std::array<Vec3, 3>& corners, int edge, const Vec3& point) {
  const Vec3 along = corners[(edge + 1) % 3] - corners[edge];
  const double length2 = along.squaredNorm();
  return resultOnEdge(corners, edge, length2 > 0.0 ? (point - corners[edge]).dot(along) / length2 : 0.0, point);
}

ClosestOnTriangle closestOnEdges(const std::array<Vec3, 3>& corners, const Vec3& point) {
  ClosestOnTriangle best = closestOnEdge(corners, 0, point);
  for (int edge = 1; edge < 3; ++edge) {
    const ClosestOnTriangle other = closestOnEdge(corners, edge, point);
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

}  // namespace

ClosestOnTriangle closestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& point) noexcept {
  const Vec3& a = corners[0];
  const Vec3& b = corners[1];
  const Vec3& c = corners[2];
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = point - a;
  const double ab_ap = ab.dot(ap);
  const double ac_ap = ac.dot(ap);
  if (ab_ap <= 0.0 && ac_ap <= 0.0) return resultAt(a, Feature::corner0, point);

  const double ab_ab = ab.dot(ab);
  const double ac_ac = ac.dot(ac);
  const double ab_ac = ab.dot(ac);
  const double ab_bp = ab_ap - ab_ab;
  const double ac_bp = ac_ap - ab_ac;
  if (ab_bp >= 0.0 && ac_bp <= ab_bp) return resultAt(b, Feature::corner1, point);
  const double ab_cp = ab_ap - ab_ac;
  const double ac_cp = ac_ap - ac_ac;
  if (ac_cp >= 0.0 && ab_cp <= ac_cp) return resultAt(c, Feature::corner2, point);

  // Cross products instead of Gram determinants: a sliver of aspect e keeps 1/e more digits.
  const Vec3 bc = c - b;
  const Vec3 normal = ab.cross(ac);
  const double area2_squared = normal.squaredNorm();
  const double longest2 = std::max({ab_ab, ac_ac, bc.squaredNorm()});
  if (area2_squared <= kSliverShare * longest2 * longest2) return closestOnEdges(corners, point);

  const double on_border = kOnBorder * area2_squared;
  const double weight_c = normal.dot(ab.cross(ap));
  if (weight_c <= on_border && ab_ap >= 0.0 && ab_bp <= 0.0) return resultOnEdge(corners, 0, ab_ap / ab_ab, point);
  const double weight_b = normal.dot(ap.cross(ac));
  if (weight_b <= on_border && ac_ap >= 0.0 && ac_cp <= 0.0) {
    return resultOnEdge(corners, 2, 1.0 - ac_ap / ac_ac, point);
  }
  const double weight_a = normal.dot(bc.cross(point - b));
  const double towards_c = ac_bp - ab_bp;
  const double towards_b = ab_cp - ac_cp;
  if (weight_a <= on_border && towards_c >= 0.0 && towards_b >= 0.0) {
    return resultOnEdge(corners, 1, towards_c / (towards_c + towards_b), point);
  }
  // Rounding may leave a point in no region at all, just outside a corner.
  if (!(weight_a > 0.0 && weight_b > 0.0 && weight_c > 0.0)) return closestOnEdges(corners, point);
  const double sum = weight_a + weight_b + weight_c;
  return resultAt(a + (weight_b / sum) * ab + (weight_c / sum) * ac, Feature::face, point);
}

Vec3 barycentricWeights(const std::array<Vec3, 3>& corners, const Vec3& point) noexcept {
  const Vec3 ab = corners[1] - corners[0];
  const Vec3 ac = corners[2] - corners[0];
  const Vec3 ap = point - corners[0];
  const double ab_ab = ab.squaredNorm();
  const double ac_ac = ac.squaredNorm();
  const Vec3 normal = ab.cross(ac);
  const double area2_squared = normal.squaredNorm();
  const double longest2 = std::max({ab_ab, ac_ac, (ac - ab).squaredNorm()});
  Vec3 weights(1.0, 0.0, 0.0);
  if (area2_squared > kSliverShare * longest2 * longest2) {
    weights[1] = normal.dot(ap.cross(ac)) / area2_squared;
    weights[2] = normal.dot(ab.cross(ap)) / area2_squared;
    weights[0] = 1.0 - weights[1] - weights[2];
  } else if (longest2 > 0.0) {
    const int start = longest2 == ab_ab ? 0 : (longest2 == ac_ac ? 2 : 1);
    const Vec3 along = corners[(start + 1) % 3] - corners[start];
    weights = Vec3::Zero();
    weights[(start + 1) % 3] = along.dot(point - corners[start]) / longest2;
    weights[start] = 1.0 - weights[(start + 1) % 3];
  }
  weights = weights.cwiseMax(0.0).cwiseMin(1.0);
  return weights / weights.sum();
}

}  // namespace palpate::tree
