// Two eyes before one screen: where they are, what each sees, and the place of its picture.
//
//   Camera, StereoSettings ─► Eyes (screen + two places) ─► makeFrustum each ─► two pictures ─► StereoComposer ─► one
//
// Pure functions; the compose pass is in stereo_composer.h. A point at distance z from the eyes appears in the right
// eye's picture by  p = e (1 - D / z)  to the right of where the left eye's has it, D being the distance to the screen:
// nothing at the screen, up to e far behind it, negative before it.
// Based on: Ji, Williams, Howell, Conatser, "3D stereo viewing evaluation for the Virtual Haptic Back", 2006 (off-axis
// frusta, never toe-in); Kooima, "Generalized perspective projection", 2008.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/view/camera.h"

namespace palpate::view {

using scene::StereoMode;
inline constexpr auto kStereoModeNames = enumNames<StereoMode>();

/// A head before a real screen of known size, for displays that share their place with the hand. The camera then places
/// that screen in the world: its middle at the centre, its axes those of the camera, at true size.
struct TrackedHead {
  /// Between the eyes, mm, in the frame of the screen: origin in its middle, x right, y up, z towards the head; z > 0.
  Vec3 eyes_mm = {0.0, 0.0, 600.0};
  double screen_height_mm = 300.0;
};

struct StereoSettings {
  StereoMode mode = StereoMode::mono;
  double eye_distance_mm = 63.0;  ///< mean of adults (most have 50 to 75); 0 = both eyes see the same
  /// From the eyes to the plane that appears on the screen; 0 = the camera's centre. Not used with a tracked head.
  double convergence_mm = 0.0;
  bool swap_eyes = false;
  int monitor_row = 0;  ///< interlaced: row of the monitor under the picture's top row
  std::optional<TrackedHead> head;
};

enum class Eye : std::uint8_t { left, right };

/// The screen in the world and the eyes before it, mm, body frame.
struct Eyes {
  Screen screen;
  Vec3 middle = Vec3::Zero();
  Vec3 left = Vec3::Zero();
  Vec3 right = Vec3::Zero();
  double distance_mm = 0.0;  ///< D: from the eyes to the plane of the screen
  const Vec3& of(Eye eye) const { return eye == Eye::left ? left : right; }
};

/// `aspect` is width over height of one eye's picture as it is seen (EyePicture::aspect()). In mono, both eyes are in
/// the middle. Throws Error for a tracked head behind its screen.
Eyes placeEyes(const Camera& camera, const StereoSettings& settings, double aspect);

/// Near and far plane around the box and nearer things: balls and overlays, or a hand with its forearm. The near plane
/// of two eyes is at least 0.3 D away: nearer things cannot be fused.
struct DepthRange {
  double near_mm, far_mm;
};
inline constexpr double kRoomMm = 120.0;
inline constexpr double kRoomForHandsMm = 500.0;
DepthRange computeClipRange(const Eyes& eyes, const Eigen::AlignedBox3d& box, double room_mm = kRoomMm);

Frustum makeFrustum(const Eyes& eyes, Eye eye, const DepthRange& range);

/// One eye's picture: its pixels, and their number before squeezing.
struct EyePicture {
  int width = 0;
  int height = 0;
  int seen_width = 0;
  int seen_height = 0;
  double aspect() const { return static_cast<double>(seen_width) / seen_height; }
};
EyePicture eyePictureIn(StereoMode mode, int width, int height);

/// Start of an eye's picture in the whole one, pixels from the left and from below (as GL counts).
struct Corner {
  int x = 0;
  int y = 0;
};
Corner pictureCorner(Eye eye, const StereoSettings& settings, int width, int height);

/// From a place in the whole picture (0 to 1 from the left and from the top) to the place in an eye's picture: for the
/// mouse, whichever half it is in.
Vec2 placeInEye(StereoMode mode, const Vec2& place);

bool isStereo(StereoMode mode);
/// Whether each eye's picture has its own part of the whole one: the system's pointer would be in one of them only.
bool hasTwoParts(StereoMode mode);
/// Throws Error naming the modes.
StereoMode stereoModeNamed(std::string_view name);

/// Parallax of the nearest and the farthest point, degrees.
struct Comfort {
  double front_deg = 0.0;   ///< before the screen
  double behind_deg = 0.0;  ///< behind it
  double worst() const { return front_deg > behind_deg ? front_deg : behind_deg; }
};
inline constexpr double kComfortableDeg = 1.0;  ///< for long looking
inline constexpr double kFusibleDeg = 2.0;      ///< most people see two pictures beyond (Nagata 2002)
Comfort computeComfort(const Eyes& eyes, double eye_distance_mm, const Eigen::AlignedBox3d& box);

/// The settings with the eyes so near to each other that nothing in the box passes kFusibleDeg; a tracked head keeps
/// its own eyes. `note` is a sentence for the user: a reduction, or a discomfort; empty when all is well.
struct ComfortableStereo {
  StereoSettings settings;
  std::string note;
};
ComfortableStereo comfortable(const Camera& camera, const StereoSettings& settings, double aspect,
                              const Eigen::AlignedBox3d& box);

/// The mode that can be shown: quad-buffer needs a screen with it, and `otherwise` replaces it with a note.
struct UsableMode {
  StereoMode mode = StereoMode::mono;
  std::string note;
};
UsableMode usableMode(StereoMode wanted, bool quad_buffer_offered, StereoMode otherwise = StereoMode::mono);

}  // namespace palpate::view
