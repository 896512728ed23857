// The options of `palpate render`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/body_place.h"
#include "cli/kit/simulate_options.h"
#include "palpate/film/film.h"
#include "palpate/scene/view_settings.h"
#include "palpate/view/picture.h"

namespace palpate::app {

struct RenderOptions {
  SimulateOptions scene;
  std::optional<double> at_s;
  std::vector<std::vector<BodyPlace>> poses;
  std::filesystem::path output = "picture.png";
  view::PictureSize size;
  int frames = 1;
  double frames_per_s = 25.0;
  std::string title;
  bool labels = true;
  bool json = false;
  // Replacements for the scene's [view]; empty: the scene's.
  std::optional<std::string> side, show, shading, finger, stereo;
  std::optional<std::string> scalar, scalar_map;
  std::vector<double> scalar_range;
  std::optional<BodyPlace> look_at;
  std::optional<Vec3> head_mm;
  std::optional<double> yaw_deg, pitch_deg, zoom, opacity, skin_tone, dent_contrast, eye_distance_mm, convergence_mm,
      screen_height_mm;
  bool swap_eyes = false;
  bool white = false;
  bool lens = false;
  bool muscles = false;  ///< with the overlays of `show`; refused on a body without
  std::optional<bool> texture;
  bool detail = true;
};

/// The scene's view with the options' replacements. Throws Error for an unknown name in --show, which accepts overlays
/// and the words strain, stiffness, ellipse-map and plain for the colours of the skin.
scene::ViewSettings applyViewOptions(const RenderOptions& options, const scene::ViewSettings& of_scene);

film::FilmFormat filmFormat(const RenderOptions& options);

/// The files of the pictures in order: FILE.png alone, else FILE_0001.png and so on. Throws Error for a name that is
/// neither a picture's nor a film's, for a film of one picture, and for a film that cannot be made here.
std::vector<std::filesystem::path> pictureFiles(const RenderOptions& options);
/// One of a series, counted from 1.
std::filesystem::path fileOfSeries(const RenderOptions& options, int number);

/// `palpate render`: draws, writes and, if it `prints_summary`, prints a summary. Throws Error.
void drawPictures(const RenderOptions& options, bool prints_summary = true);

}  // namespace palpate::app
