// Everything that a synthetic pair of photographs is made of, as numbers: drawn from a seed, and free to be changed.
//
//   seed ─ drawCase ─► SyntheticCase ─ renderPair (synthetic_pair.h) ─► two pictures and the truth
//
// Frame of the back: x to the right as seen, y towards the head, z out of the back, mm; the middle of the back is 0.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "palpate/base/vec.h"

namespace palpate::measure {

/// A back 350 mm wide and 400 mm long (along the skin), as a height field.
struct BackShape {
  double flank_mm = 35.0;  ///< drop towards its sides
  double flank_power = 2.3;
  double sway_mm = 8.0;          ///< bow along the spine
  double blade_mm = 12.0;        ///< height of the shoulder blades
  double blade_apart_mm = 75.0;  ///< from the midline to each
  double furrow_mm = 6.0;        ///< depth of the furrow over the spine
  double furrow_width_mm = 14.0;
};

struct SkinLook {
  int colour = 0;  ///< 0 to 3, light to dark
  int moles = 15;  ///< and as many pimples
  int hairs = 60;
  std::uint64_t seed = 1;  ///< for everything that is drawn on it
};

enum class InkColour : unsigned char { red, blue, green };

/// Marks of the stencil, one hue.
struct DotMarks {
  InkColour ink = InkColour::red;
  double opacity = 0.85;
  double radius_mm = 4.0;
  double spacing_mm = 30.0;
  double jitter_mm = 0.4;  ///< error of the hand, sd along each axis
  int columns = 10;
  int rows = 12;
  Vec2 corner_mm = {-135.0, -165.0};  ///< dot at the bottom left
  int missing = 3;
  int strays = 5;
  std::uint64_t seed = 1;
};

/// `given`: see Press::given.
enum class TailFamily : unsigned char { compact, long_tail, half_space, windowed_half_space, given };

/// Effect of the stick on the skin.
struct Press {
  TailFamily family = TailFamily::compact;
  Vec2 contact_mm = Vec2::Zero();  ///< on the skin, before
  double peak_mm = 15.0;           ///< 0: nothing moves
  double drag_rad = 0.0;
  double half_major_mm = 80.0;  ///< where the skin moves 2 mm
  double ratio = 1.3;           ///< major over minor; a half space has its own
  double direction_rad = 0.0;   ///< major axis; a half space: along the drag
  double tail_power = 0.7;      ///< exponent of a long tail
  double sideways = 0.0;        ///< kappa of skin_field.h
  double asymmetry = 0.0;       ///< excess behind the stick over before it; 0.2: 20 %
  /// Displacement at a place from the contact, mm, of family `given`; its peak lies at 0 and is peak_mm along the drag.
  std::function<Vec2(const Vec2& offset_mm)> given = {};
  double dent_mm = 6.0;  ///< along the normal
  bool stick = true;     ///< stick, hand, forearm and their shadow are seen
  double stick_length_mm = 110.0;
  double stick_turn_rad = 0.0;  ///< turn of the stick against the opposite of the drag
  double arm_turn_rad = 0.2;    ///< turn of the forearm against the stick
};

struct CameraPose {
  double distance_mm = 1300.0;
  double tilt_rad = 0.1;
  double tilt_azimuth_rad = 0.0;
  double roll_rad = 0.0;
  double distortion = 0.0;             ///< k1: the share by which the corner of the picture is moved outwards
  Vec2 aim_mm = Vec2::Zero();          ///< point of the back where it looks
  Vec2 later_shift_mm = Vec2::Zero();  ///< motion of the camera, right and up, before the second picture
  double later_roll_rad = 0.0;
};

/// Motion of the body between two pictures, about its middle.
struct BodyMotion {
  Vec3 shift_mm = Vec3::Zero();
  Vec3 turn_rad = Vec3::Zero();
  double scale = 0.0;  ///< 0.001: larger by 0.1 %
};

struct PictureLook {
  Vec3 light = {0.4, 0.5, 0.76};  ///< towards it, of any length
  double ambient = 0.5;
  double sheen = 0.05;
  double vignette = 0.15;
  Vec3 balance = Vec3::Ones();  ///< gains of red, green, blue
  double exposure = 1.0;
  double blur_px = 0.8;
  double noise = 2.0;  ///< sd, of 255
  int jpeg_quality = 88;
  bool grey = false;  ///< black and white
  std::uint64_t seed = 1;
};

struct SyntheticCase {
  std::uint64_t seed = 1;
  int width_px = 1224;
  int height_px = 1632;
  BackShape back;
  SkinLook skin;
  DotMarks marks;
  Press press;
  CameraPose camera;
  BodyMotion motion;       ///< until the second picture
  BodyMotion null_motion;  ///< between the two pictures before the press
  PictureLook look;
};

/// Choices that can be made before the rest is drawn.
struct CaseRequests {
  double megapixels = 2.0;
  std::optional<TailFamily> family = {};  ///< none: compact or long, either as likely
  double drift_mm = 0.3;                  ///< 0.3: breath held; 1.5: breathing
};

/// The same for the same seed and requests, on every machine. Skin that would fold over before the stick is drawn
/// again.
SyntheticCase drawCase(std::uint64_t seed, const CaseRequests& requests = {});

/// A motion of the size of `drift_mm`, for `SyntheticCase::motion`.
BodyMotion drawMotion(std::uint64_t seed, double drift_mm);

}  // namespace palpate::measure
