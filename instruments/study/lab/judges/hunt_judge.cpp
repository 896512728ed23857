// An automaton over ticks, unknown -> outside -> held -> fallen, with the geometry asked as rarely as it can be.
// Data flow: contact::FingerOutput of a run, tick by tick -> here -> HuntReport. Definitions: docs/howto/hunt.md.
#include "lab/judges/hunt_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/topology.h"

namespace palpate::lab {
namespace {

/// A free sphere may overlap the skin by this share of its radius: rounding of a contact that is just ending.
constexpr double kOverlapShare = 1e-3;
/// A touching sphere may sink by this share of its radius.
constexpr double kSinkShare = 1e-2;
/// A point on a self-intersecting surface is felt as a sphere of 1e-4 of its diagonal (docs/explanation/contact.md),
/// and its proxy may lie on that sphere.
constexpr double kTinySphereShare = 2e-4;
/// Friction's cone, and the share by which a force step may pass its bound.
constexpr double kConeRounding = 1e-9;
constexpr double kStepShare = 1.1;
/// The proxy moves at most twice as far as the tip, which moves once itself.
constexpr double kProxyAndTip = 3.0;
/// The way from a proxy to its tip begins off the skin, by this share of it.
constexpr double kOffTheProxy = 1e-6;
/// Near a border a force fades and a finger may be released: within this share of the diagonal nothing is checked.
constexpr double kBorderShare = 0.02;
/// Far from its openings the winding number of an open body is a whole number but for their solid angle: up to here.
constexpr double kSurelyWhole = 0.1;
/// Where the fade ends, a tip is as far beyond the border as below the sheet continued flat: sqrt(2) of lag and radius
/// from it, and a little for slopes.
constexpr double kFadeShare = 1.5;
/// Half of all directions lead out of an opening from its plane, fewer from beyond it.
constexpr double kBeyondAnOpening = 0.5;

bool touches(const contact::FingerOutput& o) { return o.touch != contact::Touch::free; }

/// The device's values make no sense, so force is off: counted, and not held to the bound on steps.
bool isEvent(std::uint32_t status) { return (status & contact::kTipLost) != 0; }

/// The proxy is still on its way, or a sphere still on its way out: its geometry may be wrong for now.
bool isOnItsWay(std::uint32_t status) { return (status & (contact::kCatchingUp | contact::kStartedInside)) != 0; }

bool isClosed(const mesh::TriangleMesh& mesh) {
  for (const auto& row : mesh::neighboursOfTriangles(mesh)) {
    if (std::find(row.begin(), row.end(), kNoIndex) != row.end()) return false;
  }
  return true;
}

mesh::TriangleMesh notEmpty(mesh::TriangleMesh mesh) {
  if (mesh.triangles.empty()) throw Error("the mesh has no triangles to check");
  return mesh;
}

}  // namespace

const char* nameOf(Fault fault) {
  constexpr std::array<const char*, kFaults> kNames{"fall",        "missed_contact", "wrong_force", "step_over_bound",
                                                    "held_in_air", "lump_force",     "lump_step",   "lump_moved"};
  return kNames[static_cast<std::size_t>(fault)];
}

std::optional<Fault> faultNamed(std::string_view name) {
  for (std::size_t i = 0; i < kFaults; ++i) {
    if (name == nameOf(static_cast<Fault>(i))) return static_cast<Fault>(i);
  }
  return std::nullopt;
}

bool HuntReport::clean() const {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.ticks == 0; });
}

// ---- the body -----------------------------------------------------------------------------------------------------

OracleBody::OracleBody(mesh::TriangleMesh mesh, bool self_intersecting)
    : mesh_(notEmpty(std::move(mesh))),
      self_intersecting_(self_intersecting),
      tree_(mesh_),
      winding_(tree_),
      slow_(mesh_),
      closed_(isClosed(mesh_)),
      diagonal_(mesh::boundingBox(mesh_).diagonal().norm()),
      middle_(mesh::boundingBox(mesh_).center()) {}

Vec3 OracleBody::triangleNormal(Index triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  return mesh::areaVector2(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]).normalized();
}

// ---- a run --------------------------------------------------------------------------------------------------------

HuntOracle::HuntOracle(OracleBody& body, const contact::FingerSettings& settings, double stiffness)
    : body_(body),
      settings_(settings),
      stiffness_(stiffness),
      force_tolerance_(1e-9 * stiffness * (settings.max_depth_mm + settings.radius_mm)) {}

