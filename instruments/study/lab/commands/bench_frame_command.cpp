// `palpate study bench frame`: how long a picture takes, from the contact to the last pixel.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/deform_run.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/words.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/living_skin.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/look.h"
#include "palpate/view/offscreen.h"
#include "palpate/view/painter.h"
#include "palpate/view/stereo.h"

namespace palpate::app {
namespace {

/// Whole pictures of a back under a finger that wanders.
struct FrameRun {
  std::size_t triangles = 41582;  ///< on the skin; the bones come on top
  bool trunk = false;             ///< the closed built-in body, on which opaque skin hides the bones; else the torso
  view::Shading shading = view::Shading::gouraud;
  view::StereoMode stereo = view::StereoMode::mono;
  int width = 1280;
  int height = 720;
  double skin_opacity = 1.0;
  bool labels = true;
  bool close = false;    ///< the camera is near the finger, so that most of the skin is outside the picture
  bool cull = true;      ///< false: skin outside the picture is drawn too
  double seconds = 2.0;  ///< time for repetitions
};

using bench::kPlaces;

constexpr double kDepthMm = 8.0;
/// Height of the body in a near camera's picture.
constexpr double kCloseMm = 100.0;
/// Bone triangles of the torso of 41,582 triangles.
constexpr std::size_t kBoneTriangles = 18296;

std::shared_ptr<const scene::World> buildBackWorld(const FrameRun& run) {
  scene::Scene scene;
  scene.body.kind = run.trunk ? scene::BodyKind::trunk : scene::BodyKind::torso;
  scene.body.triangles = run.triangles + kBoneTriangles;
  scene.body.bone_triangles = kBoneTriangles;
  return scene::build(scene);
}

/// A point finger pressed straight down at a place of the back.
view::FingerMark fingerAt(const scene::World& world, const Vec2& place) {
  constexpr double kAbove = 500.0;
  const Vec3 above(place.x(), place.y(), kAbove), below(place.x(), place.y(), -kAbove);
  const auto skin = tree::firstFrontCrossing(world.surface.geometry->tree, above, below).point;
  contact::FingerState state;
  view::FingerMark mark;
  for (double height = 2.0; height >= -kDepthMm; height -= 0.1) {
    mark.contact = contact::step(world.surface, {}, state, skin + height * Vec3::UnitZ());
  }
  return mark;
}

std::vector<view::FingerMark> wanderingFinger(const scene::World& world) {
  const Vec2 beside_t6(30.0, 38.0);
  std::vector<view::FingerMark> marks;
  for (const Vec2& place : bench::placesAround(beside_t6)) marks.push_back(fingerAt(world, place));
  return marks;
}

/// The whole chain from a contact to a picture, and its shortest times at each place.
class Bench {
 public:
  Bench(const FrameRun& run, std::shared_ptr<const scene::World> world)
      : world_(std::move(world)), target_(run.width, run.height), painter_(world_), skin_(*world_, {.strain = false}) {
    const double aspect = static_cast<double>(run.width) / run.height;
    settings_.camera = view::fitted(mesh::boundingBox(world_->body->skin), aspect);
    if (run.close) goNear(wanderingFinger(*world_).front());
    settings_.look.shading = run.shading;
    settings_.look.cull = run.cull;
    settings_.look.skin_opacity = run.skin_opacity;
    settings_.stereo.mode = run.stereo;
    if (!run.labels) settings_.labels = view::LabelSettings::none();
    canvas_.framebuffer = target_.framebuffer();
    canvas_.width = run.width;
    canvas_.height = run.height;
    for (auto& times : best_) times.fill(1e300);
  }

  void frame(const view::FingerMark& mark, std::size_t place) {
    const auto start = Clock::now();
    skin_.follow({&mark.contact, 1});
    note(0, place, start);
    const auto upload = Clock::now();
    uploaded_ += painter_.renderer().update(skin_.surface());
    note(1, place, upload);
    const auto draw = Clock::now();
    painter_.paint({{&mark, 1}, 0.0}, skin_.surface(), settings_, canvas_);
    view::waitUntilDrawn();
    note(2, place, draw);
    ++frames_;
  }

  double mean(int step) const {
    double sum = 0.0;
    for (const double time : best_[step]) sum += time;
    return sum / kPlaces;
  }
  double uploadedVertices() const { return static_cast<double>(uploaded_) / frames_; }
  const view::Target& target() const { return target_; }

  /// Pixels of the picture that differ from the one without skin.
  double covered(const view::FingerMark& mark) {
    const view::Image with = target_.read();
    view::PictureSettings bare = settings_;
    bare.look.skin_opacity = 0.0;
    painter_.paint({{&mark, 1}, 0.0}, skin_.surface(), bare, canvas_);
    const view::Image without = target_.read();
    std::size_t different = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) different += with.pixels[i] != without.pixels[i] ? 1 : 0;
    return static_cast<double>(different) / static_cast<double>(with.pixels.size());
  }

