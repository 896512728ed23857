// Eyes before one screen, and the place of each one's picture in the whole. Comfort depends on the parallax of the
// box's nearest and farthest corner, p = e (1/z - 1/D) as an angle; too much of it shortens the distance of the eyes.
// Based on: see stereo.h.
#include "palpate/view/stereo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"

namespace palpate::view {

namespace {

bool isSideBySide(StereoMode mode) {
  return mode == StereoMode::sbs_half || mode == StereoMode::sbs_full || mode == StereoMode::sbs_cross;
}
bool isTopBottom(StereoMode mode) { return mode == StereoMode::tb_half || mode == StereoMode::tb_full; }

Screen rectangle(const Vec3& middle, const Vec3& half_right, const Vec3& half_up) {
  return {middle - half_right - half_up, middle + half_right - half_up, middle - half_right + half_up};
}

void placeTrackedHead(const Camera& camera, const TrackedHead& head, double aspect, Eyes& eyes) {
  if (!(head.eyes_mm.z() > 0.0)) throw Error("the tracked head must be in front of its screen");
  const double half_height = 0.5 * head.screen_height_mm;
  eyes.screen = rectangle(camera.centre, aspect * half_height * camera.right(), half_height * camera.up());
  eyes.middle = camera.centre + head.eyes_mm.x() * camera.right() + head.eyes_mm.y() * camera.up() +
                head.eyes_mm.z() * camera.backward();
  eyes.distance_mm = head.eyes_mm.z();
}

void placeCamera(const Camera& camera, double convergence_mm, double aspect, Eyes& eyes) {
  eyes.middle = camera.eye();
  eyes.distance_mm = convergence_mm > 0.0 ? convergence_mm : camera.distance_mm;
  const double half_height = eyes.distance_mm * std::tan(0.5 * camera.height_rad);
  eyes.screen = rectangle(eyes.middle - eyes.distance_mm * camera.backward(), aspect * half_height * camera.right(),
                          half_height * camera.up());
}

/// Distances of the nearest and the farthest corner of the box, square to the screen.
struct Span {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();
};

Span computeDepthRange(const Eyes& eyes, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return {eyes.distance_mm, eyes.distance_mm};
  const Vec3 right = eyes.screen.lower_right - eyes.screen.lower_left;
  const Vec3 forward = (eyes.screen.upper_left - eyes.screen.lower_left).cross(right).normalized();
  Span span;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    const double distance = forward.dot(place - eyes.middle);
    span.nearest = std::min(span.nearest, distance);
    span.farthest = std::max(span.farthest, distance);
  }
  return span;
}

/// The near plane as a share of D.
constexpr double kNearShare = 0.3;
/// The same for one eye.
constexpr double kNearShareOfOneEye = 0.04;

}  // namespace

bool isStereo(StereoMode mode) { return mode != StereoMode::mono; }
bool hasTwoParts(StereoMode mode) { return isSideBySide(mode) || isTopBottom(mode); }

StereoMode stereoModeNamed(std::string_view name) {
  if (const auto mode = valueNamed<StereoMode>(name)) return *mode;
  throw Error(fmt::format("stereo mode '{}': must be one of {}", name, fmt::join(kStereoModeNames, ", ")));
}

Eyes placeEyes(const Camera& camera, const StereoSettings& settings, double aspect) {
  Eyes eyes;
  if (settings.head) {
    placeTrackedHead(camera, *settings.head, aspect, eyes);
  } else {
    placeCamera(camera, settings.convergence_mm, aspect, eyes);
  }
  const double apart_mm = isStereo(settings.mode) ? settings.eye_distance_mm : 0.0;
  const Vec3 half = 0.5 * apart_mm * camera.right();
  eyes.left = eyes.middle - half;
  eyes.right = eyes.middle + half;
  return eyes;
}

