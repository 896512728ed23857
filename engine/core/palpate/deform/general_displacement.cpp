// Effect of a contact of any form on a vertex: displacement and gradient as sums over its parts.
//
// Data flow: Contact -> formedContact -> findRegion and, with amplitudes from the pipeline, addMotion vertex by vertex.
// Based on: Ji, dissertation 2008, sections 4.2 to 4.6; the rule for normals is Nanson's formula.
#include "palpate/deform/general_displacement.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/tissue/profile_forms.h"

namespace palpate::deform {

namespace {

void setCapped(const Contact& contact, const FormSettings& forms, FormedContact& frame) noexcept {
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
    RegionFrame contour = contourFrame(contact.tangential_contour, normal, forms, levelOf(contact));
    if (contour.acts()) return contour;
  }
  return ellipseFrame(contact.tangential_region, normal, forms, levelOf(contact));
}

RegionFrame pressFrame(const Contact& contact, const Vec3& normal, const FormSettings& forms) noexcept {
  if (forms.shape == Shape::contour && sharesRegion(forms)) return dragFrame(contact, normal, forms);
  return ellipseFrame(contact.normal_region, normal, forms, levelOf(contact));
}

Vec3 inSpace(const RegionFrame& region, const Vec2& v) noexcept { return v.x() * region.along + v.y() * region.across; }

tissue::ProfilePoint layeredPoint(const tissue::LayeredCurve& curve, double bend, double q) noexcept {
  const tissue::CurvePoint point = tissue::curveAt(curve, bend, q * q);
  return {point.value, 2.0 * q * point.by_q2};
}

/// Uses these curves or the tissue's own.
tissue::ProfilePoint pressPoint(const FormedContact& frame, const FormCurves& curves, double q) noexcept {
  return frame.layered ? layeredPoint(frame.layered->shape.press.down, tissue::kPressBend, q) : curves.press.at(q);
}

tissue::ProfilePoint dragPoint(const FormedContact& frame, const FormCurves& curves, double q) noexcept {
  return frame.layered ? layeredPoint(frame.layered->shape.drag, tissue::kDragBend, q) : curves.drag.at(q);
}

template <class CurveAt>
void addPart(const RegionFrame& region, const CurveAt& curve_at, const Vec3& shift_mm, const Vec3& offset,
             Motion& motion) noexcept {
  const SpatialLocation at = locateInSpace(region, offset);
  const tissue::ProfilePoint profile = curve_at(at.q);
  motion.displacement += profile.value * shift_mm;
  motion.gradient += shift_mm * (profile.slope * at.slope).transpose();
}

/// Towards the anchor in the tangent plane. With e = offset / distance the field -pull e has the gradient
/// -(pull' e (x) grad q + pull / distance (e_turning (x) e_turning)).
void addRadialPull(const RegionFrame& region, const tissue::RadialTerm& radial, double amplitude_mm, const Vec3& offset,
                   Motion& motion) noexcept {
  const Vec2 in_plane = inPlane(region, offset);
  const double distance = in_plane.norm();
  if (!(distance > 0.0)) return;
  const SpatialLocation at = locateInSpace(region, offset);
  const tissue::ProfilePoint pull = tissue::radialPull(radial, at.q);
  const Vec3 outward = inSpace(region, in_plane / distance);
  const Vec3 turning = inSpace(region, Vec2(-in_plane.y(), in_plane.x()) / distance);
  motion.displacement -= amplitude_mm * pull.value * outward;
  motion.gradient -= amplitude_mm * (pull.slope * outward * at.slope.transpose() +
                                     pull.value / distance * turning * turning.transpose());
}

/// Layered tissue moves along half the gradient of q^2 in the plane, which points away from the axis; q long on a
/// circle.
void addOutward(const RegionFrame& region, const tissue::LayeredCurve& outward, double amplitude_mm, const Vec3& offset,
                Motion& motion) noexcept {
  const Vec3 along = region.along / region.half_along_mm;
  const Vec3 across = region.across / region.half_across_mm;
  const Mat3 plane = along * along.transpose() + across * across.transpose();
  const Vec3 away = plane * offset;
  const SpatialLocation at = locateInSpace(region, offset);
  const tissue::ProfilePoint share = layeredPoint(outward, tissue::kPressBend, at.q);
  const double scale = amplitude_mm * shortestRadius(region);
  motion.displacement += scale * share.value * away;
  motion.gradient += scale * (share.value * plane + share.slope * away * at.slope.transpose());
}

mesh::TriangleMesh buildRestMesh(const Skin& skin) {
  mesh::TriangleMesh mesh;
  for (Index v = 0; v < skin.vertices; ++v) mesh.positions.push_back(skin.restPosition(v).cast<double>());
  mesh.triangles.assign(skin.triangles.begin(), skin.triangles.end());
  return mesh;
}

/// A cube that holds both regions: each as far as its longest radius, and as high as its rise lets it.
Box3 boxAround(const FormedContact& frame) noexcept {
  double reach_mm = 0.0;
  for (const RegionFrame* region : {&frame.press, &frame.drag}) {
    if (!region->acts()) continue;
    reach_mm =
        std::max(reach_mm, elementary::hypot(longestRadius(*region), region->rise.level_mm + region->rise.fall_mm));
  }
  return {frame.anchor - Vec3::Constant(reach_mm), frame.anchor + Vec3::Constant(reach_mm)};
}

/// The largest slope of a curve: as far as it is not a corner, which the default has none of.
double steepestSlope(const tissue::ProfileCurve& curve) noexcept {
  constexpr int kSamples = 512;
  double steepest = 0.0;
  for (int i = 0; i < kSamples; ++i) steepest = std::max(steepest, std::abs(curve.at((i + 0.5) / kSamples).slope));
  return steepest;
}

/// The largest share from q on, a bulge included.
template <class Share>
double mostFrom(double q, const Share& share_at) noexcept {
  constexpr int kSamples = 16;
  double most = 0.0;
  for (int i = 0; i < kSamples && q < 1.0; ++i) {
    most = std::max(most, std::abs(share_at(q + (1.0 - q) * i / kSamples)));
  }
  return most;
}

/// x, y, z of the three streams from `values` on.
Vec3 pointAt(const float* const* values, Index bit) noexcept {
  return {values[0][bit], values[1][bit], values[2][bit]};
}

void setPoint(float* const* values, Index bit, const Vec3f& point) noexcept {
  for (int axis = 0; axis < 3; ++axis) values[axis][bit] = point[axis];
}

}  // namespace

