#include "lab/commands/frame_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "lab/runs/deform_run.h"
#include "palpate/base/stopwatch.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/living_skin.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/offscreen.h"
#include "palpate/view/painter.h"

namespace palpate::app {

namespace {

using bench::kPlaces;

constexpr double kDepthMm = 8.0;
/// How much of the body a near camera sees, from the lower to the upper edge.
constexpr double kCloseMm = 100.0;
/// As many bone triangles as the torso of 41,582 triangles has.
constexpr std::size_t kBoneTriangles = 18296;

std::shared_ptr<const scene::World> backOf(const FrameRun& run) {
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

}  // namespace

FrameFigures measureFrames(const FrameRun& run) {
  const auto world = backOf(run);
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
  figures.renderer = view::rendererWords();
  figures.deform_ms = bench.mean(0);
  figures.upload_ms = bench.mean(1);
  figures.draw_ms = bench.mean(2);
  figures.fps = 1000.0 / figures.frameMs();
  figures.uploaded_vertices = bench.uploadedVertices();
  figures.covered = bench.covered(marks.back());
  return figures;
}

}  // namespace palpate::app
