// `palpate study bench load`: how long a user waits, and how much memory it takes, from a mesh file to the first force.
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/order_statistics.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/contact/finger.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::app {
namespace {

struct LoadStep {
  std::string name;             ///< as the progress line calls it
  double seconds = 0.0;         ///< all stretches of that name together
  double peak_memory_gb = 0.0;  ///< process's peak since its start, when the step ended
};

struct MemoryOfProcess {
  double peak_gb = 0.0;  ///< the most that it ever had resident, 1e9 bytes
  std::uint64_t page_faults = 0;
};

/// Zeros if unknown.
MemoryOfProcess memoryOfProcess() {
#ifdef __linux__
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) {
    return {.peak_gb = static_cast<double>(usage.ru_maxrss) * 1024.0 * 1e-9,
            .page_faults = static_cast<std::uint64_t>(usage.ru_minflt + usage.ru_majflt)};
  }
#endif
  return {};
}

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
    step.peak_memory_gb = memoryOfProcess().peak_gb;
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
  constexpr std::size_t kMaxPlaces = 64;
  const double depth = 1e-3 * world.surface.geometry->tree.diagonal;  // 0.5 mm on a back
  const auto& records = world.surface.geometry->tree.records;
  for (std::size_t place = 0; place < kMaxPlaces; ++place) {
    const auto& [a, b, c] = records[place * records.size() / kMaxPlaces].corners;
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

/// Bytes of the tree and its walk records, and the time to build them once more alone.
void addTree(const mesh::TriangleMesh& skin, Json& json) {
  const auto triangles = static_cast<double>(skin.triangles.size());
  const Clock::time_point start = Clock::now();
  const tree::TriangleTree tree = tree::buildTriangleTree(skin);
  const double seconds = secondsSince(start);
  const std::size_t bytes = tree.nodes.size() * sizeof(tree::WideNode) +
                            tree.records.size() * sizeof(tree::TriangleRecord) +
                            tree.source_triangle.size() * sizeof(Index);
  json["tree_bytes_per_triangle"] = static_cast<double>(bytes) / triangles;
  json["tree_build_ns_per_triangle"] = seconds * 1e9 / triangles;
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
  return medianOf(std::move(times_ms));
}

/// Time of assimp alone to read the file, not welded, into the same arrays, s. Throws Error where it cannot.
double assimpSeconds(const std::filesystem::path& file) {
  mesh::LoadOptions options;
  options.weld = false;
  const Clock::time_point start = Clock::now();
  (void)mesh::loadFromMemory(readFile(file, options.max_bytes), mesh::Format::foreign, file.string(), options);
  return secondsSince(start);
}

struct LoadArguments {
  std::string file;
  bool peers = false;
};

/// Reading alone is what assimp does too.
void addAssimp(const std::filesystem::path& file, const std::vector<LoadStep>& steps, Json& json) {
  try {
    const double theirs = assimpSeconds(file);
    const auto reading = std::ranges::find(steps, "reading", &LoadStep::name);
    json["peers"]["assimp"] = {{"seconds", theirs}};
    json["ratio_to"]["assimp"] = (reading == steps.end() ? 0.0 : reading->seconds) / theirs;
  } catch (const Error& error) {
    json["peers"]["assimp"] = {{"skipped", error.what()}};
  }
}

/// The wait of a user between naming a file and feeling it: file -> scene::build (read and weld, repair, order, contact
/// surface, deformation) -> one finger that presses. Throws Error as scene::build does, and for a body that cannot be
/// felt anywhere.
Json measureLoad(const LoadArguments& arguments, ProgressLine& progress) {
  const WrittenMesh mesh(arguments.file);
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = mesh.file();
  const Progress shown = progress.callback();
  StageClock clock(shown);
  const std::uint64_t faults_before = memoryOfProcess().page_faults;
  const Clock::time_point start = Clock::now();
  const auto world = scene::build(scene, clock.callback());
  clock.begin("first touch");
  const contact::FingerOutput output = firstForce(*world);
  const double seconds = secondsSince(start);
  const std::vector<LoadStep> steps = clock.finish();
  const MemoryOfProcess memory = memoryOfProcess();
  const mesh::TriangleMesh& skin = world->body->skin;
  const auto triangles = static_cast<double>(skin.triangles.size());  // after repair
  Json json;
  json["file"] = arguments.file;
  json["triangles"] = skin.triangles.size();
  json["vertices"] = skin.positions.size();
  json["seconds"] = seconds;
  json["peak_memory_gb"] = memory.peak_gb;
  json["page_faults"] = memory.page_faults - faults_before;  // large pages take few
  json["bytes_per_triangle"] = memory.peak_gb * 1e9 / triangles;
  json["ns_per_triangle"] = seconds * 1e9 / triangles;
  for (const LoadStep& step : steps) {
    json["steps"].push_back({{"name", step.name}, {"seconds", step.seconds}, {"peak_memory_gb", step.peak_memory_gb}});
  }
  report(shown, "building the tree once more", 0.0);
  addTree(skin, json);
  json["change_ms"] = changeMs(*world);
  json["first_force_n"] = output.force.norm();
  json["hash"] = lab::hashText(hashOf(*world, output));
  if (arguments.peers) addAssimp(mesh.file(), steps, json);
  return json;
}

void addLoadOptions(Command& command, LoadArguments& a) {
  command.add_option("FILE", a.file, kMeshNamesHelp)->required();
  command.add_flag("--peers", a.peers, "Also time how long assimp reads the same file");
}

}  // namespace

void addBenchLoadCommand(Command& parent) {
  addBench(parent, "load", "Time everything from a mesh file to the first force felt", addLoadOptions, measureLoad);
}

}  // namespace palpate::app
