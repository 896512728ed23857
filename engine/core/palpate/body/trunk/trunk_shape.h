// The parameters of one trunk: build, curves of the spine, posture, unevenness, stature.
//
// trunk_field.h -> even_mesh.h -> here -> makeTrunk. Soft tissue grows or shrinks along the skin's normal; all else is
// a smooth warp of space that moves skin and bones alike, so that what lies under the skin stays there. Warps compose
// in one order: unevenness, curves of the spine, girth, posture, stature.
#pragma once

#include <array>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/body/skin_relief.h"
#include "palpate/body/skin_surface.h"

namespace palpate::body {

enum class Posture : unsigned char {
  standing,
  prone,   ///< face down on a table: chest and belly flattened
  sitting  ///< thighs forward, loin straighter
};

/// The fitted body: a man of 1750 mm of average build (trunk_table.h), measured on its bones (bones.h).
inline constexpr double kFittedMassIndex = 22.5;  ///< kg/m^2; our reading of "average", the shape has no mass
inline constexpr double kFittedKyphosisDeg = 38;  ///< T1 to T12
inline constexpr double kFittedLordosisDeg = 24;  ///< L1 to L5

struct TrunkShape {
  double stature_mm = 1750;                   ///< 500 to 2500; everything scales with it
  double girth = 1;                           ///< 0.8 to 1.3: breadth and depth of the frame, bones and all
  double body_mass_index = kFittedMassIndex;  ///< kg/m^2, 16 to 45: fat under the skin, most at belly, flanks, buttocks
  double muscle = 1;                          ///< 0 wasted, 1 as fitted, 2 an athlete
  double kyphosis_deg = kFittedKyphosisDeg;   ///< 15 to 65
  double lordosis_deg = kFittedLordosisDeg;   ///< 0 to 50
  Posture posture = Posture::standing;
  ReliefSettings relief = {};  ///< how much of the dorsal bones shows
  double asymmetry = 1;        ///< 0 symmetric, 1 naturally uneven
};

/// A number of the shape: its name in files and in words, and its range.
struct ShapeNumber {
  const char* name;
  const char* words;
  double TrunkShape::*member;
  double low, high;
  const char* unit;
};
inline constexpr std::array<ShapeNumber, 7> kShapeNumbers = {{
    {"stature_mm", "stature", &TrunkShape::stature_mm, 500, 2500, " mm"},
    {"girth", "girth", &TrunkShape::girth, 0.8, 1.3, ""},
    {"body_mass_index", "body mass index", &TrunkShape::body_mass_index, 16, 45, " kg/m2"},
    {"muscle", "muscle", &TrunkShape::muscle, 0, 2, ""},
    {"kyphosis_deg", "kyphosis", &TrunkShape::kyphosis_deg, 15, 65, " degrees"},
    {"lordosis_deg", "lordosis", &TrunkShape::lordosis_deg, 0, 50, " degrees"},
    {"asymmetry", "asymmetry", &TrunkShape::asymmetry, 0, 3, ""},
}};

/// Throws Error naming the setting that is out of its range.
void check(const TrunkShape& shape);

/// mm by which fat and muscle of this build move the skin outward at a place of the fitted skin; negative inward.
double softTissueGrowth(const TrunkShape& shape, const Vec3& place);

/// `growth`, where the bone is `depth_mm` below: skin that moves inward stops short of the bone.
double keptOffBone(double growth, double depth_mm);

/// The part of a trunk's shape that moves skin and bones alike. Made once; any thread.
class BodyWarp {
 public:
  explicit BodyWarp(const TrunkShape& shape);

  /// From the fitted body to this one, all but the posture's table and the stature.
  Vec3 operator()(const Vec3& point) const;

 private:
  /// A bend of the body in its plane of symmetry: height -> the place on a curved axis and its direction.
  class Bend {
   public:
    /// Over heights from low to high the axis turns by `angle`, forwards when positive.
    struct Window {
      double low, high, angle;
    };
    Bend(double axis_z, double fixed_y, std::vector<Window> windows, bool upright);
    Vec3 operator()(const Vec3& point) const;

   private:
    double angleAt(double y) const;

    double axis_z_;
    std::vector<Window> windows_;
    double angle_offset_ = 0;
    std::vector<Vec2> axis_;  // (y, z) of the bent axis a millimetre apart
  };

  Asymmetry asymmetry_;
  double girth_;
  Bend spine_;
  Bend hips_;
};

/// The plane of a table under a body whose most ventral skin is at `lowest_z`: how far it is pressed flat there, and
/// where a point goes. mm of a man of 1750 mm.
double tablePlane(double lowest_z);
Vec3 flattened(const Vec3& point, double plane_z);

}  // namespace palpate::body
