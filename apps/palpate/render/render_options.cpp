#include "apps/palpate/render/render_options.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/palpate/render/film.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

constexpr double kLargestSide = 16384;

/// --show's word for the colouring whose own name is also an overlay's.
constexpr std::string_view kEllipseMap = "ellipse-map";

int sideOf(std::string_view text, const std::string& size) {
  const auto number = parseNumber(text);
  if (!number || *number < 1 || *number > kLargestSide || std::floor(*number) != *number) {
    throw Error(fmt::format("--size {}: must be WIDTHxHEIGHT in pixels, e.g. 1280x720", size));
  }
  return static_cast<int>(*number);
}

Vec3 placeOf(const std::string& text, std::string_view option) {
  const auto fields = split(text, ',');
  Vec3 place;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = fields.size() == 3 ? parseNumber(fields[i]) : std::nullopt;
    if (!number || !std::isfinite(*number)) throw Error(fmt::format("{} {}: needs x,y,z in mm", option, text));
    place[static_cast<Eigen::Index>(i)] = *number;
  }
  return place;
}

/// The colouring that the word of --show means; a word that overlays have too means the overlay.
std::optional<scene::Colouring> colouringNamed(std::string_view name) {
  if (name == kEllipseMap) return scene::Colouring::ellipses;
  return valueNamed<scene::Overlay>(name) ? std::nullopt : valueNamed<scene::Colouring>(name);
}

void useShow(const std::string& list, scene::ViewSettings& settings) {
  settings.show.clear();
  for (const std::string_view name : split(list, ',')) {
    if (const auto colouring = colouringNamed(name)) {
      settings.colours = *colouring;
    } else if (const auto overlay = valueNamed<scene::Overlay>(name)) {
      settings.show.push_back(*overlay);
    } else if (!name.empty()) {
      throw Error(fmt::format("--show {}: '{}' must be one of plain, strain, stiffness, scalar, {}, {}", list, name,
                              kEllipseMap, fmt::join(allWords<scene::Overlay>(), ", ")));
    }
  }
}

template <class T>
void replace(T& setting, const std::optional<T>& by) {
  if (by) setting = *by;
}

/// By a word that the command line has checked.
template <class T>
void replace(T& setting, const std::optional<std::string>& by) {
  if (by) setting = valueNamed<T>(*by).value_or(setting);
}

}  // namespace

namespace {

/// A number of the body's file in place of what --show colours by.
void useScalar(const RenderOptions& options, scene::ViewSettings& settings) {
  if (options.scalar) {
    settings.colours = scene::Colouring::scalar;
    settings.scalar = *options.scalar;
  }
  replace(settings.scalar_map, options.scalar_map);
  if (options.scalar_range.empty()) return;
  if (!(options.scalar_range[0] < options.scalar_range[1])) throw Error("--scalar-range needs two rising numbers");
  settings.scalar_range = Vec2(options.scalar_range[0], options.scalar_range[1]);
}

}  // namespace

view::PictureSize sizeOf(const RenderOptions& options) {
  const auto sides = split(options.size, 'x');
  if (sides.size() != 2) sideOf("", options.size);
  return {sideOf(sides[0], options.size), sideOf(sides[1], options.size), options.supersampling};
}

scene::ViewSettings viewOf(const RenderOptions& options, const scene::ViewSettings& of_scene) {
  scene::ViewSettings settings = of_scene;
  replace(settings.side, options.side);
  replace(settings.shading, options.shading);
  replace(settings.finger, options.finger);
  replace(settings.stereo, options.stereo);
  replace(settings.yaw_deg, options.yaw_deg);
  replace(settings.pitch_deg, options.pitch_deg);
  replace(settings.zoom, options.zoom);
  replace(settings.opacity, options.opacity);
  replace(settings.eye_distance_mm, options.eye_distance_mm);
  replace(settings.convergence_mm, options.convergence_mm);
  replace(settings.screen_height_mm, options.screen_height_mm);
  if (options.look_at) settings.look_at_mm = placeOf(*options.look_at, "--look-at");
  if (options.head) settings.head_mm = placeOf(*options.head, "--head-mm");
  if (options.show) useShow(*options.show, settings);
  useScalar(options, settings);
  settings.swap_eyes = settings.swap_eyes || options.swap_eyes;
  settings.white_background = settings.white_background || options.white;
  settings.texture = settings.texture && options.texture;
  settings.detail = settings.detail && options.detail;
  return settings;
}

std::vector<std::filesystem::path> filesOf(const RenderOptions& options) {
  const bool film = isFilm(options.output);
  if (!film && options.output.extension() != ".png") {
    throw Error::inFile(options.output.string(),
                        "must be named *.png: pictures are written as PNG, films as *.mp4 or *.webm");
  }
  if (film && options.frames == 1) throw Error::inFile(options.output.string(), "a film needs --frames above 1");
  if (options.frames == 1) return {options.output};
  std::vector<std::filesystem::path> files;
  for (int i = 1; i <= options.frames; ++i) files.push_back(fileOfSeries(options, i));
  return files;
}

std::filesystem::path fileOfSeries(const RenderOptions& options, int number) {
  return options.output.parent_path() / fmt::format("{}_{:04d}.png", options.output.stem().string(), number);
}

}  // namespace palpate::app