 private:
  void goNear(const view::FingerMark& mark) {
    settings_.camera.centre = mark.contact.proxy;
    settings_.camera.distance_mm = 0.5 * kCloseMm / std::tan(0.5 * settings_.camera.height_rad);
  }

  void note(int step, std::size_t place, Clock::time_point start) {
    best_[step][place] = std::min(best_[step][place], millisecondsSince(start));
  }

  std::shared_ptr<const scene::World> world_;
  view::Target target_;
  view::Painter painter_;
  engine::LivingSkin skin_;
  view::PictureSettings settings_;
  view::Canvas canvas_;
  std::array<std::array<double, kPlaces>, 3> best_{};
  std::size_t uploaded_ = 0;
  std::size_t frames_ = 0;
};

struct FrameArguments {
  FrameRun run;
  std::string stereo{wordFor(view::StereoMode::mono)};
  bool no_labels = false;
  bool peers = false;
};

/// Milliseconds a picture: mean over the finger's places, of each place's shortest time. Throws Error where nothing can
/// be drawn, and for counts the body cannot have.
Json measureFrames(const FrameArguments& arguments, ProgressLine&) {
  FrameRun run = arguments.run;
  run.stereo = view::stereoModeNamed(arguments.stereo);
  run.labels = !arguments.no_labels;
  const auto world = buildBackWorld(run);
  const std::vector<view::FingerMark> marks = wanderingFinger(*world);
  const auto start = Clock::now();
  const view::OffscreenContext context;
  Bench bench(run, world);
  bench.frame(marks.front(), 0);
  (void)bench.target().read();
  const double first_frame_ms = millisecondsSince(start);  // from nothing but the world to the first picture in memory
  const auto end = Clock::now() + std::chrono::duration<double>(run.seconds);
  do {
    for (std::size_t place = 0; place < marks.size(); ++place) bench.frame(marks[place], place);
  } while (Clock::now() < end);
  std::size_t bone_triangles = 0;
  for (const body::Bone& bone : world->body->anatomy.bones) bone_triangles += bone.mesh.triangles.size();
  const double frame_ms = bench.mean(0) + bench.mean(1) + bench.mean(2);
  Json json;
  json["triangles"] = world->body->skin.triangles.size();  // of the skin
  json["bone_triangles"] = bone_triangles;
  json["renderer"] = view::rendererString();
  json["deform_ms"] = bench.mean(0);
  json["upload_ms"] = bench.mean(1);
  json["draw_ms"] = bench.mean(2);  // until the last pixel is there, labels and stereo included
  json["frame_ms"] = frame_ms;
  json["fps"] = 1000.0 / frame_ms;  // each step waits for the one before
  json["uploaded_vertices"] = bench.uploadedVertices();
  json["covered"] = bench.covered(marks.back());  // share of the window that the skin takes
  json["first_frame_ms"] = first_frame_ms;
  if (arguments.peers) json["peers"] = Json::object();
  return json;
}

void addFrameOptions(Command& command, FrameArguments& arguments) {
  FrameRun& run = arguments.run;
  addSetting(command, "--triangles", run.triangles, between(1000, 4e6),
             "Triangles of the skin; 18,296 of bones are added");
  command.add_flag("--trunk", run.trunk, "Draw the closed trunk (an even number of triangles) instead of the torso");
  Choices<view::Shading> shadings = makeChoices<view::Shading>();
  shadings.insert(shadings.begin(), {"pbr", view::Shading::skin});
  addChoice(command, "--shading", run.shading, shadings,
            "Shading: light at the vertices, or skin (pbr: its earlier name)");
  command.add_option("--stereo", arguments.stereo, "Stereo mode: mono, sbs-half, sbs-full, anaglyph-dubois, ...")
      ->capture_default_str();
  addSetting(command, "--width", run.width, between(16, 8192, "pixels"), "Width of the picture");
  addSetting(command, "--height", run.height, between(16, 8192, "pixels"), "Height of the picture");
  addSetting(command, "--skin-opacity", run.skin_opacity, between(0.0, 1.0),
             "Opacity of the skin; below 1 the bones show through");
  addSetting(command, "--seconds", run.seconds, between(0.0, 600.0, "s"),
             "Duration of the repetitions; the best picture of each place counts");
  command.add_flag("--close", run.close, "Draw from nearby: 100 mm of the body from the lower to the upper edge");
  command.add_flag("--cull,!--no-cull", run.cull, "Leave out skin that is outside the picture (default)");
  command.add_flag("--no-labels", arguments.no_labels, "Draw no scale, orientation or numbers");
  command.add_flag("--peers", arguments.peers,
                   "Accepted as in the other benchmarks; no other library draws this picture");
}

}  // namespace

void addBenchFrameCommand(Command& parent) {
  addBench(parent, "frame", "Time pictures without a window: deformation, upload and drawing", addFrameOptions,
           measureFrames);
}

}  // namespace palpate::app
