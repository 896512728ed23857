// `palpate render`: pictures of a scene without a window or a display.
//
//   scene ─ build ─► world ─ run to the moment ─► fingers ─ deform ─► surface ─► Studio ─► PNG, one or a sequence; a
//   recording ───────► world ─ recorded ──────────►                                          film
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "cli/kit/body_place.h"
#include "cli/kit/choice_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "cli/render/film.h"
#include "cli/render/moments.h"
#include "cli/render/picture_series.h"
#include "cli/render/render_options.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/view/overlays/muscle_marks.h"
#include "palpate/view/scene_view.h"

namespace palpate::app {

namespace {

constexpr const char* kPose = "--pose";
constexpr const char* kSize = "--size";
constexpr double kLargestSide = 16384.0;

/// One picture: its file, the moment and the fingers in it.
struct DrawnPicture {
  std::string file;
  double time_s = 0.0;
  servo::TickSamples frame;
};

struct RenderReport {
  std::vector<DrawnPicture> pictures;
  std::string film;  ///< the film's file; empty: the pictures are files of their own
  std::vector<std::string> notes;
  view::PictureSize size;
  double build_s = 0.0;
  double draw_s = 0.0;
};

/// Without a moment or a pose: the body at rest, alone.
bool isAtRest(const RenderOptions& options) { return !options.at_s && options.poses.empty() && options.frames == 1; }

scene::Scene sceneFor(const RenderOptions& options) {
  SimulateOptions input = options.scene;
  input.needs_fingers = !isAtRest(options) && options.poses.empty();
  scene::Scene scene = sceneFor(input);
  if (!options.poses.empty()) useFingersAt(options.poses.size(), options.scene.radius_mm, scene);
  scene.view = applyViewOptions(options, scene.view);
  return scene;
}

/// The moments to draw; a lone pose is drawn when its finger has arrived.
std::vector<double> choosePictureTimes(const RenderOptions& options, const scene::World& world,
                                       const device::FingerPaths& paths) {
  const double end_s = static_cast<double>(paths.ticks - 1) / world.scene.ticks_per_s;
  const double sequence_s = (options.frames - 1) / options.frames_per_s;
  const double first = options.at_s.value_or(options.poses.empty() ? 0.0 : std::max(0.0, end_s - sequence_s));
  std::vector<double> times;
  for (int i = 0; i < options.frames; ++i) times.push_back(first + i / options.frames_per_s);
  return times;
}

std::vector<Pose> posesOn(const RenderOptions& options, const scene::World& world) {
  std::vector<Pose> poses;
  for (const std::vector<BodyPlace>& asked : options.poses) {
    Pose& pose = poses.emplace_back();
    for (const BodyPlace& place : asked) pose.push_back(tipOn(world, place));
  }
  return poses;
}

std::vector<servo::TickSamples> framesFor(const RenderOptions& options, const scene::World& world,
                                          std::vector<double>& times, const Progress& progress) {
  if (isAtRest(options)) {
    times = {0.0};
    return {servo::TickSamples{}};
  }
  const device::FingerPaths paths =
      options.poses.empty() ? device::pathsOf(world) : pathsToPoses(world, posesOn(options, world));
  times = choosePictureTimes(options, world, paths);
  return framesAt(world, paths, times, progress);
}

/// The source of the pictures: a scene that is run now, or a recording.
struct Input {
  std::vector<double> times;
  std::vector<servo::TickSamples> frames;
  std::function<std::shared_ptr<const scene::World>(const servo::TickSamples& frame)> world_of;
  std::function<std::string()> note;  ///< about the last world
};

Input inputOfScene(const RenderOptions& options, const Progress& progress) {
  const std::shared_ptr<const scene::World> world = scene::build(sceneFor(options), progress);
  Input input;
  input.frames = framesFor(options, *world, input.times, progress);
  input.world_of = [world](const servo::TickSamples&) { return world; };
  input.note = [] { return std::string(); };
  return input;
}

Input inputOfRecording(const RenderOptions& options, const Progress& progress) {
  const auto recorded = std::make_shared<RecordedInput>(options);
  Input input{{0.0}, {servo::TickSamples{}}, {}, [recorded] { return recorded->note(); }};
  if (!isAtRest(options)) {
    const double first = options.at_s.value_or(recorded->beginS());
    input.times.clear();
    for (int i = 0; i < options.frames; ++i) input.times.push_back(first + i / options.frames_per_s);
    input.frames = recorded->framesAt(input.times);
  }
  input.world_of = [recorded, progress](const servo::TickSamples& frame) {
    return recorded->worldForFrame(frame, progress);
  };
  return input;
}

view::PictureSettings settingsFor(const RenderOptions& options, const scene::World& world,
                                  const view::PictureSize& size) {
  const auto mode = world.scene.view.stereo;
  const double aspect = view::eyePictureIn(mode, size.width, size.height).aspect();
  view::PictureSettings settings = view::pictureSettings(world, aspect);
  if (options.look_at) settings.camera.centre = pointOn(world, *options.look_at);
  settings.labels.title = options.title;
  settings.labels.finger_names = fingerNames(world);
  if (!options.labels) settings.labels = view::LabelSettings::none();
  return settings;
}

/// Pictures of an earlier, longer series would be taken for parts of this one; a signal leaves some out.
void noteTheOthers(const RenderOptions& options, RenderReport& result) {
  const auto count = static_cast<int>(result.pictures.size());
  if (count < options.frames) {
    result.notes.push_back(
        fmt::format("ended by {} after {} of {} pictures", nameOfSignal(endingSignal()), count, options.frames));
  }
  const std::filesystem::path next = fileOfSeries(options, count + 1);
  if (result.film.empty() && options.frames > 1 && std::filesystem::exists(next)) {
    result.notes.push_back(fmt::format("{} and later files belong to an earlier series", next.string()));
  }
}

/// A number named on the command line must exist.
void requireScalar(const RenderOptions& options, const scene::World& world) {
  if (!options.scalar || scene::scalarNamed(world.body->channels.get(), *options.scalar) != nullptr) return;
  throw Error(fmt::format("--scalar {}: no such number in the mesh file; it has {}", *options.scalar,
                          scene::scalarNames(world.body->channels.get())));
}

void requireMuscles(const RenderOptions& options, const scene::World& world) {
  if (options.muscles && !view::hasMuscles(world.body->anatomy.landmarks)) {
    throw Error(fmt::format("--muscles: {}; the built-in trunk has them", view::kNoMuscles));
  }
}

RenderReport render(const RenderOptions& options, const Progress& progress) {
  RenderReport result;
  result.size = options.size;
  const std::vector<std::filesystem::path> files = pictureFiles(options);
  const auto started = Clock::now();
  const bool is_recorded = isRecordingFile(pathOf(options.scene.scene));
  std::optional<FinishesInOrder> in_order;
  if (is_recorded) in_order.emplace();  // the recording's files are in a folder that must be removed again
  const Input input =
      is_recorded ? inputOfRecording(options, interruptible(progress)) : inputOfScene(options, progress);
  std::shared_ptr<const scene::World> world = input.world_of(input.frames.front());
  requireScalar(options, *world);
  requireMuscles(options, *world);
  result.notes = world->notes;
  if (!input.note().empty()) result.notes.push_back(input.note());
  result.build_s = secondsSince(started);
  const auto drawing = Clock::now();
  view::PictureSettings settings = settingsFor(options, *world, result.size);
  auto series = std::make_unique<PictureSeries>(world, result.size);
  std::optional<FilmWriter> film;
  if (isFilm(options.output)) {
    film.emplace(options.output, filmFormat(options));
    result.film = options.output.string();
  }
  if (!in_order) in_order.emplace();
  for (std::size_t i = 0; i < files.size() && endingSignal() == 0; ++i) {
    report(progress, "drawing", static_cast<double>(i) / static_cast<double>(files.size()));
    const servo::TickSamples& frame = input.frames.at(i);
    if (input.world_of(frame) != world) {  // a recording may continue in another one
      world = input.world_of(frame);
      settings = settingsFor(options, *world, result.size);
      series = std::make_unique<PictureSeries>(world, result.size);
    }
    const view::TakenPicture taken = series->capture(frame, input.times[i], settings);
    film ? film->add(taken.image, input.times[i]) : view::writePng(files[i], taken.image);
    result.pictures.push_back({film ? result.film : files[i].string(), input.times[i], frame});
    if (i == 0) result.notes.insert(result.notes.end(), taken.notes.begin(), taken.notes.end());
  }
  if (result.pictures.empty()) throwIfInterrupted();
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

Json toJson(const RenderReport& result) {
  Json pictures = Json::array();
  for (const DrawnPicture& picture : result.pictures) {
    pictures.push_back({{"file", picture.file}, {"time_s", picture.time_s}, {"fingers", fingersJson(picture.frame)}});
  }
  Json json = {
      {"width", result.size.width}, {"height", result.size.height}, {"supersampling", result.size.supersampling},
      {"build_s", result.build_s},  {"draw_s", result.draw_s},      {"complete", endingSignal() == 0},
      {"pictures", pictures},       {"notes", result.notes}};
  if (!result.film.empty()) json["film"] = result.film;
  return json;
}

std::string formatSummary(const RenderReport& result) {
  const std::size_t count = result.pictures.size();
  std::string last = count == 1 ? "" : fmt::format(" to {}", result.pictures.back().file);
  if (!result.film.empty()) last = fmt::format(", {} pictures", count);
  std::string text = fmt::format("{}{}: {} x {}, drawn in {:.2f} s\n", result.pictures.front().file, last,
                                 result.size.width, result.size.height, result.draw_s);
  for (const std::string& note : result.notes) text += fmt::format("  note: {}\n", note);
  return text;
}

std::vector<BodyPlace> pointsFrom(const std::string& words) {
  const std::vector<double> numbers = numbersFrom(kPose, words, between(-kFarthestMm, kFarthestMm, "mm"));
  if (numbers.size() % 3 != 0) throw UsageError(kPose, "expected x,y,z, or several of them");
  std::vector<BodyPlace> places;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    places.push_back({kPose, {}, Vec3(numbers[i], numbers[i + 1], numbers[i + 2])});
  }
  return places;
}

/// x,y,z once or more, or named places with semicolons between them.
std::vector<BodyPlace> placesFrom(const std::string& words) {
  if (meansNumbers(words)) return pointsFrom(words);
  std::vector<BodyPlace> places;
  for (const std::string_view word : split(words, ';')) places.push_back(bodyPlaceFrom(kPose, std::string(word)));
  return places;
}

void addPoses(Command& command, RenderOptions& options) {
  const auto read = [&options](const std::vector<std::string>& words) {
    for (const std::string& pose : words) options.poses.push_back(placesFrom(pose));
  };
  command
      .add_option_function(
          kPose, read,
          "Fingertip x,y,z (mm), in place of the scene's fingers; several places in one list are a path; repeat for "
          "each finger. Or named places, with semicolons, 6 mm under the skin: \"T6; T6 right 30 mm\"")
      ->type_name(std::string(kPlaceType) + "[,X,Y,Z]|PLACE");
}

void addMomentOptions(Command& command, RenderOptions& options) {
  addNumber(command, "--at", options.at_s, between(0.0, kLongestRunS, "s"),
            "Time in the scene's run (default, without --pose: the body at rest)");
  addPoses(command, options);
  addSetting(command, "--frames", options.frames, between(1, 9999), "Number of pictures");
  addSetting(command, "--fps", options.frames_per_s, between(0.1, 1000.0), "Pictures per second of the run");
}

/// Accepts names of earlier versions, too, but does not list them.
template <class Value>
Option* takesWord(Option* option) {
  const std::vector<std::string> names = wordList<Value>();
  const auto fault = [names](const std::string& wanted) {
    return valueNamed<Value>(wanted) ? std::string() : faultOfChoice(wanted, names);
  };
  return option->check(fault)->type_name(fmt::format("{}", fmt::join(names, "|")));
}

void addCameraOptions(Command& command, RenderOptions& options) {
  takesWord<scene::StandardView>(command.add_option("--view", options.side, "Side to look from"));
  addNumber(command, "--yaw-deg", options.yaw_deg, between(-180.0, 180.0),
            "Rotation from that side; positive shows more of the right");
  addNumber(command, "--pitch-deg", options.pitch_deg, between(-89.0, 89.0),
            "Elevation from that side; positive looks from above");
  addNumber(command, "--zoom", options.zoom, between(0.01, 1000.0), "Zoom factor; 1 shows the whole body");
  addBodyPlace(command, "--look-at", options.look_at,
               "Place in the middle of the picture (mm), or its name: \"T6 right 30 mm\" (docs/reference/names.md)");
}

void addLookOptions(Command& command, RenderOptions& options) {
  command.add_option("--show", options.show,
                     "Comma-separated names: overlays (wireframe, triangles, leaves, planes, box, ellipses, rings, "
                     "arrows, contact, normals, section, names, pressure, lumps, cut, muscles) and colours (plain, "
                     "strain, stiffness, ellipse-map, scalar)");
  command.add_option("--scalar", options.scalar, "Colour the skin by this vertex value of its PLY file");
  takesWord<ColourMap>(command.add_option("--scalar-map", options.scalar_map, "Colour map of that value"));
  addNumber(command, "--scalar-range", options.scalar_range, between(-1e9, 1e9),
            "Values at the ends of the colour map, LOW,HIGH (default: minimum and maximum)")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  takesWord<scene::Shading>(command.add_option("--shading", options.shading, "Shading of the skin"));
  takesWord<scene::FingerShape>(command.add_option("--finger", options.finger, "Shape of the fingers; auto is finger"));
  addNumber(command, "--opacity", options.opacity, between(0.0, 1.0),
            "Opacity of the skin; below 1 the bones show through");
  addNumber(command, "--skin-tone", options.skin_tone, between(1.0, 6.0),
            "Tone of the skin, from very light to very dark");
  addNumber(command, "--dent-contrast", options.dent_contrast, between(0.0, 5.0),
            "Shading of dents; 1 is natural, with contours at 0.5, 2.5, 4.5 ... mm on a dent that is small in the "
            "picture; above 1 exaggerates; 0 omits shading and contours");
  command.add_flag("--lens", options.lens, "Draw a close-up from beside the finger in the lower left corner");
  command.add_flag("--muscles", options.muscles,
                   "Draw trapezius, latissimus dorsi and erector spinae on the skin, with their names");
  command.add_flag("--white", options.white, "White background");
  command.add_flag_function(
      "--texture,!--no-texture", [&options](std::int64_t times) { options.texture = times > 0; },
      "Draw the body's texture, if the scene names one, or the colours of its PLY file (default: from the scene)");
  command.add_flag("--detail,!--no-detail", options.detail, "Draw skin lines in close views (default)");
  command.add_option("--title", options.title, "Text in the upper left corner");
  command.add_flag("--labels,!--no-labels", options.labels, "Draw legend, scale bar, directions and numbers (default)");
}

void addStereoOptions(Command& command, RenderOptions& options) {
  takesWord<scene::StereoMode>(
      command.add_option("--stereo", options.stereo, "Stereo mode: how the picture holds the views of both eyes"));
  addNumber(command, "--eye-distance-mm", options.eye_distance_mm, between(0.0, 200.0, "mm"),
            "Distance between the eyes; 0 is the same as mono");
  addNumber(command, "--convergence-mm", options.convergence_mm, between(0.0, kFarthestMm, "mm"),
            "Distance from the eyes to the plane of the screen; 0 is the distance of the picture's middle");
  command.add_flag("--swap-eyes", options.swap_eyes, "Swap the views of the eyes");
  addPlace(command, "--head-mm", options.head_mm,
           "Position of the head in front of a real screen (mm from its middle)");
  addNumber(command, "--screen-height-mm", options.screen_height_mm, above(0.0, kFarthestMm, "mm"),
            "Height of that screen");
}

void addSize(Command& command, view::PictureSize& size) {
  const auto read = [&size](const std::string& words) {
    const auto sides = split(words, 'x');
    if (sides.size() != 2) throw UsageError(kSize, "must be WIDTHxHEIGHT in pixels, e.g. 1280x720");
    const Limits limits = between(1, kLargestSide, "pixels");
    size.width = static_cast<int>(countFrom(kSize, std::string(sides[0]), limits));
    size.height = static_cast<int>(countFrom(kSize, std::string(sides[1]), limits));
  };
  command.add_option_function(kSize, read, "Size of the picture" + rangeText(between(1, kLargestSide, "pixels each")))
      ->type_name("WIDTHxHEIGHT")
      ->default_str(fmt::format("{}x{}", size.width, size.height));
}

void addOutputOptions(Command& command, RenderOptions& options) {
  namesFileToWrite(command.add_option("-o,--out", options.output,
                                      "PNG file, numbered for a sequence; with --frames also a film: .webm or .gif, or "
                                      ".mp4 if ffmpeg is installed"))
      ->capture_default_str();
  addSize(command, options.size);
  addSetting(command, "--supersampling", options.size.supersampling, between(1, 4),
             "Average each pixel over this number of samples squared");
  command.add_flag("--json", options.json, "Print a report as JSON");
}

}  // namespace

void drawPictures(const RenderOptions& options, bool prints_summary) {
  ProgressLine progress;
  const RenderReport result = render(options, progress.display());
  progress.clear();
  if (prints_summary) fmt::print("{}", options.json ? jsonDump(toJson(result), 2) + "\n" : formatSummary(result));
}

void addRenderCommand(Command& app) {
  Command* command = app.add_subcommand("render", "Draw pictures of a scene or of a recording without a window");
  command->group("Touch");
  const auto options = std::make_shared<RenderOptions>();
  addInputOptions(*command, options->scene);
  addShapeOptions(*command, options->scene);
  addSecondsOption(*command, options->scene);
  addMomentOptions(*command, *options);
  addCameraOptions(*command, *options);
  addLookOptions(*command, *options);
  addStereoOptions(*command, *options);
  addOutputOptions(*command, *options);
  command->callback([=] {
    options->scene.radius_given = command->count("--radius-mm") > 0;
    drawPictures(*options);
  });
}

}  // namespace palpate::app
