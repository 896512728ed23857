#include "view/viewer/state/scene_document.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "view/viewer/state/home_view.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr double kMaxPitchDeg = 89.0;  // limit of [view]

/// Sets `kept` to `is` if that has changed.
template <class T>
void storeIfChanged(const T& was, const T& is, T& kept) {
  if (!(was == is)) kept = is;
}

void storeRangeIfChanged(const view::ColourRange& was, const view::ColourRange& is, std::optional<Vec2>& kept) {
  if (was.low != is.low || was.high != is.high) kept = Vec2(is.low, is.high);
}

void storeLookChanges(const view::Look& was, const view::Look& is, scene::Scene& scene) {
  scene::ViewSettings& view = scene.view;
  storeIfChanged(was.shading, is.shading, view.shading);
  storeIfChanged(was.colouring, is.colouring, view.colours);
  storeIfChanged(was.skin_opacity, is.skin_opacity, view.opacity);
  storeIfChanged(was.skin_tone, is.skin_tone, view.skin_tone);
  storeIfChanged(was.dent_contrast, is.dent_contrast, view.dent_contrast);
  storeIfChanged(was.finger, is.finger, view.finger);
  storeIfChanged(was.lens, is.lens, view.lens);
  storeIfChanged(was.white_background, is.white_background, view.white_background);
  storeIfChanged(was.texture, is.texture, view.texture);
  storeIfChanged(was.detail, is.detail, view.detail);
  storeIfChanged(was.scalar, is.scalar, view.scalar);
  storeIfChanged(was.scalar_map, is.scalar_map, view.scalar_map);
  storeRangeIfChanged(was.scalar_range, is.scalar_range, view.scalar_range);
  storeRangeIfChanged(was.stiffness_n_per_mm, is.stiffness_n_per_mm, view.stiffness_range_n_per_mm);
  storeRangeIfChanged(was.half_major_mm, is.half_major_mm, view.ellipse_range_mm);
  storeIfChanged(was.strain_percent.high, is.strain_percent.high, scene.strain.range_percent);
  if (was.overlays == is.overlays) return;
  view.show.clear();
  for (std::size_t i = 0; i < view::kOverlays; ++i) {
    if (is.overlays[i]) view.show.push_back(static_cast<view::Overlay>(i));
  }
}

void storeStereoChanges(const view::StereoSettings& was, const view::StereoSettings& is, scene::ViewSettings& view) {
  storeIfChanged(was.mode, is.mode, view.stereo);
  storeIfChanged(was.eye_distance_mm, is.eye_distance_mm, view.eye_distance_mm);
  storeIfChanged(was.convergence_mm, is.convergence_mm, view.convergence_mm);
  storeIfChanged(was.swap_eyes, is.swap_eyes, view.swap_eyes);
}

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

std::string textOf(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  return readFile(file, scene::kMaxSceneBytes);
}

void writeText(const fs::path& file, const std::string& text) {
  OutputFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace

SceneDocument loadDocument(const fs::path& file) {
  if (file.empty()) return {};
  try {
    return {fs::absolute(file).lexically_normal(), textOf(file)};
  } catch (const Error&) {
    return {fs::absolute(file).lexically_normal(), {}};
  }
}

bool wouldOverwrite(const SceneDocument& document, const fs::path& target) {
  std::error_code ignored;
  if (!fs::exists(target, ignored)) return false;
  if (fs::absolute(target).lexically_normal() != document.file) return true;
  try {
    return textOf(target) != document.text;
  } catch (const Error&) {
    return true;
  }
}

void storeCamera(const BodyView& seen, scene::ViewSettings& view) {
  const view::Camera camera = cameraOfFreePart(seen.camera, seen.state.shown, seen.size_points);
  const view::Camera plain;                                                 // default angle of view
  const bool rolled = std::abs(camera.roll_rad) > 0.25 * std::numbers::pi;  // only the table's view is
  view.side = rolled ? scene::StandardView::table : scene::StandardView::back;
  const double yaw_rad = rolled ? camera.yaw_rad + view::kTableYawRad : camera.yaw_rad;
  view.yaw_deg = rounded(std::remainder(yaw_rad, 2.0 * std::numbers::pi) / kRadPerDeg, 100.0);
  view.pitch_deg = std::clamp(rounded(camera.pitch_rad / kRadPerDeg, 100.0), -kMaxPitchDeg, kMaxPitchDeg);
  view.zoom = rounded(std::tan(0.5 * plain.height_rad) / std::tan(0.5 * camera.height_rad), 1000.0);
  view.look_at_mm = camera.centre.unaryExpr([](double mm) { return rounded(mm, 10.0); });
  view.distance_mm = rounded(camera.distance_mm, 10.0);
}

scene::Scene sceneAsChanged(const scene::Scene& edited, const BodyView& seen) {
  scene::Scene scene = edited;
  storeLookChanges(seen.opened.look, seen.state.look, scene);
  storeStereoChanges(seen.opened.stereo, seen.state.stereo, scene.view);
  return scene;
}

scene::Scene sceneToSave(const scene::Scene& edited, const BodyView& seen) {
  scene::Scene scene = sceneAsChanged(edited, seen);
  if (seen.opened.camera_moved) storeCamera(seen, scene.view);
  return scene;
}

SceneWriting writeScene(const scene::Scene& scene, const SceneDocument& document, const fs::path& target) {
  const fs::path file = fs::absolute(target).lexically_normal();
  SceneWriting writing;
  auto text = document.text.empty() ? std::nullopt : scene::patchedScene(document.text, scene, file);
  if (!document.text.empty() && !text && file == document.file) {
    writing.kept = withEnding(file, ".bak");
    writeText(writing.kept, document.text);
  }
  if (!text) text = scene::sceneAsToml(scene, file.parent_path());
  writing.document = {file, *text};
  writing.as_it_was = file == document.file && *text == document.text && fs::exists(file);
  if (!writing.as_it_was) writeText(file, *text);
  return writing;
}

}  // namespace palpate::viewer
