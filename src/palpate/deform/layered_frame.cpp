// Curves are looked at in as many places as they could have corners in: they are polynomials of low degree in a smooth
// bell. Data flow: Contact::layered -> here, once a contact and apply -> frames -> hold and kernels.
#include "palpate/deform/layered_frame.h"

#include <algorithm>

namespace palpate::deform {

namespace {

constexpr int kSamples = 4 * Room::kSteps;
/// What the largest of so many samples may miss of a slope.
constexpr double kBetweenSamples = 1.02;

struct Steepness {
  SlopeFrom slope;
  double bend = 0.0;  ///< the largest second derivative
};

/// Of a curve by q, from its derivatives at the samples.
template <class SlopeAt>
Steepness steepnessOf(const SlopeAt& slope_at) noexcept {
  Steepness steepness;
  constexpr int kEach = kSamples / Room::kSteps;
  double most = 0.0;
  double before = slope_at(1.0);
  for (int i = kSamples - 1; i >= 0; --i) {
    const double slope = slope_at(static_cast<double>(i) / kSamples);
    most = std::max({most, kBetweenSamples * std::abs(slope), kBetweenSamples * std::abs(before)});
    steepness.bend = std::max(steepness.bend, kBetweenSamples * std::abs(slope - before) * kSamples);
    if (i % kEach == 0) steepness.slope.from[static_cast<std::size_t>(i / kEach)] = most;
    before = slope;
  }
  return steepness;
}

Steepness steepnessOf(const tissue::LayeredCurve& curve, double bend) noexcept {
  return steepnessOf([&](double q) { return 2.0 * q * tissue::curveAt(curve, bend, q * q).by_q2; });
}

/// The outward way q f(q) stretches by f + q f' along itself and by f across.
Steepness outwardSteepness(const tissue::LayeredCurve& curve) noexcept {
  return steepnessOf([&](double q) {
    const tissue::CurvePoint f = tissue::curveAt(curve, tissue::kPressBend, q * q);
    return std::max(std::abs(f.value), std::abs(f.value + 2.0 * q * q * f.by_q2));
  });
}

template <class ShareAt>
Room roomOf(const ShareAt& share_at) noexcept {
  Room room;
  double most = 0.0;
  for (int i = kSamples; i >= 0; --i) {
    most = std::max(most, share_at(static_cast<double>(i) / kSamples));
    if (i % (kSamples / Room::kSteps) == 0) room.from[static_cast<std::size_t>(i / (kSamples / Room::kSteps))] = most;
  }
  return room;
}

double bendOver(const Steepness& of) noexcept {
  const double slope = of.slope.at(0.0);
  return slope > 0.0 ? of.bend / slope : 0.0;
}

}  // namespace

LayeredFrame::LayeredFrame(const LayeredShape& of) noexcept : shape(of) {
  const Steepness down = steepnessOf(shape.press.down, tissue::kPressBend);
  const Steepness outward = outwardSteepness(shape.press.outward);
  const Steepness drag = steepnessOf(shape.drag, tissue::kDragBend);
  press_slope = down.slope;
  outward_slope = outward.slope;
  drag_slope = drag.slope;
  bend = std::max({bendOver(down), bendOver(outward), bendOver(drag)});
  press_room = roomOf([&](double q) {
    const double sideways = q * tissue::curveAt(shape.press.outward, tissue::kPressBend, q * q).value;
    return std::hypot(pressShare(q), sideways);
  });
  drag_room = roomOf([&](double q) { return std::abs(dragShare(q)); });
}

}  // namespace palpate::deform
