// The curves of layered tissue of one contact, with their steepness and largest motion beyond a location ratio, for the
// rest of the pipeline.
//
// Made with the frame of a contact (frame.h), some microseconds each; read by both ways to displace. In double.
#pragma once

#include <algorithm>
#include <array>

#include "palpate/tissue/layered_curve.h"

namespace palpate::deform {

/// Part of a contact with layered tissue (Contact::layered): the curves of its press and of its drag. Its normal region
/// is a circle of press.radius_mm then on even ground, bent to an ellipse elsewhere.
struct LayeredShape {
  tissue::PressCurves press;
  tissue::LayeredCurve drag;
};

/// The largest share of the centre's motion from q on, falling.
struct Room {
  static constexpr int kSteps = 16;
  std::array<double, kSteps + 1> from{};  ///< at q = i / kSteps

  /// Straight between them; 0 from q = 1 on.
  double at(double q) const noexcept {
    if (!(q < 1.0)) return 0.0;
    const double place = kSteps * std::max(0.0, q);
    const auto i = static_cast<std::size_t>(place);
    return from[i] + (place - static_cast<double>(i)) * (from[i + 1] - from[i]);
  }
};

/// The largest values from q on, falling, in steps: an upper bound of the curve.
struct UpperBoundFrom {
  std::array<double, Room::kSteps> from{};  ///< in the step that begins at q = i / kSteps, and beyond
  double at(double q) const noexcept {
    return q < 1.0 ? from[static_cast<std::size_t>(Room::kSteps * std::max(0.0, q))] : 0.0;
  }
};

/// Rate of change of a point's share of the centre's motion with its place, in units of q in any direction: the largest
/// first and second derivatives.
struct Steepness {
  UpperBoundFrom slope, bend;
};

struct LayeredFrame {
  LayeredShape shape;
  Room press_room;  ///< down and outward together
  Room drag_room;
  Steepness down, outward, drag;

  LayeredFrame() = default;
  explicit LayeredFrame(const LayeredShape& of) noexcept;

  double pressShare(double q) const noexcept {
    return tissue::curveAt(shape.press.down, tissue::kPressBend, q * q).value;
  }
  double dragShare(double q) const noexcept { return tissue::curveAt(shape.drag, tissue::kDragBend, q * q).value; }
};

}  // namespace palpate::deform
