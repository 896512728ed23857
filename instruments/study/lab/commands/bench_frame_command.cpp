// `palpate study bench frame`: how long a picture takes, from the contact to the last pixel.
#include <fmt/format.h>

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
#include "palpate/base/json.h"
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

// Times whole pictures of a back under a finger that wanders: the numbers of `palpate study bench frame`.

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

/// Milliseconds a picture: mean over the finger's places, of each place's shortest time.
struct FrameFigures {
  std::size_t triangles = 0;       ///< on the skin
  std::size_t bone_triangles = 0;  ///< beneath it
  std::string renderer;            ///< OpenGL's own name
  double deform_ms = 0.0;
  double upload_ms = 0.0;
  double draw_ms = 0.0;  ///< until the last pixel is there, labels and stereo included
  double frameMs() const { return deform_ms + upload_ms + draw_ms; }
  double fps = 0.0;                ///< 1000 / frame_ms: each step waits for the one before
  double covered = 0.0;            ///< share of the window that the skin takes
  double uploaded_vertices = 0.0;  ///< a picture
  double first_frame_ms = 0.0;     ///< from nothing but the world to the first picture in memory
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

/// Throws Error where nothing can be drawn, and for counts the body cannot have.
FrameFigures measureFrames(const FrameRun& run) {
  const auto world = buildBackWorld(run);
  const std::vector<view::FingerMark> marks = wanderingFinger(*world);
  const auto start = Clock::now();
  const view::OffscreenContext context;
  Bench bench(run, world);
  bench.frame(marks.front(), 0);
  (void)bench.target().read();
  FrameFigures figures;
  figures.first_frame_ms = millisecondsSince(start);
  const auto end = Clock::now() + std::chrono::duration<double>(run.seconds);
  do {
    for (std::size_t place = 0; place < marks.size(); ++place) bench.frame(marks[place], place);
  } while (Clock::now() < end);
  figures.triangles = world->body->skin.triangles.size();
  for (const body::Bone& bone : world->body->anatomy.bones) figures.bone_triangles += bone.mesh.triangles.size();
  figures.renderer = view::rendererString();
  figures.deform_ms = bench.mean(0);
  figures.upload_ms = bench.mean(1);
  figures.draw_ms = bench.mean(2);
  figures.fps = 1000.0 / figures.frameMs();
  figures.uploaded_vertices = bench.uploadedVertices();
  figures.covered = bench.covered(marks.back());
  return figures;
}

Json toJson(const FrameFigures& f) {
  Json json;
  json["triangles"] = f.triangles;
  json["bone_triangles"] = f.bone_triangles;
  json["renderer"] = f.renderer;
  json["deform_ms"] = f.deform_ms;
  json["upload_ms"] = f.upload_ms;
  json["draw_ms"] = f.draw_ms;
  json["frame_ms"] = f.frameMs();
  json["fps"] = f.fps;
  json["uploaded_vertices"] = f.uploaded_vertices;
  json["covered"] = f.covered;
  json["first_frame_ms"] = f.first_frame_ms;
  return json;
}

std::string textOf(const FrameFigures& f) {
  std::string text = fmt::format("triangles      {} of the skin, {} of bones\n", f.triangles, f.bone_triangles);
  text += fmt::format("drawn by       {}\n", f.renderer);
  text += fmt::format("deform         {:.3f} ms\n", f.deform_ms);
  text += fmt::format("upload         {:.3f} ms, {:.0f} vertices\n", f.upload_ms, f.uploaded_vertices);
  text += fmt::format("draw           {:.2f} ms, skin on {:.0f} % of the picture\n", f.draw_ms, 100.0 * f.covered);
  text += fmt::format("pictures       {:.1f} a second\n", f.fps);
  return text + fmt::format("first picture  {:.0f} ms after the world was built\n", f.first_frame_ms);
}

}  // namespace

void addBenchFrameCommand(Command& parent) {
  struct Arguments {
    FrameRun run;
    std::string stereo{wordFor(view::StereoMode::mono)};
    bool no_labels = false;
    bool peers = false;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  FrameRun& run = arguments->run;
  Command& command = *parent.add_subcommand("frame", "Time pictures without a window: deformation, upload and drawing");
  addSetting(command, "--triangles", run.triangles, between(1000, 4e6),
             "Triangles of the skin; 18,296 of bones are added");
  command.add_flag("--trunk", run.trunk, "Draw the closed trunk (an even number of triangles) instead of the torso");
  Choices<view::Shading> shadings = makeChoices<view::Shading>();
  shadings.insert(shadings.begin(), {"pbr", view::Shading::skin});
  addChoice(command, "--shading", run.shading, shadings,
            "Shading: light at the vertices, or skin (pbr: its earlier name)");
  command.add_option("--stereo", arguments->stereo, "Stereo mode: mono, sbs-half, sbs-full, anaglyph-dubois, ...")
      ->capture_default_str();
  addSetting(command, "--width", run.width, between(16, 8192, "pixels"), "Width of the picture");
  addSetting(command, "--height", run.height, between(16, 8192, "pixels"), "Height of the picture");
  addSetting(command, "--skin-opacity", run.skin_opacity, between(0.0, 1.0),
             "Opacity of the skin; below 1 the bones show through");
  addSetting(command, "--seconds", run.seconds, between(0.0, 600.0, "s"),
             "Duration of the repetitions; the best picture of each place counts");
  command.add_flag("--close", run.close, "Draw from nearby: 100 mm of the body from the lower to the upper edge");
  command.add_flag("--cull,!--no-cull", run.cull, "Leave out skin that is outside the picture (default)");
  command.add_flag("--no-labels", arguments->no_labels, "Draw no scale, orientation or numbers");
  command.add_flag("--peers", arguments->peers,
                   "Accepted as in the other benchmarks; no other library draws this picture");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] {
    arguments->run.stereo = view::stereoModeNamed(arguments->stereo);
    arguments->run.labels = !arguments->no_labels;
    const FrameFigures figures = measureFrames(arguments->run);
    Json json = toJson(figures);
    std::string text = textOf(figures);
    if (arguments->peers) {
      json["peers"] = Json::object();
      text += "peers          none: no other library draws this picture\n";
    }
    printReport(json, text, arguments->json);
  });
}

}  // namespace palpate::app
