// From a contact to the numbers that the kernels broadcast.
//
// Data flow: Contact -> frameOf -> findRegion and, with amplitudes from the pipeline, lanesOf -> kernels.cpp.
// Based on: Ji, dissertation 2008, sections 4.2 to 4.4, with E14, E18 and E19.
#include "palpate/deform/fast_displacement.h"

#include <algorithm>

#include "palpate/base/elementary.h"
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
  lanes.slope = static_cast<float>(1.0 / ellipse.rise.fall_mm);
  lanes.outside = 0.0f;
  return lanes;
}

void copyTo(float (&out)[tissue::kCurveTerms], const tissue::LayeredCurve& curve) noexcept {
  for (std::size_t k = 0; k < curve.terms.size(); ++k) out[k] = static_cast<float>(curve.terms[k]);
}

void setCurve(PartLanes& part, const tissue::LayeredCurve& curve, double bend, const Room& room) noexcept {
  const double rim = 1.0 / (1.0 + bend);
  part.share.bend = static_cast<float>(bend);
  part.share.rim = static_cast<float>(rim);
  part.share.scale = static_cast<float>(1.0 / (1.0 - rim));
  copyTo(part.share.terms, curve);
  static_assert(kRoomSteps == Room::kSteps);
  for (std::size_t i = 0; i < kRoomSteps; ++i) part.room[i] = static_cast<float>(room.from[i]);
}

void setLayered(const LayeredFrame& layered, const FlatEllipse& region, double amplitude_mm,
                ContactLanes& lanes) noexcept {
  lanes.layered = true;
  const tissue::PressCurves& press = layered.shape.press;
  setCurve(lanes.normal, press.down, tissue::kPressBend, layered.press_room);
  setCurve(lanes.tangential, layered.shape.drag, tissue::kDragBend, layered.drag_room);
  copyTo(lanes.outward, press.outward);
  // The half minor axis: an ellipse moves outward nowhere more than a circle.
  lanes.outward_mm2 = region.acts() ? static_cast<float>(amplitude_mm / region.steepest()) : 0.0f;
  const Mat3 plane = region.along * region.along.transpose() + region.across * region.across.transpose();
  const double upper[6] = {plane(0, 0), plane(0, 1), plane(0, 2), plane(1, 1), plane(1, 2), plane(2, 2)};
  for (int i = 0; i < 6; ++i) lanes.plane[i] = static_cast<float>(upper[i]);
}

/// Not more than any location ratio in a ball. The ratio grows by at most `steepest` a mm; heights only add to it.
double leastRatio(const FlatEllipse& ellipse, const Vec3& offset, double radius_mm) noexcept {
  const double flat = elementary::hypot(ellipse.along.dot(offset), ellipse.across.dot(offset));
  return std::max(0.0, flat - radius_mm * ellipse.steepest());
}

/// Share of the displacement at a point within q < 1 of an ellipse, by the default profile; 0 for one that does not
/// act.
double gaussianShare(const FlatEllipse& ellipse, const Vec3& offset) noexcept {
  return ellipse.acts() ? tissue::profile(ellipse.ratioAt(offset)) : 0.0;
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
  if (frame.wantsPress()) frame.press = flatEllipse(contact.normal_region, frame.normal, levelOf(contact));
  if (frame.wantsDrag()) frame.drag = flatEllipse(contact.tangential_region, frame.normal, levelOf(contact));
  return frame;
}

ContactLanes lanesOf(const EllipseContact& frame, double amplitude_mm, const Vec3& shift_mm) noexcept {
  ContactLanes lanes;
  copyTo(lanes.anchor, frame.anchor);
  copyTo(lanes.facing, frame.normal);
  lanes.normal = lanesOf(frame.press, -amplitude_mm * frame.normal);
  lanes.tangential = lanesOf(frame.drag, shift_mm);
  if (frame.layered) setLayered(*frame.layered, frame.press, amplitude_mm, lanes);
  return lanes;
}

