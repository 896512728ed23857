// [view] of a scene -> the camera that sees the whole body, turned; zoom is a longer lens at the same place, which
// cannot enter the body. Ranges of colours come from the world's values. Load time.
#include "palpate/view/scene_view.h"

#include <algorithm>
#include <cmath>

#include "palpate/scene/skin_channels.h"

namespace palpate::view {

namespace {

Camera makeSceneCamera(const scene::World& world, const scene::ViewSettings& view, double aspect) {
  Camera camera = fitted(mesh::boundingBox(world.body->skin), aspect, view.side);
  camera.yaw_rad += kRadPerDeg * view.yaw_deg;
  camera.pitch_rad = std::clamp(camera.pitch_rad + kRadPerDeg * view.pitch_deg, -kRadPerDeg * 89.9, kRadPerDeg * 89.9);
  camera = fitted(mesh::boundingBox(world.body->skin), aspect, camera);
  // A longer lens from the same place: it never enters the body.
  camera.height_rad = 2.0 * std::atan(std::tan(0.5 * camera.height_rad) / view.zoom);
  if (view.look_at_mm) camera.centre = *view.look_at_mm;
  if (view.distance_mm > 0.0) camera.distance_mm = view.distance_mm;
  return camera;
}

template <class Values>
ColourRange valueRange(const Values& values, const ColourRange& fallback) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return low != values.end() && *low < *high ? ColourRange{*low, *high} : fallback;
}

std::vector<double> skinHalfMajors(const scene::World& world) {
  std::vector<double> lengths;
  lengths.reserve(world.body->skin.positions.size());
  for (const Vec3& place : world.body->skin.positions) {
    lengths.push_back(world.ellipses.at(place.x(), place.y()).half_major_mm);
  }
  return lengths;
}

void applyRange(const std::optional<Vec2>& ends, ColourRange& range) {
  if (ends) range = {ends->x(), ends->y()};
}

Look makeLook(const scene::World& world, const scene::ViewSettings& view) {
  Look look;
  look.shading = view.shading;
  look.colouring = view.colours;
  for (const Overlay overlay : view.show) look.show(overlay);
  look.skin_opacity = view.opacity;
  look.skin_tone = view.skin_tone;
  look.dent_contrast = view.dent_contrast;
  look.finger = view.finger;
  look.lens = view.lens;
  look.white_background = view.white_background;
  look.texture = view.texture;
  look.detail = view.detail;
  look.strain_percent = {-world.scene.strain.range_percent, world.scene.strain.range_percent};
  look.stiffness_n_per_mm = valueRange(*world.surface.stiffness_n_per_mm, look.stiffness_n_per_mm);
  showScalar(world, view.scalar, look);
  look.scalar_map = view.scalar_map;
  if (look.colouring == Colouring::ellipses) look.half_major_mm = valueRange(skinHalfMajors(world), look.half_major_mm);
  applyRange(view.scalar_range, look.scalar_range);
  applyRange(view.stiffness_range_n_per_mm, look.stiffness_n_per_mm);
  applyRange(view.ellipse_range_mm, look.half_major_mm);
  return look;
}

StereoSettings toStereoSettings(const scene::ViewSettings& view) {
  StereoSettings stereo;
  stereo.mode = view.stereo;
  stereo.eye_distance_mm = view.eye_distance_mm;
  stereo.convergence_mm = view.convergence_mm;
  stereo.swap_eyes = view.swap_eyes;
  if (view.head_mm) stereo.head = TrackedHead{*view.head_mm, view.screen_height_mm};
  return stereo;
}

}  // namespace

void showScalar(const scene::World& world, std::string_view name, Look& look) {
  const scene::SkinScalar* scalar = scene::scalarNamed(world.body->channels.get(), name);
  if (scalar == nullptr) return;
  look.scalar = scalar->name;
  const bool varies = scalar->least < scalar->greatest;
  look.scalar_range = {scalar->least, varies ? scalar->greatest : scalar->least + 1.0};
}

PictureSettings pictureSettings(const scene::World& world, const scene::ViewSettings& view, double aspect) {
  PictureSettings settings;
  settings.camera = makeSceneCamera(world, view, aspect);
  settings.look = makeLook(world, view);
  settings.stereo = toStereoSettings(view);
  return settings;
}

PictureSettings pictureSettings(const scene::World& world, double aspect) {
  return pictureSettings(world, world.scene.view, aspect);
}

}  // namespace palpate::view
