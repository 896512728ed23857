// Shapes as segments and triangles. A box's corners are numbered by bits, one per axis: an edge changes one bit.
// Data flow: overlays -> here -> painted points -> line_layer.h, each picture.
#include "palpate/view/lines.h"

#include <algorithm>
#include <cmath>

namespace palpate::view {

void Lines::addPath(std::span<const Vec3> path, Paint paint) {
  for (std::size_t i = 1; i < path.size(); ++i) add(path[i - 1], path[i], paint);
}

void Lines::addBox(const Eigen::AlignedBox3d& box, Paint paint) {
  using Box = Eigen::AlignedBox3d;
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = corner | (1 << axis);  // corners count x, y, z as bits
      if (other == corner) continue;
      add(box.corner(static_cast<Box::CornerType>(corner)), box.corner(static_cast<Box::CornerType>(other)), paint);
    }
  }
}

void Lines::addArrow(const Vec3& from, const Vec3& to, Paint paint) {
  constexpr double kHeadShare = 0.3;
  constexpr double kLargestHeadMm = 5.0;
  constexpr double kSlender = 0.4;  // half the head's width over its length
  add(from, to, paint);
  const Vec3 along = to - from;
  const double length = along.norm();
  if (!(length > 0.0)) return;
  const Vec3 direction = along / length;
  const double head = std::min(kHeadShare * length, kLargestHeadMm);
  const Vec3 side = direction.unitOrthogonal();
  const Vec3 base = to - head * direction;
  for (const Vec3& barb : {side, Vec3(direction.cross(side))}) {
    add(to, base + kSlender * head * barb, paint);
    add(to, base - kSlender * head * barb, paint);
  }
}

void Lines::addCross(const Vec3& centre, double half_mm, Paint paint) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 arm = half_mm * Vec3::Unit(axis);
    add(centre - arm, centre + arm, paint);
  }
}

void Patches::addTriangle(const Vec3& a, const Vec3& b, const Vec3& c, Paint paint) {
  for (const Vec3& corner : {a, b, c}) points.push_back({corner, paint});
}

void Patches::addQuad(const std::array<Vec3, 4>& corners, Paint paint) {
  addTriangle(corners[0], corners[1], corners[2], paint);
  addTriangle(corners[0], corners[2], corners[3], paint);
}

Paint faded(Paint paint, double share) {
  paint[3] = static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * paint[3]));
  return paint;
}

}  // namespace palpate::view
