// `palpate render`: pictures of a scene without a window or a display.
//
//   scene ─ build ─► world ─ run to the moment ─► fingers ─ deform ─► surface ─► Studio ─► PNG, one or a sequence; a
//   film
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/palpate/common/commands.h"
#include "apps/palpate/common/interruption.h"
#include "apps/palpate/common/progress_line.h"
#include "apps/palpate/render/film.h"
#include "apps/palpate/render/moments.h"
#include "apps/palpate/render/picture_series.h"
#include "apps/palpate/render/render_options.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/view/scene_view.h"

namespace palpate::app {

namespace {

using Json = nlohmann::ordered_json;
/// What was drawn: one file, the moment and the fingers in it.
struct DrawnPicture {
  std::string file;
  double time_s = 0.0;
  servo::TickSamples frame;
};

struct RenderReport {
  std::vector<DrawnPicture> pictures;
  std::string film;          ///< the file that the pictures became; empty: they are files of their own
  bool film_missed = false;  ///< a film was asked for, but there is no ffmpeg
  std::vector<std::string> notes;
  view::PictureSize size;
  double build_s = 0.0;
  double draw_s = 0.0;
};

scene::Scene sceneFor(const RenderOptions& options) {
  scene::Scene scene = sceneFor(options.scene);
  if (!options.poses.empty()) useFingersAt(options.poses, options.scene.radius_mm, scene);
  scene.view = viewOf(options, scene.view);
  return scene;
}

/// The moments to draw; a lone pose is drawn when its finger has arrived.
std::vector<double> timesOf(const RenderOptions& options, const scene::World& world, const device::FingerPaths& paths) {
  const double end_s = static_cast<double>(paths.ticks - 1) / world.scene.ticks_per_s;
  const double sequence_s = (options.frames - 1) / options.frames_per_s;
  const double first = options.at_s.value_or(options.poses.empty() ? 0.0 : std::max(0.0, end_s - sequence_s));
  std::vector<double> times;
  for (int i = 0; i < options.frames; ++i) times.push_back(first + i / options.frames_per_s);
  return times;
}

/// Without a moment or a pose: the body at rest, alone.
bool isAtRest(const RenderOptions& options) { return !options.at_s && options.poses.empty() && options.frames == 1; }

std::vector<servo::TickSamples> framesFor(const RenderOptions& options, const scene::World& world,
                                          std::vector<double>& times, const Progress& progress) {
  if (isAtRest(options)) {
    times = {0.0};
    return {servo::TickSamples{}};
  }
  const device::FingerPaths paths = options.poses.empty() ? device::pathsOf(world) : pathsToPoses(world, options.poses);
  times = timesOf(options, world, paths);
  return framesAt(world, paths, times, progress);
}

view::PictureSettings settingsFor(const RenderOptions& options, const scene::World& world,
                                  const view::PictureSize& size) {
  const auto mode = world.scene.view.stereo;
  const double aspect = view::eyePictureIn(mode, size.width, size.height).aspect();
  view::PictureSettings settings = view::pictureSettings(world, aspect);
  settings.labels.title = options.title;
  settings.labels.finger_names = fingerNames(world);
  if (!options.labels) settings.labels = view::LabelSettings::none();
  return settings;
}

/// Pictures of an earlier, longer series would be taken for parts of this one; those that a signal left out are missed.
void noteTheOthers(const RenderOptions& options, RenderReport& result) {
  const auto count = static_cast<int>(result.pictures.size());
  if (count < options.frames) {
    result.notes.push_back(
        fmt::format("ended by {} after {} of {} pictures", nameOfSignal(endAskedBy()), count, options.frames));
  }
  const std::filesystem::path next = fileOfSeries(options, count + 1);
  if (result.film.empty() && options.frames > 1 && std::filesystem::exists(next)) {
    result.notes.push_back(fmt::format("{} and what follows is of an earlier series", next.string()));
  }
}

/// For a film; without ffmpeg its pictures are left, and a note says how they are joined.
std::optional<std::filesystem::path> ffmpegFor(const RenderOptions& options, RenderReport& result) {
  if (!isFilm(options.output)) return std::nullopt;
  auto ffmpeg = installedFfmpeg();
  if (ffmpeg) return ffmpeg;
  result.film_missed = true;
  result.notes.push_back(fmt::format("no {}: ffmpeg is not installed; where it is, join the pictures with: {}",
                                     options.output.string(), commandToJoin(options.output, options.frames_per_s)));
  return std::nullopt;
}

/// Who names one on the command line wants that one and no other.
void requireScalar(const RenderOptions& options, const scene::World& world) {
  if (!options.scalar || scene::scalarNamed(world.channels.get(), *options.scalar) != nullptr) return;
  throw Error(fmt::format("--scalar {}: the body's file brings no such number; it brings {}", *options.scalar,
                          scene::scalarNames(world.channels.get())));
}

RenderReport render(const RenderOptions& options, const Progress& progress) {
  RenderReport result;
  result.size = sizeOf(options);
  const std::vector<std::filesystem::path> files = filesOf(options);
  const auto started = Clock::now();
  const auto world = scene::build(sceneFor(options), progress);
  requireScalar(options, *world);
  result.notes = world->notes;
  result.build_s = secondsSince(started);
  std::vector<double> times;
  const std::vector<servo::TickSamples> frames = framesFor(options, *world, times, progress);
  const auto drawing = Clock::now();
  const view::PictureSettings settings = settingsFor(options, *world, result.size);
  PictureSeries series(world, result.size);
  std::optional<FilmWriter> film;
  if (const auto ffmpeg = ffmpegFor(options, result)) {
    const view::ImageSize size{result.size.width, result.size.height};
    film.emplace(*ffmpeg, options.output, FilmFormat{size, options.frames_per_s});
    result.film = options.output.string();
  }
  const FinishesInOrder in_order;
  for (std::size_t i = 0; i < files.size() && endAskedBy() == 0; ++i) {
    report(progress, "drawing", static_cast<double>(i) / static_cast<double>(files.size()));
    const view::TakenPicture taken = series.take(frames[i], times[i], settings);
    film ? film->add(taken.image) : view::writePng(files[i], taken.image);
    result.pictures.push_back({film ? result.film : files[i].string(), times[i], frames[i]});
    if (i == 0) result.notes.insert(result.notes.end(), taken.notes.begin(), taken.notes.end());
  }
  if (result.pictures.empty()) endIfAsked();
  if (film) film->finish();
  result.draw_s = secondsSince(drawing);
  noteTheOthers(options, result);
  return result;
}

Json fingersJson(const servo::TickSamples& frame) {
  Json fingers = Json::array();
  for (const trace::Sample& sample : frame) {
    fingers.push_back({{"touching", sample.contact.touch != contact::Touch::free},
                       {"depth_mm", sample.contact.depth_mm},
                       {"force_n", sample.contact.force.norm()}});
  }
  return fingers;
}

Json jsonOf(const RenderReport& result) {
  Json pictures = Json::array();
  for (const DrawnPicture& picture : result.pictures) {
    pictures.push_back({{"file", picture.file}, {"time_s", picture.time_s}, {"fingers", fingersJson(picture.frame)}});
  }
  Json json = {
      {"width", result.size.width}, {"height", result.size.height}, {"supersampling", result.size.supersampling},
      {"build_s", result.build_s},  {"draw_s", result.draw_s},      {"complete", endAskedBy() == 0},
      {"pictures", pictures},       {"notes", result.notes}};
  if (!result.film.empty()) json["film"] = result.film;
  return json;
}

std::string summaryOf(const RenderReport& result) {
  const std::size_t count = result.pictures.size();
  std::string last = count == 1 ? "" : fmt::format(" to {}", result.pictures.back().file);
  if (!result.film.empty()) last = fmt::format(", {} pictures", count);
  std::string text = fmt::format("{}{}: {} x {}, drawn in {:.2f} s\n", result.pictures.front().file, last,
                                 result.size.width, result.size.height, result.draw_s);
  for (const std::string& note : result.notes) text += fmt::format("  note: {}\n", note);
  return text;
}

void addMomentOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--at", options.at_s, "Moment of the scene's run, s; left out (and no --pose): the body at rest");
  command.add_option("--pose", options.poses,
                     "Tip of a finger x,y,z, mm, in place of the scene's fingers; more places in one list: it moves on "
                     "from each to the next; once for each finger");
  command.add_option("--frames", options.frames, "Number of pictures")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command.add_option("--fps", options.frames_per_s, "Pictures a second of the run")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
}

template <class Value>
CLI::IsMember oneOf() {
  return CLI::IsMember(wordList<Value>());
}

void addCameraOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--view", options.side, "Side to look from")->check(oneOf<scene::StandardView>());
  command.add_option("--yaw-deg", options.yaw_deg, "Turned from that side; positive sees more of the right");
  command.add_option("--pitch-deg", options.pitch_deg, "Turned from that side; positive looks from above");
  command.add_option("--zoom", options.zoom, "1 shows the whole body")->check(CLI::Range(0.01, 1000.0));
  command.add_option("--look-at", options.look_at, "Place x,y,z in the middle of the picture, mm");
}

void addLookOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--show", options.show,
                     "Names with commas: overlays (wireframe, triangles, leaves, planes, box, ellipses, rings, arrows, "
                     "contact, normals, section) and colours (plain, strain, stiffness, ellipse-map, scalar)");
  command.add_option("--scalar", options.scalar, "Colour the skin by this number of the vertices of its PLY file");
  command.add_option("--scalar-map", options.scalar_map, "Its colours")->check(oneOf<ColourMap>());
  command
      .add_option("--scalar-range", options.scalar_range,
                  "Values of the two ends of its colours, LOW,HIGH; left out: "
                  "its least and greatest")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--shading", options.shading, "Light")->check(oneOf<scene::Shading>());
  command.add_option("--finger", options.finger, "What a finger looks like")->check(oneOf<scene::FingerShape>());
  command.add_option("--opacity", options.opacity, "Of the skin; below 1 the bones show")->check(CLI::Range(0.0, 1.0));
  command.add_flag("--white", options.white, "White background");
  command.add_flag("--texture,!--no-texture", options.texture,
                   "The body's own picture, if the scene names one, or the colours of its PLY file (default)");
  command.add_flag("--detail,!--no-detail", options.detail, "Pores (default)");
  command.add_option("--title", options.title, "Words in the upper left corner");
  command.add_flag("--labels,!--no-labels", options.labels, "Legend, scale bar, directions and numbers (default)");
}

void addStereoOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--stereo", options.stereo, "How two eyes share the picture")->check(oneOf<scene::StereoMode>());
  command.add_option("--eye-distance-mm", options.eye_distance_mm, "Between the eyes; 0 is as good as mono")
      ->check(CLI::Range(0.0, 200.0));
  command
      .add_option("--convergence-mm", options.convergence_mm,
                  "From the eyes to what appears in the plane of the screen; 0 is the middle of the picture")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--swap-eyes", options.swap_eyes, "The other way round");
  command.add_option("--head-mm", options.head, "Head x,y,z before a real screen, mm from its middle");
  command.add_option("--screen-height-mm", options.screen_height_mm, "Height of that screen")
      ->check(CLI::PositiveNumber);
}

void addOutputOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "PNG file; a sequence gets numbers before .png. With --frames also .mp4 or .webm, if ffmpeg is "
                  "installed; otherwise numbered PNG files and exit code 1")
      ->capture_default_str();
  command.add_option("--size", options.size, "WIDTHxHEIGHT, pixels")->capture_default_str();
  command.add_option("--supersampling", options.supersampling, "Each pixel is the mean of this many squared")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command.add_flag("--json", options.json, "Print a report as JSON");
}

}  // namespace

void addRenderCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Draw pictures of a scene without a window");
  const auto options = std::make_shared<RenderOptions>();
  addInputOptions(*command, options->scene);
  addMomentOptions(*command, *options);
  addCameraOptions(*command, *options);
  addLookOptions(*command, *options);
  addStereoOptions(*command, *options);
  addOutputOptions(*command, *options);
  command->callback([=] {
    options->scene.radius_given = command->count("--radius-mm") > 0;
    ProgressLine progress;
    const RenderReport result = render(*options, progress.display());
    progress.clear();
    fmt::print("{}", options->json ? jsonOf(result).dump(2) + "\n" : summaryOf(result));
    if (result.film_missed) throw CLI::RuntimeError(1);
  });
}

}  // namespace palpate::app