void HuntOracle::add(const contact::FingerOutput& o) {
  if (isEvent(o.status)) {
    ++report_.events;
  } else {
    if (first_) exempt_ = body_.inside(o.tip);
    if (!first_) judgeForceStep(o);
    if (touches(o)) {
      ++report_.touching_ticks;
      judgeTouching(o);
    } else if (body_.closed()) {
      judgeFree(o);
    } else {
      judgeFreeBesideBorder(o);
    }
    first_ = false;
    last_tip_ = o.tip;
    last_force_ = o.force;
  }
  ++tick_;
  ++report_.ticks;
}

void HuntOracle::judgeForceStep(const contact::FingerOutput& o) {
  const double motion = (o.tip - last_tip_).norm();
  const double bound =
      kStepShare * stiffness_ * (kProxyAndTip * motion + settings_.catch_up_mm_per_s * settings_.tick_s);
  const double step = (o.force - last_force_).norm();
  if (step > bound + force_tolerance_) reportFault(Fault::step, "force step, N", step, bound);
}

/// Inside from the side of a ball's centre, where the ball still holds the point; else asked again.
bool HuntOracle::insideBall(const Vec3& point, double distance, ClearBall& ball) {
  const double moved = (point - ball.centre).norm();
  const bool known = moved < std::max(ball.radius, distance - body_.tolerance());  // the segment meets no surface
  const bool inside = known && ball.radius > 0.0 ? ball.inside : body_.inside(point);
  ball = {point, distance - body_.tolerance(), inside};
  return inside;
}

void HuntOracle::judgeFree(const contact::FingerOutput& o) {
  const double moved = (o.tip - tip_ball_.centre).norm();
  if (moved + settings_.radius_mm < tip_ball_.radius && !tip_ball_.inside && past_ == Past::outside) return;
  const double distance = body_.nearest(o.tip).distance;
  if (distance <= body_.tolerance()) return;  // on the surface: unchanged
  const bool inside = insideBall(o.tip, distance, tip_ball_);
  if (!inside) {
    judgeOverlap(o.tip, distance, !exempt_);
    if (distance >= settings_.radius_mm) exempt_ = false;
    past_ = Past::outside;
    return;
  }
  if (exempt_) return;
  if (past_ == Past::outside)
    reportFault(Fault::missed_contact, "depth of a tip that came in without force, mm", distance, 0.0);
  if (past_ != Past::unknown) {
    reportFault(Fault::fall, "depth of a free tip inside, mm", distance, 0.0);
    past_ = Past::fallen;
  }
}

/// Folds that are inside out, where parts overlap, have their backs outside; a sheet is felt from its front.
bool HuntOracle::isBackOfFold(const Vec3& point) {
  if (!body_.selfIntersecting()) return false;
  const NearestPoint nearest = body_.slow().nearestTo(point);
  return nearest.pseudo_normal.dot(point - nearest.point) < 0.0;
}

void HuntOracle::judgeOverlap(const Vec3& tip, double distance, bool from_outside) {
  const double least = settings_.radius_mm * (1.0 - kOverlapShare);
  if (from_outside && distance < least && !isBackOfFold(tip))
    reportFault(Fault::missed_contact, "distance of a free sphere's centre from the skin, mm", distance, least);
}

bool HuntOracle::isFarFromBorder(const Vec3& place, double reach) {
  return body_.slow().distanceToBorder(place) > kBorderShare * body_.diagonal() + settings_.radius_mm + reach;
}

/// From a way to four round it, ten times as far as rounding.
std::array<Vec3, 4> HuntOracle::waysBeside(const Vec3& from, const Vec3& to) const {
  const Vec3 along = to - from;
  const Vec3 aside = along.unitOrthogonal() * (10.0 * body_.tolerance());
  const Vec3 across = along.normalized().cross(aside);
  return {Vec3(aside + across), Vec3(aside - across), Vec3(-aside + across), Vec3(-aside - across)};
}

bool HuntOracle::hasPassedThroughSkin(const Vec3& tip) {
  const BoxTree::Crossing crossing = body_.tree().crossing(last_tip_, tip);
  if (crossing.inwards <= 0) return false;
  const double way = (tip - *crossing.entry).norm();
  if (way <= body_.tolerance() || !isFarFromBorder(*crossing.entry, way)) return false;
  // A way through an edge may be counted where it goes in and not where it comes out, or the other way round.
  if (body_.nearest(last_tip_).distance > body_.tolerance()) {
    const std::array<Vec3, 4> beside = waysBeside(last_tip_, tip);
    return std::all_of(beside.begin(), beside.end(), [&](const Vec3& offset) {
      return body_.tree().crossing(last_tip_ + offset, tip + offset).inwards > 0;
    });
  }
  const NearestPoint nearest = body_.slow().nearestTo(tip);
  return nearest.pseudo_normal.dot(tip - nearest.point) <= 0.0;
}

