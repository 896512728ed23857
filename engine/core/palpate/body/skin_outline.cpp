// Lines of the fitted table (skin_table.h) joined from the flank up to the neck, unrolled by the angle.
#include "palpate/body/skin_outline.h"

#include <algorithm>
#include <span>

#include "palpate/body/skin_table.h"

namespace palpate::body {

namespace {

Vec2 flat(const OutlinePoint& point) { return {kFlatRadius * kRadPerDeg * point.angle_deg, point.y_mm}; }

/// The point of the flank at height y.
Vec2 flankAt(double y) {
  const std::span<const OutlinePoint> flank = outlineFlank();
  std::size_t next = 1;
  while (next + 1 < flank.size() && flank[next].y_mm < y) ++next;
  const Vec2 low = flat(flank[next - 1]);
  const Vec2 high = flat(flank[next]);
  return low + (y - low.y()) / (high.y() - low.y()) * (high - low);
}

/// Appends a line whose first point is already there and marks its end as a corner.
void appendLine(std::span<const OutlinePoint> line, FlatOutline& outline) {
  for (const OutlinePoint& point : line.subspan(1)) outline.right.push_back(flat(point));
  outline.corners.push_back(outline.right.size() - 1);
}

}  // namespace

FlatOutline skinOutline(SkinExtent extent) {
  const double low = extent == SkinExtent::patch ? kPatchLow : kSkinLow;
  FlatOutline outline{{flankAt(low)}, {0}};
  for (const OutlinePoint& point : outlineFlank()) {
    if (point.y_mm > low) outline.right.push_back(flat(point));
  }
  outline.corners.push_back(outline.right.size() - 1);
  appendLine(outlineArm(), outline);
  appendLine(outlineRidge(), outline);
  return outline;
}

double borderAngle(double y) {
  static const FlatOutline outline = skinOutline(SkinExtent::torso);
  const auto& right = outline.right;
  const auto above = std::lower_bound(right.begin(), right.end(), y,
                                      [](const Vec2& point, double height) { return point.y() < height; });
  if (above == right.begin()) return right.front().x() / kFlatRadius;
  if (above == right.end()) return right.back().x() / kFlatRadius;
  const Vec2& low = *(above - 1);
  const double t = (y - low.y()) / (above->y() - low.y());
  return (low.x() + t * (above->x() - low.x())) / kFlatRadius;
}

}  // namespace palpate::body
