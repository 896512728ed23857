// A tube along a spline whose radius changes smoothly: fingers, the rims of the scapula.
#pragma once

#include <algorithm>
#include <vector>

#include "palpate/body/cubic_spline.h"
#include "palpate/body/signed_distance.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// A chain of capsules along a spline, joined by the plain minimum: a smooth union would bulge at every joint.
class Tube {
 public:
  /// `radii` are spread evenly over the points' parameter and joined linearly; at least two.
  Tube(const std::vector<Vec3>& points, const std::vector<double>& radii, std::size_t pieces) {
    const CubicSpline line(points);
    const auto at = [&](std::size_t i) { return line.length() * static_cast<double>(i) / static_cast<double>(pieces); };
    const auto radius = [&](double s) {
      const double place = s / line.length() * static_cast<double>(radii.size() - 1);
      const auto i = std::min(static_cast<std::size_t>(place), radii.size() - 2);
      return mix(radii[i], radii[i + 1], place - static_cast<double>(i));
    };
    for (std::size_t i = 0; i < pieces; ++i) {
      capsules_.push_back({line.at(at(i)), line.at(at(i + 1)), radius(at(i)), radius(at(i + 1))});
    }
  }

  double distance(const Vec3& p) const {
    double d = capsules_.front().distance(p);
    for (const Capsule& c : capsules_) d = std::min(d, c.distance(p));
    return d;
  }

 private:
  std::vector<Capsule> capsules_;
};

/// A section of a flat tube.
struct FlatRing {
  Vec3 centre, wide_direction;
  HalfAxes axes;
};

/// The same with flat sections; Piece is PlateCapsule or EllipticCapsule. Sections change linearly from ring to ring.
template <class Piece>
class FlatTube {
 public:
  FlatTube(const std::vector<FlatRing>& rings, std::size_t pieces_per_ring) {
    std::vector<Vec3> points;
    points.reserve(rings.size());
    for (const FlatRing& ring : rings) points.push_back(ring.centre);
    const CubicSpline line(points);
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) addSpan(line, i, rings[i], rings[i + 1], pieces_per_ring);
  }

  double distance(const Vec3& p) const {
    double d = pieces_.front().distance(p);
    for (const Piece& piece : pieces_) d = std::min(d, piece.distance(p));
    return d;
  }

 private:
  void addSpan(const CubicSpline& line, std::size_t span, const FlatRing& from, const FlatRing& to, std::size_t count) {
    const auto place = [&](double t) { return line.at(mix(line.knot(span), line.knot(span + 1), t)); };
    const auto axes = [&](double t) {
      return HalfAxes{mix(from.axes.wide, to.axes.wide, t), mix(from.axes.thick, to.axes.thick, t)};
    };
    for (std::size_t k = 0; k < count; ++k) {
      const double start = static_cast<double>(k) / static_cast<double>(count);
      const double end = static_cast<double>(k + 1) / static_cast<double>(count);
      const Vec3 wide = from.wide_direction + 0.5 * (start + end) * (to.wide_direction - from.wide_direction);
      pieces_.emplace_back(place(start), place(end), wide, axes(start), axes(end));
    }
  }

  std::vector<Piece> pieces_;
};

// The right half makes the left: exact mirror images across the plane x = 0.

/// The same mesh with x negated and the winding turned, so that it still faces outwards.
mesh::TriangleMesh mirrored(mesh::TriangleMesh mesh);

/// The half x >= 0 and its mirror image, joined along the vertices with x == 0 exactly. Closed when the half is closed
/// but for a border in that plane.
mesh::TriangleMesh withMirrorImage(mesh::TriangleMesh half);

}  // namespace palpate::body
