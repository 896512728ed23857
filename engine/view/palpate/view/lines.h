// Lines and translucent patches over the skin, as plain data, for overlays. No GL.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::view {

/// Red, green, blue (sRGB) and opacity, 0 to 255. Overlays are drawn after the tone curve, so colours are exact.
using Paint = std::array<std::uint8_t, 4>;

struct PaintedPoint {
  Vec3 place;
  Paint paint;
};

/// Segments, two points each.
struct Lines {
  double width_px = 1.5;  ///< at one pixel per point (Frame::pixels_per_point)
  std::vector<PaintedPoint> points;

  void add(const Vec3& from, const Vec3& to, Paint paint) {
    points.push_back({from, paint});
    points.push_back({to, paint});
  }
  void addPath(std::span<const Vec3> path, Paint paint);
  void addBox(const Eigen::AlignedBox3d& box, Paint paint);
  /// Four barbs, so that it reads as an arrow from every side. Shorter arrows have smaller heads.
  void addArrow(const Vec3& from, const Vec3& to, Paint paint);
  /// Three short lines along the axes.
  void addCross(const Vec3& centre, double half_mm, Paint paint);
};

/// Triangles, three points each, seen from both sides.
struct Patches {
  std::vector<PaintedPoint> points;

  void addTriangle(const Vec3& a, const Vec3& b, const Vec3& c, Paint paint);
  /// Corners in order round it.
  void addQuad(const std::array<Vec3, 4>& corners, Paint paint);
};

/// The same colour with this share of its opacity.
Paint faded(Paint paint, double share);

}  // namespace palpate::view
