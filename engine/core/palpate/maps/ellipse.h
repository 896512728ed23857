// The deformation ellipse in its one canonical form, and the ways into and out of it.
//
// Measured tables have full axes in centimetre, ratios above or below one and undirected angles (E15, E16, E30); from
// here on all code sees half axes in millimetre, aspect = minor/major in (0, 1] and a direction in [0, pi).
// Based on: Ji, dissertation 2008, section 4.4; Arsigny, Fillard, Pennec, Ayache, "Log-Euclidean metrics for fast and
// simple calculus on diffusion tensors", 2006 (the blend of ellipses, E29).
#pragma once

#include "palpate/base/vec.h"

namespace palpate::maps {

struct Ellipse {
  double half_major_mm = 0.0;  ///< >= 0; 0 is an empty ellipse
  double aspect = 1.0;         ///< minor/major, in (0, 1]
  /// Major axis against the positive x axis, in [0, pi): an axis has no sense of direction. pi/2 for a circle, which
  /// has none at all.
  double direction_rad = 1.5707963267948966;
};

/// The canonical ellipse with these half axes along and across a direction; swaps them where "along" is the shorter one
/// (E30). Half axes must be > 0.
Ellipse canonicalEllipse(double half_along_mm, double half_across_mm, double direction_rad);

/// From a row of the dissertation's Appendix C: full axes in centimetre (E16), the direction in degree.
Ellipse ellipseFromFullAxesCm(double along_cm, double across_cm, double direction_deg);

/// Location ratio q of a point at `offset` from the centre: 0 at the centre, 1 on the ellipse (E14, instead of (4.13)).
/// An empty ellipse returns 0 at its centre and infinity elsewhere.
double locationRatio(const Ellipse& ellipse, const Vec2& offset);

/// The logarithm of the ellipse's tensor R diag(ln a, ln b) R^T in its three free numbers: the mean of ln a and ln b,
/// and half their difference times (cos 2d, sin 2d). Sums and weighted means of such vectors are the log-Euclidean
/// ones; they know that 0 and 180 degree are the same axis (E29).
using LogTensor = Vec3;

/// The ellipse must not be empty.
LogTensor logTensor(const Ellipse& ellipse);
Ellipse ellipseOf(const LogTensor& tensor);

/// An ellipse in the tangent plane of the surface.
struct SurfaceEllipse {
  Vec3 half_major = Vec3::Zero();  ///< mm, from the centre to the end of the major axis; zero is an empty ellipse
  double aspect = 1.0;             ///< minor/major, in (0, 1]
};

/// Foot of `point` on the plane through `origin` across `unit_normal` (4.9).
Vec3 projectedOnPlane(const Vec3& point, const Vec3& origin, const Vec3& unit_normal);

/// Location ratio of a point whose offset from the centre lies in the ellipse's plane (E14).
double locationRatio(const SurfaceEllipse& ellipse, const Vec3& offset_in_plane);

/// The map's ellipse on the tangent plane of a surface point: the direction as seen along z, the length restored (E32).
/// Where z is in the tangent plane the map axis is projected at right angles instead. A normal that is not finite or is
/// zero makes an empty ellipse.
SurfaceEllipse liftedOntoSurface(const Ellipse& ellipse, const Vec3& normal);

}  // namespace palpate::maps