/// A fold that is inside out winds round what is in it the other way, a whole turn: a point that passes a front there
/// is out of the body after it. A sheet alone never does, and leaves a half behind it.
bool HuntOracle::hasLeftFold(const Vec3& tip) {
  return body_.selfIntersecting() && body_.winding(last_tip_) < kSurelyWhole - 1.0 &&
         std::abs(body_.winding(tip)) < kSurelyWhole;
}

bool HuntOracle::wasHeldFarFromBorder(const Vec3& tip) {
  const double path = (kProxyAndTip - 1.0) * (tip - held_tip_).norm() + settings_.catch_up_mm_per_s * settings_.tick_s;
  // Beyond a border a sphere may be released as long as the force can have faded: as far beyond as the tip is deep.
  const bool fades = last_afloat_ && body_.slow().distanceToBorder(held_tip_) <= kFadeShare * held_reach_ + path;
  return past_ == Past::held && !fades && !isOnItsWay(held_status_) && isFarFromBorder(held_proxy_, path);
}

double HuntOracle::pointTolerance() const {
  return body_.selfIntersecting() ? kTinySphereShare * body_.diagonal() : body_.tolerance();
}

/// Where a sphere is that went over a border and has had nothing but the sheet continued flat under it since.
std::optional<Vec3> HuntOracle::afloatAt(const contact::FingerOutput& o) const {
  if ((o.status & contact::kAtBorder) == 0 && !last_afloat_) return std::nullopt;
  const double radius = settings_.radius_mm;
  const Vec3 centre = o.proxy + radius * o.normal;
  if (body_.nearest(centre).distance <= radius * (1.0 + kSinkShare) + pointTolerance()) return std::nullopt;
  return centre;
}

/// A sphere leaves the skin over a border only.
void HuntOracle::judgeAfloat(const contact::FingerOutput& o) {
  const std::optional<Vec3> centre = afloatAt(o);
  if (centre && wasHeldFarFromBorder(o.tip))
    reportFault(Fault::wrong_force, "distance of a border from where a sphere left the skin over it, mm",
                body_.slow().distanceToBorder(held_proxy_), 0.0);
  if (centre && body_.inside(*centre) && body_.inside(o.tip)) exempt_ = true;  // both came in by an opening
  last_afloat_ = centre;
}

/// Where there is a border a tip may come in round it, and may be released at it: a fault is only what passes through
/// the skin itself, or is released farther from any border than the proxy can go in this tick. A proxy that was on its
/// way, or a sphere beyond the border, may have gone through the opening already.
void HuntOracle::judgeFreeBesideBorder(const contact::FingerOutput& o) {
  const double distance = body_.nearest(o.tip).distance;
  if (distance <= body_.tolerance()) return;
  const bool inside = body_.inside(o.tip);  // it may become so with no surface on the way
  if (inside && exempt_) return;
  const bool let_go = inside && wasHeldFarFromBorder(o.tip);
  // A sphere that is inside already is there by the opening, and its tip may join it by any way.
  const std::optional<Vec3> was_afloat = std::exchange(last_afloat_, std::nullopt);
  const bool was_out = past_ == Past::outside || (was_afloat && !body_.inside(*was_afloat));
  const bool came_through = !first_ && was_out && hasPassedThroughSkin(o.tip);
  if (came_through && (inside || (settings_.radius_mm == 0.0 && !hasLeftFold(o.tip))))
    reportFault(Fault::missed_contact, "depth of a tip that came in without force, mm", distance, 0.0);
  if (!inside) {
    judgeOverlapBesideBorder(o, distance);
    past_ = Past::outside;
    exempt_ = body_.winding(o.tip) > kBeyondAnOpening;  // in doubt: in the opening, or past it already
    return;
  }
  if (came_through || let_go || past_ == Past::fallen) {
    past_ = Past::fallen;
    reportFault(Fault::fall, "depth of a free tip inside, mm", distance, 0.0);
    return;
  }
  past_ = Past::unknown;
  exempt_ = true;  // it came in by an opening
}

void HuntOracle::judgeOverlapBesideBorder(const contact::FingerOutput& o, double distance) {
  if (past_ != Past::outside || distance >= settings_.radius_mm) return;
  const NearestPoint nearest = body_.slow().nearestTo(o.tip);
  const bool from_front = nearest.pseudo_normal.dot(o.tip - nearest.point) > body_.tolerance();
  judgeOverlap(o.tip, distance, from_front && isFarFromBorder(nearest.point, 0.0));
}

