// A contact made ready for FormDeformer: checked, capped, with its two regions; and what it does to one vertex.
//
// In double, vertex by vertex: the general counterpart of frame.h and kernels.h.
// Based on: Ji, dissertation 2008, sections 4.2 to 4.6.
#pragma once

#include "palpate/deform/region_frame.h"
#include "palpate/tissue/profile_curve.h"

namespace palpate::deform {

struct FormFrame {
  Vec3 anchor = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< of unit length
  Index anchor_triangle = kNoIndex;
  double depth_mm = 0.0;        ///< wanted at the anchor, capped; below 0 only as printed (E19)
  Vec3 drag_mm = Vec3::Zero();  ///< wanted at the anchor, adjusted and capped
  RegionFrame press;            ///< kind none if there is nothing to press
  RegionFrame drag;             ///< kind none if there is nothing to drag
};

/// The contact must be usable (frame.h).
FormFrame formFrameOf(const Contact& contact, const FormSettings& forms) noexcept;

/// True if a point lies in one of the two regions.
bool holds(const FormFrame& frame, const Vec3& place) noexcept;

/// The curves of both parts.
struct FormCurves {
  explicit FormCurves(const FormSettings& forms);
  tissue::ProfileCurve press;
  tissue::ProfileCurve drag;
  tissue::RadialTerm radial;
};

/// Displacement of a vertex, and the gradient of the deformed place by the place at rest.
struct Motion {
  Vec3 displacement = Vec3::Zero();
  Mat3 gradient = Mat3::Identity();
};

/// Adds what this contact does at a place, with the press of its centre by `amplitude_mm` and its drag by `shift_mm`.
void addMotion(const FormFrame& frame, const FormCurves& curves, double amplitude_mm, const Vec3& shift_mm,
               const Vec3& place, Motion& motion) noexcept;

/// The unit normal that `rest_normal` is turned into: cof(gradient) n; the rest normal where that vanishes.
Vec3 turnedNormal(const Mat3& gradient, const Vec3& rest_normal) noexcept;

}  // namespace palpate::deform
