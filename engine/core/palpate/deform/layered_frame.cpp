// Curves are looked at in as many places as they could have corners in: they are polynomials of low degree in a smooth
// bell. Data flow: Contact::layered -> here, once a contact and apply -> frames -> hold and kernels.
#include "palpate/deform/layered_frame.h"

#include <algorithm>

#include "palpate/base/elementary.h"

namespace palpate::deform {

namespace {

constexpr int kSamples = 4 * Room::kSteps;
/// Factor for the part of a derivative that the largest of this many samples may miss.
constexpr double kBetweenSamples = 1.02;

struct Derivatives {
  double first = 0.0;
  double second = 0.0;
};

/// Steepness of a curve whose first and second derivatives by q at the samples are `at(q)`.
template <class DerivativesAt>
Steepness computeSteepness(const DerivativesAt& derivatives_at) noexcept {
  Steepness steepness;
  constexpr int kEach = kSamples / Room::kSteps;
  Derivatives most;
  for (int i = kSamples; i >= 0; --i) {
    const Derivatives at = derivatives_at(static_cast<double>(i) / kSamples);
    most.first = std::max(most.first, kBetweenSamples * std::abs(at.first));
    most.second = std::max(most.second, kBetweenSamples * std::abs(at.second));
    if (i % kEach != 0 || i == kSamples) continue;
    steepness.slope.from[static_cast<std::size_t>(i / kEach)] = most.first;
    steepness.bend.from[static_cast<std::size_t>(i / kEach)] = most.second;
  }
  return steepness;
}

/// d^2 f / dq^2, by the difference of the slopes on both sides.
template <class SlopeAt>
double bendAt(const SlopeAt& slope_at, double q) noexcept {
  constexpr double kStep = 0.25 / kSamples;
  const double from = std::max(0.0, q - kStep);
  const double to = std::min(1.0, q + kStep);
  return (slope_at(to) - slope_at(from)) / (to - from);
}

/// Along the way from the middle a share f bends by f'', across by f' / q.
Steepness computeSteepness(const tissue::LayeredCurve& curve, double bend) noexcept {
  const auto slope_at = [&](double q) { return 2.0 * q * tissue::curveAt(curve, bend, q * q).by_q2; };
  return computeSteepness([&](double q) {
    const double across = 2.0 * tissue::curveAt(curve, bend, q * q).by_q2;
    return Derivatives{slope_at(q), std::max(std::abs(bendAt(slope_at, q)), std::abs(across))};
  });
}

/// The outward way h = q f stretches by h' along itself and by f across; it bends by h'' and f' along itself, and by f'
/// across.
Steepness outwardSteepness(const tissue::LayeredCurve& curve) noexcept {
  const auto f_at = [&](double q) { return tissue::curveAt(curve, tissue::kPressBend, q * q); };
  const auto slope_at = [&](double q) {
    const tissue::CurvePoint f = f_at(q);
    return f.value + 2.0 * q * q * f.by_q2;
  };
  return computeSteepness([&](double q) {
    const tissue::CurvePoint f = f_at(q);
    const double sideways = std::abs(2.0 * q * f.by_q2);
    return Derivatives{std::max(std::abs(f.value), std::abs(slope_at(q))),
                       std::max(std::abs(bendAt(slope_at, q)), sideways) + sideways};
  });
}

template <class ShareAt>
Room tabulateRoom(const ShareAt& share_at) noexcept {
  Room room;
  double most = 0.0;
  for (int i = kSamples; i >= 0; --i) {
    most = std::max(most, share_at(static_cast<double>(i) / kSamples));
    if (i % (kSamples / Room::kSteps) == 0) room.from[static_cast<std::size_t>(i / (kSamples / Room::kSteps))] = most;
  }
  return room;
}

}  // namespace

LayeredFrame::LayeredFrame(const LayeredShape& of) noexcept : shape(of) {
  down = computeSteepness(shape.press.down, tissue::kPressBend);
  outward = outwardSteepness(shape.press.outward);
  drag = computeSteepness(shape.drag, tissue::kDragBend);
  press_room = tabulateRoom([&](double q) {
    const double sideways = q * tissue::curveAt(shape.press.outward, tissue::kPressBend, q * q).value;
    return elementary::hypot(pressShare(q), sideways);
  });
  drag_room = tabulateRoom([&](double q) { return std::abs(dragShare(q)); });
}

}  // namespace palpate::deform