DepthRange computeClipRange(const Eyes& eyes, const Eigen::AlignedBox3d& box, double room_mm) {
  const Span span = computeDepthRange(eyes, box);
  const bool two_eyes = eyes.left != eyes.right;
  const double near_mm =
      std::max((two_eyes ? kNearShare : kNearShareOfOneEye) * eyes.distance_mm, span.nearest - room_mm);
  return {near_mm, std::max(span.farthest + room_mm, 2.0 * near_mm)};
}

Frustum makeFrustum(const Eyes& eyes, Eye eye, const DepthRange& range) {
  return makeFrustum(eyes.screen, eyes.of(eye), range.near_mm, range.far_mm);
}

EyePicture eyePictureIn(StereoMode mode, int width, int height) {
  const bool beside = isSideBySide(mode);
  const bool above = isTopBottom(mode);
  const bool squeezed = mode == StereoMode::sbs_half || mode == StereoMode::tb_half;
  EyePicture picture;
  picture.width = std::max(1, beside ? width / 2 : width);
  picture.height = std::max(1, above ? height / 2 : height);
  picture.seen_width = squeezed ? width : picture.width;
  picture.seen_height = squeezed ? height : picture.height;
  return picture;
}

Corner pictureCorner(Eye eye, const StereoSettings& settings, int width, int height) {
  const bool second = (eye == Eye::right) != (settings.swap_eyes != (settings.mode == StereoMode::sbs_cross));
  if (isSideBySide(settings.mode)) return {second ? width - width / 2 : 0, 0};
  if (isTopBottom(settings.mode)) return {0, second ? 0 : height - height / 2};
  return {};
}

Vec2 placeInEye(StereoMode mode, const Vec2& place) {
  const auto folded = [](double x) { return x < 0.5 ? 2.0 * x : 2.0 * x - 1.0; };
  if (isSideBySide(mode)) return {folded(place.x()), place.y()};
  if (isTopBottom(mode)) return {place.x(), folded(place.y())};
  return place;
}

Comfort computeComfort(const Eyes& eyes, double eye_distance_mm, const Eigen::AlignedBox3d& box) {
  const Span span = computeDepthRange(eyes, box);
  const double nearest = std::max(span.nearest, kNearShare * eyes.distance_mm);
  const double screen = 1.0 / eyes.distance_mm;
  return {.front_deg = kDegPerRad * eye_distance_mm * std::max(0.0, 1.0 / nearest - screen),
          .behind_deg = kDegPerRad * eye_distance_mm * std::max(0.0, screen - 1.0 / std::max(span.farthest, nearest))};
}

ComfortableStereo comfortable(const Camera& camera, const StereoSettings& settings, double aspect,
                              const Eigen::AlignedBox3d& box) {
  ComfortableStereo result{settings, {}};
  if (!isStereo(settings.mode)) return result;
  const double asked_mm = settings.eye_distance_mm;
  const double worst_deg = computeComfort(placeEyes(camera, settings, aspect), asked_mm, box).worst();
  if (worst_deg <= kComfortableDeg) return result;
  if (worst_deg <= kFusibleDeg || settings.head) {
    result.note = fmt::format("the stereo picture reaches {:.1f} degrees of parallax; above {:.0f} it tires the eyes",
                              worst_deg, kComfortableDeg);
    return result;
  }
  result.settings.eye_distance_mm = asked_mm * kFusibleDeg / worst_deg;
  result.note = fmt::format("eye distance reduced from {:.0f} to {:.1f} mm: {:.1f} degrees of parallax cannot be fused",
                            asked_mm, result.settings.eye_distance_mm, worst_deg);
  return result;
}

UsableMode usableMode(StereoMode wanted, bool quad_buffer_offered, StereoMode otherwise) {
  if (wanted != StereoMode::quad_buffer || quad_buffer_offered) return {wanted, {}};
  return {otherwise, fmt::format("quad-buffer stereo is not offered here (it needs a window on a stereo visual); "
                                 "drawing {} instead",
                                 wordFor(otherwise))};
}

}  // namespace palpate::view
