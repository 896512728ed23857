// The pressure under fingertips as pictures: taxels on the skin, and a plate for each finger with a scale in kPa.
//
//   FingerMark ─ PadReader ─► PadReading ─┬─► addPad, on the skin, seen through the finger
//                                         └─► drawPads, in a corner of the page
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/lines.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

/// The pressure on the pad of a finger.
struct PadReading {
  contact::PressurePad pad;
  std::vector<double> kpa;  ///< rows from the head down, each in the order of u (contact/pressure_field.h)
  double greatest_kpa = 0.0;
  bool touches = false;
  Vec3f colour = kLeftFinger;  ///< colour of the finger
  // For one in contact, on the body at rest.
  Vec3 middle = Vec3::Zero();  ///< on the skin
  Vec3 normal = Vec3::UnitZ();
};

/// Knows the patterns of a world's tissue. The world must outlive it.
class PadReader {
 public:
  /// Load time: some milliseconds where neither lumps nor pads of the scene have computed the patterns before.
  explicit PadReader(const scene::World& world);

  /// One per finger, in order; none where the tissue has no known pattern. `lift_mm`: how far the breath has moved the
  /// body. Some microseconds a finger.
  std::vector<PadReading> read(std::span<const FingerMark> fingers, double lift_mm) const;

  /// The reason for none; empty where there are some.
  const std::string& missing() const { return missing_; }

 private:
  const scene::World& world_;
  std::shared_ptr<const contact::PressureGround> ground_;
  std::string missing_;
};

/// Upper end of a scale for these pads: a round number, at least 5 kPa, so that a light touch looks light.
double padScaleTop(std::span<const PadReading> readings);

/// From nearly black over red to light yellow, for shares of the scale from 0 to 1. Lightness rises throughout, so that
/// it can be read without colours.
ColourBytes heatColour(double share);

/// The taxels under pressure as patches on the deformed skin, and the rim of the pad; nothing for a finger without
/// contact.
void addPad(const PadReading& reading, double top_kpa, const scene::World& world, const DrawnSkin& skin,
            Patches& patches, Lines& lines);

/// Draws plates from the lower right corner `corner` of their room to the left, `width` points in all at most, and
/// returns the areas that they cover.
std::vector<LabelBox> drawPads(Drawing& page, std::span<const PadReading> readings, const Vec2f& corner, float width,
                               const LabelInks& inks);

}  // namespace palpate::view
