// From a contact to the numbers that the kernels broadcast.
//
// Data flow: Contact -> frameOf -> findRegion and, with amplitudes from the pipeline, lanesOf -> kernels.cpp.
// Based on: Ji, dissertation 2008, sections 4.2 to 4.4, with E14, E18 and E19.
#include "palpate/deform/fast_displacement.h"

#include <algorithm>
#include <cmath>

#include "palpate/tissue/profile.h"

namespace palpate::deform {

namespace {

/// The largest second derivative of the profile, that at its top.
constexpr double kSharpest = 2.0 * kGaussianRate * tissue::kProfileScale;

void copyTo(float (&out)[3], const Vec3& v) noexcept {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

PartLanes lanesOf(const FlatEllipse& ellipse, const Vec3& shift_mm) noexcept {
  PartLanes lanes;
  if (!ellipse.acts()) return lanes;
  copyTo(lanes.along, ellipse.along);
  copyTo(lanes.across, ellipse.across);
  copyTo(lanes.shift, shift_mm);
  lanes.level = static_cast<float>(ellipse.rise.level_mm);
  lanes.slope = static_cast<float>(1.0 / ellipse.rise.level_mm);
  lanes.outside = 0.0f;
  return lanes;
}

double lengthOf(const float (&v)[3]) noexcept { return Vec3f(v[0], v[1], v[2]).cast<double>().norm(); }

bool movesAnything(const PartLanes& part) noexcept {
  return part.outside == 0.0f && (part.shift[0] != 0.0f || part.shift[1] != 0.0f || part.shift[2] != 0.0f);
}

}  // namespace

EllipseContact frameOf(const Contact& contact, const TissueSettings& tissue) noexcept {
  EllipseContact frame(contact);
  frame.depth_mm = cappedDepth(contact.depth_mm, tissue.normal_cap_mm);
  frame.drag_mm = cappedLength(tissue.f_adj * contact.drag_mm, tissue.tangential_cap_mm);
  if (frame.wantsPress()) frame.press = flatEllipse(contact.normal_region, frame.normal);
  if (frame.wantsDrag()) frame.drag = flatEllipse(contact.tangential_region, frame.normal);
  return frame;
}

ContactLanes lanesOf(const EllipseContact& frame, double amplitude_mm, const Vec3& shift_mm) noexcept {
  ContactLanes lanes;
  copyTo(lanes.anchor, frame.anchor);
  copyTo(lanes.facing, frame.normal);
  lanes.normal = lanesOf(frame.press, -amplitude_mm * frame.normal);
  lanes.tangential = lanesOf(frame.drag, shift_mm);
  return lanes;
}

/// What a point keeps of the displacement of the ellipse's centre.
double FastDisplacement::shareOf(const FlatEllipse& ellipse, const Vec3& offset) noexcept {
  return ellipse.acts() ? tissue::profile(ellipse.ratioAt(offset)) : 0.0;
}

double FastDisplacement::pressRoom(double q) noexcept { return tissue::profile(q); }

double FastDisplacement::dragSlope(const Frame& frame, const Vec3& shift_mm) noexcept {
  if (!frame.drag.acts()) return 0.0;
  return tissue::kProfileSteepest * std::hypot(frame.drag.along.dot(shift_mm), frame.drag.across.dot(shift_mm));
}

void FastDisplacement::addShear(const Frame& frame, const Mover& mover, ShearBound& shear) noexcept {
  shear.is_one = shear.press == 0.0 && shear.drag == 0.0;
  shear.towards = shear.is_one ? frame.normal : Vec3::Zero();
  if (frame.press.acts()) shear.press += tissue::kProfileSteepest * pressOf(mover) * frame.press.steepest();
  if (frame.drag.acts()) shear.drag += tissue::kProfileSteepest * dragOf(mover) * frame.drag.steepest();
  for (const FlatEllipse* part : {&frame.press, &frame.drag}) {
    if (part->acts()) shear.bend = std::max(shear.bend, kSharpest / tissue::kProfileSteepest * part->steepest());
  }
}

double FastDisplacement::pressOf(const Mover& mover) noexcept { return lengthOf(mover.normal.shift); }

double FastDisplacement::dragOf(const Mover& mover) noexcept { return lengthOf(mover.tangential.shift); }

bool FastDisplacement::moves(const Mover& mover) noexcept {
  return movesAnything(mover.normal) || movesAnything(mover.tangential);
}

}  // namespace palpate::deform
