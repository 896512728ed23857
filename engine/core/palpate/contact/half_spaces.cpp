// Projection of a point on an intersection of half-spaces in three dimensions.
//
// Half-spaces are taken in one after the other. While the best point so far keeps the next one, nothing changes;
// otherwise the best point lies on its plane, and the same question is asked there with one dimension less. Any number
// of nearly parallel planes is harmless, which trying out all corners is not.
//
// Based on: Seidel, "Small-dimensional linear programming and convex hulls made easy" (1991), for a quadratic goal.
#include "palpate/contact/half_spaces.h"

#include <algorithm>
#include <limits>

namespace palpate::contact {

namespace {

/// Squared sine of the angle below which two planes count as parallel.
constexpr double kParallel = 1e-20;

/// On the line where planes i and j meet, under the planes before j.
bool nearestOnLine(const HalfSpaces& planes, int i, int j, const Vec3& target, double slack, Vec3& nearest) {
  const Vec3 along = planes[i].normal.cross(planes[j].normal);
  const double sine2 = along.squaredNorm();
  if (sine2 < kParallel) return true;  // plane j says nothing that plane i does not say more strictly
  // From the target: along plane i's normal and along the part of plane j's normal that lies in plane i.
  const double cosine = planes[i].normal.dot(planes[j].normal);
  const double miss_i = -planes[i].excess(target);
  const double miss_j = -planes[j].excess(target);
  const Vec3 base = target + ((miss_i - cosine * miss_j) / sine2) * planes[i].normal +
                    ((miss_j - cosine * miss_i) / sine2) * planes[j].normal;
  double low = -std::numeric_limits<double>::infinity();
  double high = -low;
  for (int k = 0; k < j; ++k) {
    const double rate = planes[k].normal.dot(along);
    const double room = planes[k].excess(base);
    if (rate * rate < kParallel * sine2) {
      if (room < -slack) return false;
    } else if (rate > 0.0) {
      low = std::max(low, -room / rate);
    } else {
      high = std::min(high, -room / rate);
    }
  }
  if (low > high + slack) return false;
  nearest = base + std::clamp(0.0, std::min(low, high), std::max(low, high)) * along;
  return true;
}

/// On plane i, under the planes before it.
bool nearestOnPlane(const HalfSpaces& planes, int i, const Vec3& target, double slack, Vec3& nearest) {
  nearest = target - planes[i].excess(target) * planes[i].normal;
  for (int j = 0; j < i; ++j) {
    if (planes[j].excess(nearest) >= -slack) continue;
    if (!nearestOnLine(planes, i, j, target, slack, nearest)) return false;
  }
  return true;
}

}  // namespace

bool nearestInside(const HalfSpaces& planes, const Vec3& target, double slack, Vec3& nearest) noexcept {
  Vec3 best = target;
  for (int i = 0; i < planes.size(); ++i) {
    if (planes[i].excess(best) >= -slack) continue;
    if (!nearestOnPlane(planes, i, target, slack, best)) return false;
  }
  nearest = best;
  return true;
}

}  // namespace palpate::contact
