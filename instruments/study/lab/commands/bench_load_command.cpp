// `palpate study bench load`: how long a user waits, and how much memory it takes, from a mesh file to the first force.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/contact/finger.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::app {
namespace {

// From a mesh file to the first force: the numbers of `palpate study bench load`.
//
// file -> scene::build (read and weld, repair, order, contact surface, deformation) -> one finger that presses.
// The wait of a user between naming a file and feeling it.

struct LoadStep {
  std::string name;             ///< as the progress line calls it
  double seconds = 0.0;         ///< all stretches of that name together
  double peak_memory_gb = 0.0;  ///< process's peak since its start, when the step ended
};

struct LoadFigures {
  double seconds = 0.0;           ///< file to force
  double peak_memory_gb = 0.0;    ///< process's peak, 1e9 bytes, including what was loaded before
  std::uint64_t page_faults = 0;  ///< process's, from file to force; large pages take few
  std::vector<LoadStep> steps;
  std::size_t triangles = 0;  ///< triangles of the skin after repair
  std::size_t vertices = 0;
  double first_force_n = 0.0;
  double tree_bytes_per_triangle = 0.0;     ///< tree and walk records
  double tree_build_ns_per_triangle = 0.0;  ///< the same, built once more alone
  std::uint64_t hash = 0;                   ///< hash of skin and first force
  double change_ms = 0.0;                   ///< until the world has another dysfunction; the median of some
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

/// Throws Error as scene::build does, and for a body that cannot be felt anywhere.
LoadFigures measureLoad(const std::filesystem::path& file, const Progress& progress) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = file;
  LoadFigures figures;
  StageClock clock(progress);
  const std::uint64_t faults_before = memoryOfProcess().page_faults;
  const Clock::time_point start = Clock::now();
  const auto world = scene::build(scene, clock.callback());
  clock.begin("first touch");
  const contact::FingerOutput output = firstForce(*world);
  figures.seconds = secondsSince(start);
  figures.steps = clock.finish();
  const MemoryOfProcess memory = memoryOfProcess();
  figures.peak_memory_gb = memory.peak_gb;
  figures.page_faults = memory.page_faults - faults_before;
  figures.triangles = world->body->skin.triangles.size();
  figures.vertices = world->body->skin.positions.size();
  figures.first_force_n = output.force.norm();
  figures.hash = hashOf(*world, output);
  report(progress, "building the tree once more", 0.0);
  measureTree(world->body->skin, figures);
  figures.change_ms = changeMs(*world);
  return figures;
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
  bool json = false;
};

double perTriangle(double value, const LoadFigures& f) { return value / static_cast<double>(f.triangles); }

Json toJson(const std::string& file, const LoadFigures& f) {
  Json json;
  json["file"] = file;
  json["triangles"] = f.triangles;
  json["vertices"] = f.vertices;
  json["seconds"] = f.seconds;
  json["peak_memory_gb"] = f.peak_memory_gb;
  json["page_faults"] = f.page_faults;
  json["bytes_per_triangle"] = perTriangle(f.peak_memory_gb * 1e9, f);
  json["ns_per_triangle"] = perTriangle(f.seconds * 1e9, f);
  for (const LoadStep& step : f.steps) {
    json["steps"].push_back({{"name", step.name}, {"seconds", step.seconds}, {"peak_memory_gb", step.peak_memory_gb}});
  }
  json["tree_bytes_per_triangle"] = f.tree_bytes_per_triangle;
  json["tree_build_ns_per_triangle"] = f.tree_build_ns_per_triangle;
  json["change_ms"] = f.change_ms;
  json["first_force_n"] = f.first_force_n;
  json["hash"] = fmt::format("{:016x}", f.hash);
  return json;
}

std::string textOf(const LoadFigures& f) {
  std::string text = fmt::format("triangles            {}\n", f.triangles);
  text +=
      fmt::format("file to first force  {:.2f} s, {:.0f} ns a triangle\n", f.seconds, perTriangle(f.seconds * 1e9, f));
  text += fmt::format("peak memory          {:.2f} GB, {:.0f} bytes a triangle\n", f.peak_memory_gb,
                      perTriangle(f.peak_memory_gb * 1e9, f));
  text += fmt::format("page faults          {}\n", f.page_faults);
  for (const LoadStep& step : f.steps) {
    text += fmt::format("  {:<32} {:>7.3f} s, peak {:.2f} GB\n", step.name, step.seconds, step.peak_memory_gb);
  }
  text += fmt::format("tree and records     {:.1f} bytes, built in {:.0f} ns a triangle\n", f.tree_bytes_per_triangle,
                      f.tree_build_ns_per_triangle);
  text += fmt::format("another dysfunction  {:.2f} ms\n", f.change_ms);
  return text + fmt::format("hash                 {:016x}\n", f.hash);
}

double stepSeconds(const LoadFigures& f, std::string_view step) {
  for (const LoadStep& s : f.steps) {
    if (s.name == step) return s.seconds;
  }
  return 0.0;
}

/// Reading alone is what assimp does too.
void addAssimp(const std::filesystem::path& file, const LoadFigures& f, Json& json, std::string& text) {
  try {
    const double theirs = assimpSeconds(file);
    const double ratio = stepSeconds(f, "reading") / theirs;
    json["peers"]["assimp"] = {{"seconds", theirs}};
    json["ratio_to"]["assimp"] = ratio;
    text += fmt::format("assimp               {:.2f} s to read, ours {:.2f} of that with welding\n", theirs, ratio);
  } catch (const Error& error) {
    json["peers"]["assimp"] = {{"skipped", error.what()}};
    text += fmt::format("assimp               skipped: {}\n", error.what());
  }
}

void runLoadBench(const LoadArguments& arguments) {
  ProgressLine progress;
  const WrittenMesh mesh(arguments.file);
  const LoadFigures figures = measureLoad(mesh.file(), progress.callback());
  Json json = toJson(arguments.file, figures);
  std::string text = textOf(figures);
  if (arguments.peers) addAssimp(mesh.file(), figures, json, text);
  progress.clear();
  printReport(std::move(json), text, arguments.json);
}

}  // namespace

void addBenchLoadCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "load", "Time everything from a mesh file to the first force felt", runLoadBench);
  command.add_option("FILE", arguments.file, kMeshNamesHelp)->required();
  command.add_flag("--peers", arguments.peers, "Also time how long assimp reads the same file");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