FormedContact formedContact(const Contact& contact, const FormSettings& forms) noexcept {
  FormedContact frame(contact);
  setCapped(contact, forms, frame);
  if (frame.wantsPress()) frame.press = pressFrame(contact, frame.normal, forms);
  if (frame.wantsDrag()) frame.drag = dragFrame(contact, frame.normal, forms);
  return frame;
}

bool holds(const FormedContact& frame, const Vec3& place) noexcept {
  const Vec3 offset = place - frame.anchor;
  const auto inside = [&](const RegionFrame& region) { return locateInSpace(region, offset).q < 1.0; };
  return inside(frame.press) || inside(frame.drag);
}

FormCurves::FormCurves(const FormSettings& forms)
    : press(tissue::withFidelity(forms.normal_profile, forms.fidelity)),
      drag(tissue::withFidelity(forms.tangential_profile, forms.fidelity)),
      radial(forms.radial) {}

void addMotion(const FormedContact& frame, const FormCurves& curves, double amplitude_mm, const Vec3& shift_mm,
               const Vec3& place, Motion& motion) noexcept {
  const Vec3 offset = place - frame.anchor;
  if (frame.press.acts()) {
    const auto press_at = [&](double q) { return pressPoint(frame, curves, q); };
    addPart(frame.press, press_at, -amplitude_mm * frame.normal, offset, motion);
    if (frame.layered) {
      addOutward(frame.press, frame.layered->shape.press.outward, amplitude_mm, offset, motion);
    } else if (curves.radial.share != 0.0) {
      addRadialPull(frame.press, curves.radial, amplitude_mm, offset, motion);
    }
  }
  const auto drag_at = [&](double q) { return dragPoint(frame, curves, q); };
  if (frame.drag.acts()) addPart(frame.drag, drag_at, shift_mm, offset, motion);
}

Vec3 turnedNormal(const Mat3& gradient, const Vec3& rest_normal) noexcept {
  const Vec3 x = gradient.row(0);
  const Vec3 y = gradient.row(1);
  const Vec3 z = gradient.row(2);
  const Vec3 turned(y.cross(z).dot(rest_normal), z.cross(x).dot(rest_normal), x.cross(y).dot(rest_normal));
  const double length = turned.norm();
  return length > 0.0 ? Vec3(turned / length) : rest_normal;
}

GeneralDisplacement::GeneralDisplacement(const Skin& skin, const FormSettings& forms)
    : skin_(skin), forms_(forms), curves_(forms), drag_slope_(steepestSlope(curves_.drag)), search_(skin) {
  if (forms.search == Search::octree) octree_.emplace(buildRestMesh(skin));
}

