#include "palpate/deform/form_frame.h"

#include "palpate/tissue/profile_forms.h"

namespace palpate::deform {

namespace {

void setCapped(const Contact& contact, const FormSettings& forms, FormFrame& frame) noexcept {
  const TissueSettings& tissue = forms.common.tissue;
  const Vec3 drag = tissue.f_adj * contact.drag_mm;
  if (forms.fidelity.literal(Erratum::E19_drag_cap)) {
    frame.depth_mm = literallyCappedDepth(contact.depth_mm, tissue.normal_cap_mm);
    frame.drag_mm = literallyCappedDrag(drag, tissue.tangential_cap_mm);
  } else {
    frame.depth_mm = cappedDepth(contact.depth_mm, tissue.normal_cap_mm);
    frame.drag_mm = cappedLength(drag, tissue.tangential_cap_mm);
  }
}

RegionFrame dragFrame(const Contact& contact, const Vec3& normal, const FormSettings& forms) noexcept {
  if (forms.shape == Shape::contour) {
    RegionFrame contour = contourFrame(contact.tangential_contour, normal);
    if (contour.acts()) return contour;
  }
  return ellipseFrame(contact.tangential_region, normal, forms);
}

RegionFrame pressFrame(const Contact& contact, const Vec3& normal, const FormSettings& forms) noexcept {
  if (forms.shape == Shape::contour && sharesRegion(forms)) return dragFrame(contact, normal, forms);
  return ellipseFrame(contact.normal_region, normal, forms);
}

Vec3 inSpace(const RegionFrame& region, const Vec2& v) noexcept { return v.x() * region.along + v.y() * region.across; }

void addPart(const RegionFrame& region, const tissue::ProfileCurve& curve, const Vec3& shift_mm, const Vec3& offset,
             Motion& motion) noexcept {
  const Location at = locate(region, inPlane(region, offset));
  const tissue::ProfilePoint profile = curve.at(at.q);
  motion.displacement += profile.value * shift_mm;
  motion.gradient += shift_mm * (profile.slope * inSpace(region, at.slope)).transpose();
}

/// Towards the anchor in the tangent plane. With e = offset / distance the field -pull e has the gradient
/// -(pull' e (x) grad q + pull / distance (e_turning (x) e_turning)).
void addRadialPull(const RegionFrame& region, const tissue::RadialTerm& term, double amplitude_mm, const Vec3& offset,
                   Motion& motion) noexcept {
  const Vec2 in_plane = inPlane(region, offset);
  const double distance = in_plane.norm();
  if (!(distance > 0.0)) return;
  const Location at = locate(region, in_plane);
  const tissue::ProfilePoint pull = tissue::radialPull(term, at.q);
  const Vec3 outward = inSpace(region, in_plane / distance);
  const Vec3 turning = inSpace(region, Vec2(-in_plane.y(), in_plane.x()) / distance);
  motion.displacement -= amplitude_mm * pull.value * outward;
  motion.gradient -= amplitude_mm * (pull.slope * outward * inSpace(region, at.slope).transpose() +
                                     pull.value / distance * turning * turning.transpose());
}

}  // namespace

FormFrame formFrameOf(const Contact& contact, const FormSettings& forms) noexcept {
  FormFrame frame;
  frame.anchor = contact.anchor;
  frame.normal = contact.normal.normalized();
  frame.anchor_triangle = contact.anchor_triangle;
  setCapped(contact, forms, frame);
  if (frame.depth_mm != 0.0) frame.press = pressFrame(contact, frame.normal, forms);
  if (!frame.drag_mm.isZero(0.0)) frame.drag = dragFrame(contact, frame.normal, forms);
  return frame;
}

bool holds(const FormFrame& frame, const Vec3& place) noexcept {
  const Vec3 offset = place - frame.anchor;
  const auto inside = [&](const RegionFrame& region) { return locate(region, inPlane(region, offset)).q < 1.0; };
  return inside(frame.press) || inside(frame.drag);
}

FormCurves::FormCurves(const FormSettings& forms)
    : press(tissue::withFidelity(forms.normal_profile, forms.fidelity)),
      drag(tissue::withFidelity(forms.tangential_profile, forms.fidelity)),
      radial(forms.radial) {}

void addMotion(const FormFrame& frame, const FormCurves& curves, double amplitude_mm, const Vec3& shift_mm,
               const Vec3& place, Motion& motion) noexcept {
  const Vec3 offset = place - frame.anchor;
  if (frame.press.acts()) {
    addPart(frame.press, curves.press, -amplitude_mm * frame.normal, offset, motion);
    if (curves.radial.share != 0.0) addRadialPull(frame.press, curves.radial, amplitude_mm, offset, motion);
  }
  if (frame.drag.acts()) addPart(frame.drag, curves.drag, shift_mm, offset, motion);
}

Vec3 turnedNormal(const Mat3& gradient, const Vec3& rest_normal) noexcept {
  const Vec3 x = gradient.row(0);
  const Vec3 y = gradient.row(1);
  const Vec3 z = gradient.row(2);
  const Vec3 turned(y.cross(z).dot(rest_normal), z.cross(x).dot(rest_normal), x.cross(y).dot(rest_normal));
  const double length = turned.norm();
  return length > 0.0 ? Vec3(turned / length) : rest_normal;
}

}  // namespace palpate::deform
