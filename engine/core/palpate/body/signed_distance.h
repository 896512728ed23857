// Small signed distances that are joined into bones and the hand: negative inside, positive outside, millimetre.
//
// Plain structs with one `distance(point)`; a shape is a function that calls a few of them and joins the numbers, and
// tetrahedra_mesher.h draws its surface. The elliptic ones are first-order approximations, exact at the surface and
// growing by at most about 1.5 per millimetre elsewhere: good enough for a mesher that follows the zero surface, not
// for measuring.
//
// Based on: Hart, "Sphere tracing" (1996), distances by parts; Quilez, "Smooth minimum" and "Ellipsoid"
// (iquilezles.org), the polynomial blend and the two-norm estimate. The flat capsules and tubes are our own.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/base/elementary.h"
#include "palpate/base/vec.h"
#include "palpate/body/cubic_spline.h"

namespace palpate::body {

/// The union of two shapes with the seam filled: the blend reaches where |a - b| < k and adds at most k / 4.
inline double smoothUnion(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4.0 * k);
}

/// `a` without `cut`, the new edge rounded over k.
inline double smoothDifference(double a, double cut, double k) { return -smoothUnion(-a, cut, k); }

/// Two half spaces (or any two distances) met in an edge of radius r; exact for planes at a right angle.
inline double roundedIntersection(double a, double b, double r) {
  const double qa = a + r;
  const double qb = b + r;
  return std::min(std::max(qa, qb), 0.0) + elementary::hypot(std::max(qa, 0.0), std::max(qb, 0.0)) - r;
}

inline double mix(double from, double to, double t) { return from + (to - from) * t; }

