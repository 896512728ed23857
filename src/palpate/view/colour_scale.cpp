#include "palpate/view/colour_scale.h"

namespace palpate::view {

namespace {

double valueAtVertex(const scene::World& world, const deform::DeformedSurface& surface, Colouring colouring, Index v) {
  if (colouring == Colouring::strain) return 100.0 * surface.strain()[v];
  if (colouring == Colouring::stiffness) return world.stiffness_n_per_mm[v];
  const Vec3& place = world.skin.positions[v];
  return world.ellipses.at(place.x(), place.y()).half_major_mm;
}

/// Shares of a triangle's corners in a place on it.
Vec3 cornerShares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& place) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (!(area > 0.0)) return Vec3::Constant(1.0 / 3.0);
  const double at_b = (place - a).cross(c - a).dot(normal) / area;
  const double at_c = (b - a).cross(place - a).dot(normal) / area;
  return {1.0 - at_b - at_c, at_b, at_c};
}

}  // namespace

std::optional<ColourScale> scaleOf(Colouring colouring) {
  switch (colouring) {
    case Colouring::strain:
      return ColourScale{colourMapOf(colouring), "strain", "%"};
    case Colouring::stiffness:
      return ColourScale{colourMapOf(colouring), "stiffness", "N/mm"};
    case Colouring::ellipses:
      return ColourScale{colourMapOf(colouring), "half-major", "mm"};
    case Colouring::plain:
      break;
  }
  return std::nullopt;
}

ColourBytes colourOfValue(const Look& look, double value) {
  const auto scale = scaleOf(look.colouring);
  return bytesOf(scale ? colourOf(scale->map, shareOf(look.range(), value)) : kNoColour);
}

std::optional<double> valueUnder(const scene::World& world, const deform::DeformedSurface& surface, const Look& look,
                                 const contact::FingerOutput& finger) {
  const bool touches = finger.touch != contact::Touch::free && finger.triangle < world.skin.triangles.size();
  if (look.colouring == Colouring::plain || !touches) return std::nullopt;
  const auto& corners = world.skin.triangles[finger.triangle];
  const auto& places = world.skin.positions;
  const Vec3 shares = cornerShares(places[corners[0]], places[corners[1]], places[corners[2]], finger.proxy);
  double value = 0.0;
  for (int i = 0; i < 3; ++i) value += shares[i] * valueAtVertex(world, surface, look.colouring, corners[i]);
  return value;
}

}  // namespace palpate::view