/// Whatever held the finger, its tip is inside other skin than it came through: the winding number is above a half even
/// without a turn for each skin that it passed. On the skin and on a way through an edge too few may be counted; so
/// neither end may lie on it, and the ways beside count as well.
bool HuntOracle::hasPassedOpening(const Vec3& tip) {
  const double turns = body_.winding(tip);
  if (turns <= kBeyondAnOpening || body_.winding(last_tip_) > kBeyondAnOpening) return false;
  const auto is_inside_without = [&](const Vec3& offset) {
    return turns - body_.tree().crossing(last_tip_ + offset, tip + offset).inwards > kBeyondAnOpening;
  };
  const auto is_clear = [&](const Vec3& place) { return body_.nearest(place).distance > body_.tolerance(); };
  const std::array<Vec3, 4> beside = waysBeside(last_tip_, tip);
  return is_clear(last_tip_) && is_clear(tip) && is_inside_without(Vec3::Zero()) &&
         std::all_of(beside.begin(), beside.end(), is_inside_without);
}

void HuntOracle::judgeTouching(const contact::FingerOutput& o) {
  const bool has_force = !o.force.isZero(0.0);
  if (past_ == Past::outside && body_.closed() && settings_.radius_mm == 0.0 && !has_force) {
    const double depth = body_.nearest(o.tip).distance;
    if (depth > body_.tolerance() && body_.inside(o.tip))
      reportFault(Fault::missed_contact, "depth of a tip that came in without force, mm", depth, 0.0);
  }
  if (exempt_ && !isOnItsWay(o.status) && body_.winding(o.tip) <= kBeyondAnOpening) exempt_ = false;
  const bool is_finite = std::isfinite(o.force.sum() + o.proxy.sum() + o.normal.sum() + o.depth_mm);
  if (is_finite && !body_.closed()) judgeAfloat(o);
  if (past_ == Past::held && !body_.closed() && hasPassedOpening(o.tip)) exempt_ = true;
  held_tip_ = o.tip;
  held_proxy_ = o.proxy;
  held_status_ = o.status;
  held_reach_ = (o.proxy + settings_.radius_mm * o.normal - o.tip).norm() + settings_.radius_mm;
  past_ = Past::held;
  if (!is_finite) {
    reportFault(Fault::wrong_force, "a number that is not finite", 0.0, 0.0);
    return;
  }
  if (isOnItsWay(o.status)) return;
  if (has_force && !exempt_) judgeHeldInAir(o);
  judgeForce(o);
  if (settings_.radius_mm > 0.0) {
    judgeSphere(o);
  } else {
    judgePoint(o);
  }
}

/// A way through an edge, to rounding, meets the skin: two boxes that touch along an edge leave no gap.
bool HuntOracle::isSkinBetween(const Vec3& from, const Vec3& to) const {
  const auto meets = [&](const Vec3& offset) {
    const BoxTree::Crossing between = body_.tree().crossing(from + offset, to + offset);
    return between.inwards != 0 || between.entry;
  };
  const std::array<Vec3, 4> beside = waysBeside(from, to);
  return meets(Vec3::Zero()) || std::any_of(beside.begin(), beside.end(), meets);
}

/// For an embedded body the nearest skin decides, unless it is that of a part within; where sheets pierce each other
/// the winding number.
bool HuntOracle::isOutFarFromBorders(const contact::FingerOutput& o) {
  const Vec3 centre = o.proxy + settings_.radius_mm * o.normal;
  const double reach = (centre - o.tip).norm() + settings_.radius_mm;
  const double border = body_.slow().distanceToBorder(o.tip);
  if (border <= reach) return false;
  if (body_.selfIntersecting()) {
    // Behind a flat sheet it is at least what the disc as far as the border takes of all directions.
    const double behind_sheet = 0.5 * (1.0 - body_.nearest(o.tip).distance / border);
    return std::abs(body_.winding(o.tip)) < std::min(kSurelyWhole, behind_sheet);
  }
  const NearestPoint nearest = body_.slow().nearestTo(o.tip);
  return nearest.pseudo_normal.dot(o.tip - nearest.point) > body_.tolerance() &&
         body_.winding(o.tip) < kBeyondAnOpening;
}

void HuntOracle::judgeHeldInAir(const contact::FingerOutput& o) {
  const double clear = body_.nearest(o.tip).distance;
  const double rounding = body_.selfIntersecting() ? kTinySphereShare * body_.diagonal() : 10.0 * body_.tolerance();
  if (clear <= std::max(settings_.radius_mm, rounding)) return;
  if (body_.closed() ? insideBall(o.tip, clear, tip_ball_) : !isOutFarFromBorders(o)) return;
  if (isSkinBetween(o.proxy + kOffTheProxy * (o.tip - o.proxy), o.tip)) {
    ++report_.held_through_ticks;
  } else {
    reportFault(Fault::held_in_air, "force on a tip in free air, N", o.force.norm(), 0.0);
  }
}