std::span<const BlockPart> GeneralDisplacement::findRegion(const Frame& frame) noexcept {
  const bool as_printed = forms_.fidelity.literal(Erratum::E23_region_search);
  const auto place_of = [&](Index v) {
    if (!holds(frame, skin_.restPosition(v).cast<double>())) return Place::outside;
    const double facing = skin_.restNormal(v).cast<double>().dot(frame.normal);
    if (as_printed || facing > kSteepFacing) return Place::inside;
    return facing > 0.0 ? Place::steep : Place::staying;
  };
  if (octree_) return search_.findAmong(octree_->find(boxAround(frame)), place_of);
  const RingRule rule = as_printed ? RingRule::printed : RingRule::connected;
  return search_.find(skin_, skin_.triangles[frame.anchor_triangle], rule, place_of);
}

double GeneralDisplacement::pressShare(const Frame& from, const Vec3& offset) const noexcept {
  return pressPoint(from, curves_, locateInSpace(from.press, offset).q).value;
}

double GeneralDisplacement::dragShare(const Frame& from, const Vec3& offset) const noexcept {
  return dragPoint(from, curves_, locateInSpace(from.drag, offset).q).value;
}

double GeneralDisplacement::pressRoom(const Frame& frame, double q) const noexcept {
  if (frame.layered) return frame.layered->press_room.at(q);
  return mostFrom(q, [&](double at) {
    const double pressed = curves_.press.at(at).value;
    return curves_.radial.share == 0.0 ? pressed
                                       : elementary::hypot(pressed, tissue::radialPull(curves_.radial, at).value);
  });
}

double GeneralDisplacement::dragRoom(const Frame& frame, double q) const noexcept {
  if (frame.layered) return frame.layered->drag_room.at(q);
  return mostFrom(q, [&](double at) { return curves_.drag.at(at).value; });
}

double GeneralDisplacement::mostAt(const Frame& frame, double press_mm, double drag_mm,
                                   const Vec3& offset) const noexcept {
  return press_mm * pressRoom(frame, locateInSpace(frame.press, offset).q) +
         drag_mm * dragRoom(frame, locateInSpace(frame.drag, offset).q);
}

double GeneralDisplacement::dragSlope(const Frame& frame, const Vec3& shift_mm) const noexcept {
  if (!frame.drag.acts()) return 0.0;
  const RegionFrame& region = frame.drag;
  const double slope = frame.layered ? frame.layered->drag.slope.at(0.0) : drag_slope_;
  if (region.kind == RegionFrame::Kind::contour) return slope * shift_mm.norm() / shortestRadius(region);
  return slope * elementary::hypot(region.along.dot(shift_mm) / region.half_along_mm,
                                   region.across.dot(shift_mm) / region.half_across_mm);
}

void GeneralDisplacement::displaceBlock(std::span<const OnBlock<Mover>> movers, const RestBlock& rest,
                                        const DeformedBlock& out) const noexcept {
  restoreBlocks(1, rest, out);
  std::uint64_t touched = 0;
  for (const OnBlock<Mover>& on : movers) touched |= on.region;
  forEachBit(touched, [&](Index bit) { displaceVertex(movers, bit, rest, out); });
}

void GeneralDisplacement::displaceWholeBlocks(const Mover& mover, Index blocks, const RestBlock& rest,
                                              const DeformedBlock& out) const noexcept {
  const OnBlock<Mover> on{&mover, ~std::uint64_t{0}};
  for (Index b = 0; b < blocks; ++b) displaceBlock({&on, 1}, rest.after(b), out.after(b));
}

void GeneralDisplacement::displaceVertex(std::span<const OnBlock<Mover>> movers, Index bit, const RestBlock& rest,
                                         const DeformedBlock& out) const noexcept {
  const Vec3 place = pointAt(rest.values, bit);
  Motion motion;
  // In the order of the contacts; the plan's chains have the last one first.
  for (auto on = movers.rbegin(); on != movers.rend(); ++on) {
    if ((on->region & bitOf(bit)) == 0) continue;
    addMotion(*on->mover->frame, curves_, on->mover->amplitude_mm, on->mover->shift_mm, place, motion);
  }
  const Vec3f displacement = motion.displacement.cast<float>();
  for (int axis = 0; axis < 3; ++axis) out.values[axis][bit] = rest.values[axis][bit] + displacement[axis];
  setPoint(out.values + 6, bit, displacement);
  if (forms_.common.normals != Normals::analytic) return;
  setPoint(out.values + 3, bit, turnedNormal(motion.gradient, pointAt(rest.values + 3, bit)).cast<float>());
}

}  // namespace palpate::deform
