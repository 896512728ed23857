// Least squares at load; at a contact the place that matters most is found and blended in.
// Based on: Ji, dissertation 2008, 1.5 and chapter 6.
#include "palpate/scene/place_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "palpate/base/error.h"
#include "palpate/scene/words.h"
#include "palpate/tissue/profile_curve.h"
#include "palpate/tissue/user_profile.h"

namespace palpate::scene {

namespace {

constexpr int kSamples = 400;

double valueOf(const tissue::LayeredCurve& curve, double bend, double q) {
  return tissue::curveAt(curve, bend, q * q).value;
}

/// The settings of [deformation] with another kind, and another table.
tissue::ProfileSettings profileOf(tissue::ProfileSettings profile, tissue::ProfileKind kind,
                                  const std::filesystem::path& file, const Fidelity& fidelity) {
  profile.kind = kind;
  if (kind == tissue::ProfileKind::user) profile.knots = tissue::readProfileKnots(file);
  return tissue::withFidelity(profile, fidelity);
}

FittedCurve requiredCurve(const tissue::ProfileSettings& profile, double bend, std::string_view key) {
  const FittedCurve fitted = fittedCurve(profile, bend);
  if (fitted.error <= kMaxCurveError) return fitted;
  throw Error(
      fmt::format("[[profile]] {} = \"{}\": the best smooth curve is {:.0f} % off (limit {:.0f} %); use it for the "
                  "whole body in [deformation] instead",
                  key, wordFor(profile.kind), 100.0 * fitted.error, 100.0 * kMaxCurveError));
}

std::string formatPlace(const PlaceProfile& place) {
  return place.at.empty() ? fmt::format("({:g}, {:g}) mm", place.x_mm, place.y_mm) : place.at;
}

/// 1 in the middle of a place, 0 outside.
double weightAt(const PlaceCurve& place, const Vec3& point) noexcept {
  const double away = (point.head<2>() - place.centre_mm).norm() / place.radius_mm;
  if (!(away < 1.0)) return 0.0;
  if (!(place.edge_softness > 0.0)) return 1.0;
  const double t = std::min(1.0, (1.0 - away) / place.edge_softness);
  return t * t * (3.0 - 2.0 * t);
}

/// A circle has no direction: it takes the other's.
Vec3 alignedTo(const maps::SurfaceEllipse& ellipse, const Vec3& other) noexcept {
  const double length = ellipse.half_major.norm();
  if (ellipse.aspect >= 1.0 && other.norm() > 0.0) return length * other.normalized();
  return ellipse.half_major.dot(other) < 0.0 ? Vec3(-ellipse.half_major) : ellipse.half_major;
}

maps::SurfaceEllipse blended(const maps::SurfaceEllipse& from, const maps::SurfaceEllipse& to, double share) noexcept {
  if (share >= 1.0) return to;
  const Vec3 end = alignedTo(to, from.half_major);
  const Vec3 start = alignedTo(from, end);
  const double minor = (1.0 - share) * from.aspect * start.norm() + share * to.aspect * end.norm();
  maps::SurfaceEllipse ellipse{start + share * (end - start), 1.0};
  const double major = ellipse.half_major.norm();
  if (major > 0.0) ellipse.aspect = std::min(1.0, minor / major);
  return ellipse;
}

maps::SurfaceEllipse regionScaled(maps::SurfaceEllipse ellipse, double factor) noexcept {
  ellipse.half_major *= factor;
  return ellipse;
}

/// The curves of a contact: its layers', or those of the rest of the body.
deform::LayeredShape shapeOf(const PlaceCurves& curves, const deform::Contact& contact) noexcept {
  if (contact.layered) return *contact.layered;
  return {{contact.normal_region.half_major.norm(), curves.press, {}}, curves.drag};
}

}  // namespace

FittedCurve fittedCurve(const tissue::ProfileSettings& profile, double bend) {
  const tissue::ProfileCurve wanted(profile);
  std::vector<tissue::CurveSample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    const double q = static_cast<double>(i) / (kSamples + 1);  // both are 0 on the rim
    samples.push_back({q, wanted.at(q).value});
  }
  FittedCurve fitted;
  fitted.curve = tissue::fittedShare(samples, bend);
  for (const tissue::CurveSample& sample : samples) {
    fitted.error = std::max(fitted.error, std::abs(valueOf(fitted.curve, bend, sample.q) - sample.value));
  }
  return fitted;
}

std::shared_ptr<const PlaceCurves> placeCurvesOf(const Scene& scene, const deform::FormSettings& forms,
                                                 std::vector<std::string>& notes) {
  if (scene.profiles.empty()) return nullptr;
  PlaceCurves curves;
  curves.press = fittedCurve(tissue::withFidelity(forms.normal_profile, forms.fidelity), tissue::kPressBend).curve;
  curves.drag = fittedCurve(tissue::withFidelity(forms.tangential_profile, forms.fidelity), tissue::kDragBend).curve;
  for (const PlaceProfile& place : scene.profiles) {
    const FittedCurve press = requiredCurve(
        profileOf(forms.normal_profile, place.press, place.press_file, forms.fidelity), tissue::kPressBend, "press");
    const FittedCurve drag = requiredCurve(
        profileOf(forms.tangential_profile, place.drag, place.drag_file, forms.fidelity), tissue::kDragBend, "drag");
    curves.places.push_back(
        {{place.x_mm, place.y_mm}, place.radius_mm, place.edge_softness, place.region, press.curve, drag.curve});
    notes.push_back(fmt::format(
        "[[profile]] at {}: the skin follows \"{}\" (press) and \"{}\" (drag) within {:.1f} %, in the regions of "
        "[deformation]; the force is unchanged",
        formatPlace(place), wordFor(place.press), wordFor(place.drag), 100.0 * std::max(press.error, drag.error)));
  }
  return std::make_shared<const PlaceCurves>(std::move(curves));
}

deform::Contact withPlaceCurve(const PlaceCurves& curves, const deform::Contact& plain,
                               deform::Contact contact) noexcept {
  const PlaceCurve* place = nullptr;
  double share = 0.0;
  for (const PlaceCurve& one : curves.places) {
    const double weight = weightAt(one, contact.anchor);
    if (!(weight > share)) continue;
    share = weight;
    place = &one;
  }
  if (place == nullptr) return contact;
  deform::LayeredShape shape = shapeOf(curves, contact);
  const double radius_mm = place->region * plain.normal_region.half_major.norm();
  shape.press.radius_mm += share * (radius_mm - shape.press.radius_mm);
  shape.press.down = tissue::blended(shape.press.down, place->press, share);
  shape.press.outward = tissue::blended(shape.press.outward, {}, share);
  shape.drag = tissue::blended(shape.drag, place->drag, share);
  contact.layered = shape;
  contact.normal_region = blended(contact.normal_region, regionScaled(plain.normal_region, place->region), share);
  contact.tangential_region =
      blended(contact.tangential_region, regionScaled(plain.tangential_region, place->region), share);
  return contact;
}

}  // namespace palpate::scene
