// The body cut open through a finger and the lump nearest to it: the pressed skin, the layers down to the bone, the
// lump and how far it has moved. True to scale in both directions.
//
// The plane contains the normal of the contact and the way to the lump's foot; over the lump it is the section's.
// Layers are drawn as if the tissue between skin and bone were squeezed evenly: an illustration, not the solver's
// displacements. No GL except in drawCutAway (cut_away_chart.cpp).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/world.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/overlays/plates.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

/// Half width of a cut on either side of its finger, mm. A lump farther away is not in the picture.
inline constexpr double kCutHalfWidthMm = 70.0;

/// Half length of the line on the skin.
inline constexpr double kCutLineMm = 30.0;

/// Width over height of the picture.
inline constexpr double kCutAspect = 1.5;

/// Points are in the plane of the cut: along it, and upward, mm from the finger's place on the skin.
struct CutAway {
  struct Layer {
    std::string name;         ///< "skin", "fat", "muscle"; or empty
    std::vector<Vec2> below;  ///< its lower border, in order of the skin
  };
  struct Lump {
    std::string name;
    double young_kpa = 0.0;
    std::vector<Vec2> rim = {};     ///< closed, where it is now; empty: off the plane
    std::vector<Vec2> placed = {};  ///< its place at rest
    Vec2 middle = Vec2::Zero();
    double moved_mm = 0.0;  ///< sideways, for a mobile one
  };
  SectionPlane plane;
  std::vector<Vec2> skin = {};              ///< now
  std::vector<Vec2> rest = {};              ///< at rest
  std::vector<Layer> layers = {};           ///< from the skin down; the last one ends at the bone; empty: unknown
  std::vector<Lump> lumps = {};             ///< the world's
  std::optional<std::size_t> nearest = {};  ///< among these, the one in the plane of the cut
  double bone_mm = 0.0;                     ///< below the finger; 0: unknown
  Vec2 finger = Vec2::Zero();               ///< the middle of the tip
  double finger_mm = 8.0;                   ///< its radius
  Vec3f colour = kLeftFinger;
  Vec2 low = Vec2(-30.0, -30.0);  ///< the picture: finger and lump, down to the bone where there is room
  Vec2 high = Vec2(30.0, 10.0);
};

/// The plane of the cut for the finger that presses deepest; empty without fingers.
std::optional<SectionPlane> cutPlane(const scene::World& world, std::span<const FingerMark> fingers);

/// Knows the layers of a world. The world must outlive it.
class CutMaker {
 public:
  /// Load time.
  explicit CutMaker(const scene::World& world);

  /// `deformed`: the place of a vertex. Empty without fingers, or where the finger is not over skin.
  std::optional<CutAway> cut(std::span<const FingerMark> fingers, const std::function<Vec3(Index)>& deformed) const;

 private:
  const scene::World& world_;
  std::optional<scene::LumpGround> ground_;  ///< empty where layers are unknown
};

/// The part of a plane within an ellipsoid: points round it; empty where the plane misses it. `half_mm` are its half
/// axes along the unit vectors `axes`.
std::vector<Vec2> ellipsoidIn(const SectionPlane& plane, const Vec3& middle, const std::array<Vec3, 3>& axes,
                              const std::array<double, 3>& half_mm);

/// Draws it on a plate `width` points wide and returns the area that it covers.
LabelBox drawCutAway(Drawing& page, const CutAway& cut, const Vec2f& lower_left, float width, const LabelInks& inks);

}  // namespace palpate::view