/// 0 before `from`, 1 after `to`, with level ends.
inline double smoothStep(double from, double to, double at) {
  const double t = std::clamp((at - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Distance to an ellipsoid with half axes r about the origin, by the ratio of two norms.
inline double ellipsoidDistance(const Vec3& p, const Vec3& r) {
  const Vec3 scaled = p.cwiseQuotient(r);
  const double k0 = scaled.norm();
  const double k1 = scaled.cwiseQuotient(r).norm();
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -r.minCoeff();
}

/// A ball that grows or shrinks along a segment.
struct Capsule {
  Vec3 from, to;
  double radius_from, radius_to;

  double distance(const Vec3& p) const {
    const Vec3 axis = to - from;
    const double t = std::clamp((p - from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    return (p - from - t * axis).norm() - mix(radius_from, radius_to, t);
  }
};

/// The same in the plane: an ellipse with half axes a (x) and b (z).
inline double ellipseDistance(double x, double z, double a, double b) {
  const double k0 = elementary::hypot(x / a, z / b);
  const double k1 = elementary::hypot(x / (a * a), z / (b * b));
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min(a, b);
}

/// Half axes of the section of a flat or elliptic capsule.
struct HalfAxes {
  double wide, thick;
};

/// A segment with a direction across it: the frame that flat and elliptic capsules share.
class FlatSegment {
 public:
  FlatSegment(const Vec3& from, const Vec3& to, const Vec3& wide_direction, HalfAxes axes)
      : FlatSegment(from, to, wide_direction, axes, axes) {}
  FlatSegment(const Vec3& from, const Vec3& to, const Vec3& wide_direction, HalfAxes at_from, HalfAxes at_to)
      : from_(from), at_from_(at_from), at_to_(at_to), length_((to - from).norm()), along_((to - from) / length_) {
    wide_ = (wide_direction - wide_direction.dot(along_) * along_).normalized();
    thick_ = along_.cross(wide_);
  }

  struct Place {
    Vec3 offset;    ///< across wide, across thick, beyond the nearer end (0 within the segment)
    HalfAxes axes;  ///< half axes there
  };
  Place place(const Vec3& p) const {
    const Vec3 v = p - from_;
    const double s = v.dot(along_);
    const double on_segment = std::clamp(s, 0.0, length_);
    const double t = on_segment / length_;
    return {{v.dot(wide_), v.dot(thick_), s - on_segment},
            {mix(at_from_.wide, at_to_.wide, t), mix(at_from_.thick, at_to_.thick, t)}};
  }

 private:
  Vec3 from_;
  HalfAxes at_from_, at_to_;
  double length_;
  Vec3 along_, wide_, thick_;
};

/// A capsule whose section is an ellipse: half axes `wide` along the given direction and `thick` across it, both linear
/// along the segment; the ends are rounded by the smaller of the two.
struct EllipticCapsule : FlatSegment {
  using FlatSegment::FlatSegment;

  double distance(const Vec3& p) const {
    const Place at = place(p);
    return ellipsoidDistance(at.offset, {at.axes.wide, at.axes.thick, std::min(at.axes.wide, at.axes.thick)});
  }
};

/// A plate with rounded rims: like the elliptic capsule, but the section is a stadium, whose rim has the radius `thick`
/// everywhere. An ellipse as flat as a lamina would end in an edge sharper than the mesher can follow. Needs wide >=
/// thick.
struct PlateCapsule : FlatSegment {
  using FlatSegment::FlatSegment;

  double distance(const Vec3& p) const {
    const Place at = place(p);
    const double flat = at.axes.wide - at.axes.thick;
    const double beside = std::max(std::abs(at.offset.x()) - flat, 0.0);
    return Vec3(beside, at.offset.y(), at.offset.z()).norm() - at.axes.thick;
  }
};

/// The side of an upright column (axis y) with a superellipse section |x/a|^n + |z/b|^n = 1.
inline double superellipseDistance(double x, double z, double a, double b, double n) {
  const double u = std::abs(x) / a;
  const double w = std::abs(z) / b;
  const double un = elementary::pow(u, n - 1.0);
  const double wn = elementary::pow(w, n - 1.0);
  const double sum = un * u + wn * w;
  if (sum <= 0.0) return -std::min(a, b);
  const double f = elementary::pow(sum, 1.0 / n);
  // Gradient of f: (f / sum) * (un / a, wn / b).
  return (f - 1.0) * sum / (f * elementary::hypot(un / a, wn / b));
}

/// Distance to the nearest of a few pieces: their union by the plain minimum.
template <class Piece>
double nearestDistance(const std::vector<Piece>& pieces, const Vec3& p) {
  double d = pieces.front().distance(p);
  for (const Piece& piece : pieces) d = std::min(d, piece.distance(p));
  return d;
}

/// The union of pieces: the nearest one counts.
template <class Piece>
class UnionOfPieces {
 public:
  double distance(const Vec3& p) const { return nearestDistance(pieces_, p); }

 protected:
  std::vector<Piece> pieces_;
};

/// A tube along a spline whose radius changes smoothly (the rims of the scapula): a chain of capsules, joined by the
/// plain minimum, because a smooth union would bulge at every joint.
class Tube : public UnionOfPieces<Capsule> {
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
      pieces_.push_back({line.at(at(i)), line.at(at(i + 1)), radius(at(i)), radius(at(i + 1))});
    }
  }
};

/// A section of a flat tube.
struct FlatRing {
  Vec3 centre, wide_direction;
  HalfAxes axes;
};

/// The same with flat sections; Piece is PlateCapsule or EllipticCapsule. Sections change linearly from ring to ring.
template <class Piece>
class FlatTube : public UnionOfPieces<Piece> {
 public:
  FlatTube(const std::vector<FlatRing>& rings, std::size_t pieces_per_ring) {
    std::vector<Vec3> points;
    points.reserve(rings.size());
    for (const FlatRing& ring : rings) points.push_back(ring.centre);
    const CubicSpline line(points);
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) addSpan(line, i, rings[i], rings[i + 1], pieces_per_ring);
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
      this->pieces_.emplace_back(place(start), place(end), wide, axes(start), axes(end));
    }
  }
};

}  // namespace palpate::body
