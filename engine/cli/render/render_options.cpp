#include "cli/render/render_options.h"

#include <fmt/format.h>

#include "cli/render/film.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

/// --show's word for the colouring whose own name is also an overlay's.
constexpr std::string_view kEllipseMap = "ellipse-map";

/// The colouring that the word of --show means; a word that overlays have too means the overlay.
std::optional<scene::Colouring> colouringNamed(std::string_view name) {
  if (name == kEllipseMap) return scene::Colouring::ellipses;
  return valueNamed<scene::Overlay>(name) ? std::nullopt : valueNamed<scene::Colouring>(name);
}

std::vector<std::string> showNames() {
  std::vector<std::string> words = {"plain", "strain", "stiffness", "scalar", std::string(kEllipseMap)};
  for (const std::string& overlay : wordList<scene::Overlay>()) words.push_back(overlay);
  return words;
}

void useShow(const std::string& list, scene::ViewSettings& settings) {
  settings.show.clear();
  for (const std::string_view name : split(list, ',')) {
    if (const auto colouring = colouringNamed(name)) {
      settings.colours = *colouring;
    } else if (const auto overlay = valueNamed<scene::Overlay>(name)) {
      settings.show.push_back(*overlay);
    } else if (!name.empty()) {
      throw Error("--show: " + unknownName("word", name, "", showNames()));
    }
  }
}

template <class T>
void replace(T& setting, const std::optional<T>& by) {
  if (by) setting = *by;
}

/// Looks up a word that the command line has checked.
template <class T>
void replace(T& setting, const std::optional<std::string>& by) {
  if (by) setting = valueNamed<T>(*by).value_or(setting);
}

}  // namespace

namespace {

/// Uses a number of the body's file in place of the colours of --show.
void useScalar(const RenderOptions& options, scene::ViewSettings& settings) {
  if (options.scalar) {
    settings.colours = scene::Colouring::scalar;
    settings.scalar = *options.scalar;
  }
  replace(settings.scalar_map, options.scalar_map);
  if (options.scalar_range.empty()) return;
  if (!(options.scalar_range[0] < options.scalar_range[1]))
    throw Error("--scalar-range must be two increasing numbers");
  settings.scalar_range = Vec2(options.scalar_range[0], options.scalar_range[1]);
}

}  // namespace

scene::ViewSettings applyViewOptions(const RenderOptions& options, const scene::ViewSettings& of_scene) {
  scene::ViewSettings settings = of_scene;
  replace(settings.side, options.side);
  replace(settings.shading, options.shading);
  replace(settings.finger, options.finger);
  replace(settings.stereo, options.stereo);
  replace(settings.yaw_deg, options.yaw_deg);
  replace(settings.pitch_deg, options.pitch_deg);
  replace(settings.zoom, options.zoom);
  replace(settings.opacity, options.opacity);
  replace(settings.skin_tone, options.skin_tone);
  replace(settings.dent_contrast, options.dent_contrast);
  replace(settings.eye_distance_mm, options.eye_distance_mm);
  replace(settings.convergence_mm, options.convergence_mm);
  replace(settings.screen_height_mm, options.screen_height_mm);
  if (options.look_at && options.look_at->words.empty()) settings.look_at_mm = options.look_at->point;
  if (options.head_mm) settings.head_mm = options.head_mm;
  if (options.show) useShow(*options.show, settings);
  if (options.muscles) settings.show.push_back(scene::Overlay::muscles);
  useScalar(options, settings);
  settings.swap_eyes = settings.swap_eyes || options.swap_eyes;
  settings.white_background = settings.white_background || options.white;
  settings.lens = settings.lens || options.lens;
  replace(settings.texture, options.texture);
  settings.detail = settings.detail && options.detail;
  return settings;
}

film::FilmFormat filmFormat(const RenderOptions& options) {
  return {{options.size.width, options.size.height}, options.frames_per_s};
}

std::vector<std::filesystem::path> pictureFiles(const RenderOptions& options) {
  const bool film = isFilm(options.output);
  if (!film && options.output.extension() != ".png") {
    throw Error::inFile(options.output.string(),
                        "must be named *.png for pictures, or *.webm, *.gif or *.mp4 for films");
  }
  if (film && options.frames == 1) throw Error::inFile(options.output.string(), "a film requires --frames above 1");
  if (film) requireFilmWriter(options.output, filmFormat(options));
  if (options.frames == 1) return {options.output};
  std::vector<std::filesystem::path> files;
  for (int i = 1; i <= options.frames; ++i) files.push_back(fileOfSeries(options, i));
  return files;
}

std::filesystem::path fileOfSeries(const RenderOptions& options, int number) {
  return options.output.parent_path() / pathOf(fmt::format("{}_{:04d}.png", options.output.stem().string(), number));
}

}  // namespace palpate::app
