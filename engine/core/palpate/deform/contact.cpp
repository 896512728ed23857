// The caps as corrected and as printed, and the circle of a press.
// Data flow: depth and drag of a Contact -> here, by both displacements, 60 times a second -> FramedContact.
// Based on: Ji, dissertation 2008, (4.15) to (4.18), with E19; the radius of a press by E21.
#include "palpate/deform/contact.h"

#include <algorithm>

namespace palpate::deform {

double cappedDepth(double depth_mm, double cap_mm) noexcept {
  return depth_mm > 0.0 ? std::min(depth_mm, cap_mm) : 0.0;
}

Vec3 cappedLength(const Vec3& displacement_mm, double cap_mm) noexcept {
  const double length = displacement_mm.norm();
  return length > cap_mm ? Vec3(displacement_mm * (cap_mm / length)) : displacement_mm;
}

/// (4.16) says "d = m if m < d_max" without a lower end.
double literallyCappedDepth(double depth_mm, double cap_mm) noexcept { return depth_mm < cap_mm ? depth_mm : cap_mm; }

/// (4.18) is missing from the text.
Vec3 literallyCappedDrag(const Vec3& drag_mm, double cap_mm) noexcept {
  return drag_mm.cwiseMax(-cap_mm).cwiseMin(cap_mm);
}

maps::SurfaceEllipse normalRegion(const Vec3& normal, double depth_mm, const TissueSettings& settings) noexcept {
  const double depth = cappedDepth(depth_mm, settings.normal_cap_mm);
  const double radius = settings.normal_radius_mm + settings.normal_radius_per_depth * depth;
  return maps::liftedOntoSurface({radius, 1.0}, normal);
}

}  // namespace palpate::deform