/// A point's share of the displacement of the press's centre.
double FastDisplacement::pressShare(const Frame& from, const Vec3& offset) noexcept {
  if (!from.layered) return gaussianShare(from.press, offset);
  return from.press.acts() ? from.layered->pressShare(from.press.ratioAt(offset)) : 0.0;
}

double FastDisplacement::dragShare(const Frame& from, const Vec3& offset) noexcept {
  if (!from.layered) return gaussianShare(from.drag, offset);
  return from.drag.acts() ? from.layered->dragShare(from.drag.ratioAt(offset)) : 0.0;
}

double FastDisplacement::pressRoom(const Frame& frame, double q) noexcept {
  return frame.layered ? frame.layered->press_room.at(q) : tissue::profile(q);
}

double FastDisplacement::dragRoom(const Frame& frame, double q) noexcept {
  return frame.layered ? frame.layered->drag_room.at(q) : tissue::profile(q);
}

double FastDisplacement::mostAt(const Frame& frame, double press_mm, double drag_mm, const Vec3& offset) noexcept {
  const double press = frame.press.acts() ? press_mm * pressRoom(frame, frame.press.ratioAt(offset)) : 0.0;
  const double drag = frame.drag.acts() ? drag_mm * dragRoom(frame, frame.drag.ratioAt(offset)) : 0.0;
  return press + drag;
}

double FastDisplacement::dragSlope(const Frame& frame, const Vec3& shift_mm) noexcept {
  if (!frame.drag.acts()) return 0.0;
  const double steepest = frame.layered ? frame.layered->drag.slope.at(0.0) : tissue::kProfileSteepest;
  return steepest * elementary::hypot(frame.drag.along.dot(shift_mm), frame.drag.across.dot(shift_mm));
}

void FastDisplacement::addShear(const Frame& frame, const Mover& mover, ShearBound& shear) noexcept {
  addShearNear(frame, mover, frame.anchor, 0.0, shear);
}

void FastDisplacement::addShearNear(const Frame& frame, const Mover& mover, const Vec3& centre, double radius_mm,
                                    ShearBound& shear) noexcept {
  const LayeredFrame* const layered = frame.layered ? &*frame.layered : nullptr;
  const Vec3 offset = centre - frame.anchor;
  shear.is_one = shear.press == 0.0 && shear.drag == 0.0;
  shear.towards = shear.is_one ? frame.normal : Vec3::Zero();
  if (frame.press.acts()) {
    const double per_mm = pressOf(mover) * frame.press.steepest();
    const double per_mm2 = per_mm * frame.press.steepest();
    const double q = leastRatio(frame.press, offset, radius_mm);
    shear.press += (layered != nullptr ? layered->down.slope.at(q) : tissue::kProfileSteepest) * per_mm;
    shear.press_bend += (layered != nullptr ? layered->down.bend.at(q) : kSharpest) * per_mm2;
    if (layered != nullptr) {
      // The way outward lies in the plane of the skin, like a drag, and shrinks it in two directions.
      shear.drag += 2.0 * layered->outward.slope.at(q) * per_mm;
      shear.drag_bend += 2.0 * layered->outward.bend.at(q) * per_mm2;
    }
  }
  if (frame.drag.acts()) {
    const double q = leastRatio(frame.drag, offset, radius_mm);
    const double per_mm = dragOf(mover) * frame.drag.steepest();
    shear.drag += (layered != nullptr ? layered->drag.slope.at(q) : tissue::kProfileSteepest) * per_mm;
    shear.drag_bend += (layered != nullptr ? layered->drag.bend.at(q) : kSharpest) * per_mm * frame.drag.steepest();
  }
}

double FastDisplacement::pressOf(const Mover& mover) noexcept { return lengthOf(mover.normal.shift); }

double FastDisplacement::dragOf(const Mover& mover) noexcept { return lengthOf(mover.tangential.shift); }

bool FastDisplacement::moves(const Mover& mover) noexcept {
  return movesAnything(mover.normal) || movesAnything(mover.tangential);
}

}  // namespace palpate::deform