void HuntOracle::judgeForce(const contact::FingerOutput& o) {
  const double normal = o.force.dot(o.normal);
  const double tangential = (o.force - normal * o.normal).norm();
  const double most = settings_.mu_static * std::max(normal, 0.0) * (1.0 + kConeRounding) + force_tolerance_;
  if (normal < -force_tolerance_)
    reportFault(Fault::wrong_force, "force along the finger's normal, N", normal, 0.0);
  else if (tangential > most)
    reportFault(Fault::wrong_force, "friction, N", tangential, most);
}

void HuntOracle::judgePoint(const contact::FingerOutput& o) {
  const double tolerance = pointTolerance();
  const BoxTree& tree = body_.tree();
  if ((o.status & contact::kAtBorder) != 0) return;  // past the sheet, continued flat
  const bool named = o.triangle < tree.triangles();
  const double off =
      named ? (nearestOnTriangle(tree.corners(tree.slotOf(o.triangle)), o.proxy) - o.proxy).norm() : body_.diagonal();
  if (off > tolerance) {
    const double distance = body_.nearest(o.proxy).distance;
    if (distance > tolerance)
      reportFault(Fault::wrong_force, "distance of the proxy from the skin, mm", distance, tolerance);
  }
  if (body_.selfIntersecting()) return;
  if (named && o.force.dot(body_.triangleNormal(o.triangle)) >= -force_tolerance_) return;
  if (pullsFromAll(o.force, o.proxy, 10.0 * tolerance, true))
    reportFault(Fault::wrong_force, "force into every triangle at the proxy, N", o.force.norm(), 0.0);
}

void HuntOracle::judgeSphere(const contact::FingerOutput& o) {
  if ((o.status & contact::kAtBorder) != 0) return;  // past the sheet, continued flat
  const double radius = settings_.radius_mm, least = radius * (1.0 - kSinkShare);
  const Vec3 centre = o.proxy + radius * o.normal;
  const NearPoint near = body_.nearest(centre);
  if (near.distance <= body_.tolerance()) {
    reportFault(Fault::wrong_force, "distance of a touching sphere's centre from the skin, mm", near.distance, least);
    return;
  }
  if (body_.closed()) {
    if (insideBall(centre, near.distance, centre_ball_) && !exempt_) {
      reportFault(Fault::wrong_force, "depth of a touching sphere's centre inside, mm", near.distance, 0.0);
      return;
    }
    if (exempt_) return;
  }
  // A sheet is felt from its front. Where there is a border its back may be nearer.
  if (near.distance < least && !body_.closed()) {
    const NearestPoint nearest = body_.slow().nearestTo(centre);
    if (nearest.on_border || nearest.pseudo_normal.dot(centre - nearest.point) < 0.0) return;
  }
  if (near.distance < least && isBackOfFold(centre)) return;
  if (near.distance < least)
    reportFault(Fault::wrong_force, "distance of a touching sphere's centre from the skin, mm", near.distance, least);
  else if (o.force.dot(centre - near.point) < 0.0 && pullsFromAll(o.force, centre, radius * (1.0 + kSinkShare), false))
    reportFault(Fault::wrong_force, "force towards every foot of the sphere, N", o.force.norm(), 0.0);
}

bool HuntOracle::pullsFromAll(const Vec3& force, const Vec3& place, double reach, bool by_normal) {
  body_.tree().collectWithin(place, reach, nearby_);
  for (const Index triangle : nearby_) {
    const auto& corners = body_.tree().corners(body_.tree().slotOf(triangle));
    const Vec3 out =
        by_normal ? body_.triangleNormal(triangle) : (place - nearestOnTriangle(corners, place)).normalized();
    if (force.dot(out) >= -force_tolerance_) return false;
  }
  return !nearby_.empty();
}

void HuntOracle::reportFault(Fault fault, const char* what, double measured, double bound) {
  const auto kind = static_cast<std::size_t>(fault);
  if (std::exchange(last_found_[kind], tick_ + 1) == tick_ + 1) return;
  Finding& finding = report_.findings[kind];
  if (finding.ticks++ > 0) return;
  finding.first_tick = tick_;
  finding.what = what;
  finding.measured = measured;
  finding.bound = bound;
}

}  // namespace palpate::lab
