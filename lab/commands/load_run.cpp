#include "lab/commands/load_run.h"

#include <sys/resource.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/contact/finger.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::app {

namespace {

/// Reads the clock whenever the progress names another stage.
class StageClock {
 public:
  explicit StageClock(const Progress& shown) : shown_(shown) {}

  Progress callback() {
    return [this](std::string_view stage, double done) {
      if (current_ != stage) begin(stage);
      report(shown_, stage, done);
    };
  }
  void begin(std::string_view stage) {
    end();
    current_ = stage;
    started_ = Clock::now();
  }
  std::vector<LoadStep> finish() {
    end();
    return std::move(steps_);
  }

 private:
  void end() {
    if (current_.empty()) return;
    LoadStep& step = stepNamed(current_);
    step.seconds += secondsSince(started_);
    step.peak_memory_gb = peakMemoryGb();
  }
  LoadStep& stepNamed(const std::string& name) {
    const auto found =
        std::find_if(steps_.begin(), steps_.end(), [&](const LoadStep& step) { return step.name == name; });
    if (found != steps_.end()) return *found;
    return steps_.emplace_back(LoadStep{name});
  }

  const Progress& shown_;
  std::string current_;
  Clock::time_point started_;
  std::vector<LoadStep> steps_;
};

/// Presses at some triangles in turn until one pushes back: a thin place or a pocket may not.
contact::FingerOutput firstForce(const scene::World& world) {
  constexpr std::size_t kMostPlaces = 64;
  const double depth = 1e-3 * world.surface.geometry->tree.diagonal;  // 0.5 mm on a back
  const auto& records = world.surface.geometry->tree.records;
  for (std::size_t place = 0; place < kMostPlaces; ++place) {
    const auto& [a, b, c] = records[place * records.size() / kMostPlaces].corners;
    const Vec3 middle = (a + b + c) / 3.0;
    const Vec3 inwards = -mesh::areaVector2(a, b, c).stableNormalized() * depth;
    contact::FingerState state;
    (void)contact::step(world.surface, {}, state, middle - inwards);
    contact::FingerOutput output = contact::step(world.surface, {}, state, middle + inwards);
    if (output.force.squaredNorm() > 0.0) return output;
  }
  throw Error("the body gives no force anywhere");
}

std::uint64_t hashOf(const scene::World& world, const contact::FingerOutput& output) {
  Hash hash;
  for (const Vec3& position : world.body->skin.positions) hash.add(position);
  for (const Triangle& triangle : world.body->skin.triangles) {
    for (const Index vertex : triangle) hash.add(std::uint64_t{vertex});
  }
  hash.add(output.force);
  hash.add(output.proxy);
  return hash.value();
}

void measureTree(const mesh::TriangleMesh& skin, LoadFigures& figures) {
  const auto triangles = static_cast<double>(skin.triangles.size());
  const Clock::time_point start = Clock::now();
  const tree::TriangleTree tree = tree::buildTriangleTree(skin);
  figures.tree_build_ns_per_triangle = secondsSince(start) * 1e9 / triangles;
  const std::size_t bytes = tree.nodes.size() * sizeof(tree::WideNode) +
                            tree.records.size() * sizeof(tree::TriangleRecord) +
                            tree.source_triangle.size() * sizeof(Index);
  figures.tree_bytes_per_triangle = static_cast<double>(bytes) / triangles;
}

/// A dysfunction of 25 mm that moves by a millimetre a time, as under a slider.
double changeMs(const scene::World& world) {
  const Vec3 middle = world.body->box.center();
  std::vector<double> times_ms;
  for (int i = 0; i < 9; ++i) {
    scene::Scene scene = world.scene;
    scene.dysfunctions = {{.x_mm = middle.x() + i, .y_mm = middle.y(), .radius_mm = 25.0}};
    const Clock::time_point start = Clock::now();
    (void)scene::rebuilt(world, scene);
    times_ms.push_back(1e3 * secondsSince(start));
  }
  std::ranges::nth_element(times_ms, times_ms.begin() + 4);
  return times_ms[4];
}

}  // namespace

LoadFigures measureLoad(const std::filesystem::path& file, const Progress& progress) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = file;
  LoadFigures figures;
  StageClock clock(progress);
  const Clock::time_point start = Clock::now();
  const auto world = scene::build(scene, clock.callback());
  clock.begin("first touch");
  const contact::FingerOutput output = firstForce(*world);
  figures.seconds = secondsSince(start);
  figures.steps = clock.finish();
  figures.peak_memory_gb = peakMemoryGb();
  figures.triangles = world->body->skin.triangles.size();
  figures.vertices = world->body->skin.positions.size();
  figures.first_force_n = output.force.norm();
  figures.hash = hashOf(*world, output);
  report(progress, "building the tree once more", 0.0);
  measureTree(world->body->skin, figures);
  figures.change_ms = changeMs(*world);
  return figures;
}

double assimpSeconds(const std::filesystem::path& file) {
  mesh::LoadOptions options;
  options.weld = false;
  const Clock::time_point start = Clock::now();
  (void)mesh::loadFromMemory(readFile(file, options.max_bytes), mesh::Format::foreign, file.string(), options);
  return secondsSince(start);
}

double peakMemoryGb() {
#ifdef __linux__
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) return static_cast<double>(usage.ru_maxrss) * 1024.0 * 1e-9;
#endif
  return 0.0;
}

}  // namespace palpate::app
