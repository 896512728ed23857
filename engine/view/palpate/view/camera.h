// The eye and the screen: an orbit camera, and the off-axis frustum of any eye before any screen.
//
// One description serves the desktop, both eyes of a stereo pair and a tracked head before a co-located display: a
// rectangle in the world (the screen) and a point (the eye). The desktop is the case of a virtual screen through the
// orbit's centre. No GL here; pure functions over plain data.
// Based on: Kooima, "Generalized perspective projection", 2008; Ji, Williams, Howell, Conatser, "3D stereo viewing
// evaluation for the Virtual Haptic Back", 2006 (why off-axis: toe-in makes vertical parallax).
#pragma once

#include <cstdint>
#include <string_view>

#include "palpate/base/vec.h"
#include "palpate/scene/view_settings.h"

namespace palpate::view {

using Mat4f = Eigen::Matrix4f;

using scene::StandardView;
inline constexpr auto kStandardViewNames = enumNames<StandardView>();

/// Looks at `centre` from a distance; at yaw 0 and pitch 0 from behind the patient (along -z), cranial up.
struct Camera {
  Vec3 centre = Vec3::Zero();   ///< mm, body frame: what the camera turns about
  double yaw_rad = 0.0;         ///< about the cranial axis; positive sees more of the patient's right
  double pitch_rad = 0.0;       ///< positive looks from above, in (-pi/2, pi/2)
  double distance_mm = 1000.0;  ///< from the centre, > 0
  double height_rad = 0.5;      ///< full vertical angle of view
  double roll_rad = 0.0;

  Mat3 axes() const;  ///< columns: to the right, up, backward
  Vec3 right() const { return axes().col(0); }
  Vec3 up() const { return axes().col(1); }
  Vec3 backward() const { return axes().col(2); }  ///< from the centre to the eye
  Vec3 eye() const { return centre + distance_mm * backward(); }
};

/// Angles of StandardView::table: the view down at a table from its side.
inline constexpr double kTableYawRad = 0.9;

/// A camera that sees the whole box from one side, with a margin of a twentieth.
Camera fitted(const Eigen::AlignedBox3d& box, double aspect, StandardView side = StandardView::back);
/// The same with the angles and the lens of a camera.
Camera fitted(const Eigen::AlignedBox3d& box, double aspect, Camera camera);

/// A screen in the world: lower left, lower right and upper left corner, mm.
struct Screen {
  Vec3 lower_left, lower_right, upper_left;
};

/// The virtual screen of a camera: through its centre, square to its axis. `aspect` is width over height.
Screen cameraScreen(const Camera& camera, double aspect);

struct Frustum {
  Mat4f view = Mat4f::Identity();        ///< body frame -> eye frame (x right, y up, z to the eye)
  Mat4f projection = Mat4f::Identity();  ///< eye frame -> clip
  Vec3 eye = Vec3::Zero();
  Mat4f clip() const { return projection * view; }
  /// Places relative to `origin` -> clip: for bodies so far away that floats of the body frame are too coarse.
  Mat4f clipFrom(const Vec3& origin) const;
};

/// The frustum of an eye before a screen (Kooima). Throws Error for an eye that is not in front of the screen.
Frustum makeFrustum(const Screen& screen, const Vec3& eye, double near_mm, double far_mm);

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit
};

/// The ray through a place of the screen: x from 0 (left) to 1, y from 0 (top) to 1.
Ray rayThrough(const Screen& screen, const Vec3& eye, double x, double y);

/// A place in the world on the screen: x, y as in rayThrough. Points behind the eye give NaN.
Vec2 seenAt(const Frustum& frustum, const Vec3& point);

}  // namespace palpate::view
