#include "apps/palpate/simulate/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/palpate/common/interruption.h"
#include "apps/palpate/plot/forces_plot.h"
#include "apps/palpate/render/contact_sheet.h"
#include "apps/palpate/simulate/realtime_run.h"
#include "apps/palpate/simulate/run_recorder.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/scene/hdb_source.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::app {

namespace {

constexpr const char* kAutomaticFile = "trajectory_automatic.csv";
constexpr const char* kPicturesFile = "pictures.png";
constexpr const char* kPlotFile = "forces.png";
constexpr double kPlotScale = 1.5;  ///< sharp on today's screens, and a third cheaper than the figures of documents

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw Error::inFile(folder.string(), "cannot be made a folder for results");
}

void saveAutomaticPaths(const scene::World& world, const device::FingerPaths& paths, SimulationResult& result) {
  for (std::size_t i = 0; i < world.scene.fingers.size(); ++i) {
    if (!world.scene.fingers[i].findsItsOwnWay()) continue;
    device::Trajectory path;
    path.tip_mm = *paths.tips[i];
    for (std::size_t k = 0; k < path.tip_mm.size(); ++k) {
      path.time_s.push_back(static_cast<double>(k) / world.scene.ticks_per_s);
    }
    device::writeTrajectory(result.folder / kAutomaticFile, path);
    result.files.emplace_back(kAutomaticFile);
  }
}

void run(const scene::World& world, const device::FingerPaths& paths, bool realtime, RunRecorder& recorder,
         SimulationResult& result, const Progress& progress) {
  servo::Rig rig = servo::scriptedRig(world, paths);
  if (realtime) {
    const auto record = [&](const trace::Sample& sample) { recorder.add(sample); };
    RealtimeReport report = runRealtime(world, rig, paths.ticks, record, progress);
    result.loop = std::move(report.loop);
    result.display = report.display;
    return;
  }
  const auto record = [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) recorder.add(sample);
  };
  result.loop = servo::runHeadless(rig, paths.ticks, record, progress, [] { return endAskedBy() != 0; });
}

void noteUntouched(const scene::World& world, const RunStatistics& statistics, std::vector<std::string>& notes) {
  if (statistics.anyTouch()) return;
  const Eigen::AlignedBox3d box = mesh::boundingBox(world.skin);
  notes.push_back(fmt::format(
      "no finger touched the body, which lies between ({:.1f}, {:.1f}, {:.1f}) and ({:.1f}, {:.1f}, {:.1f}) mm: "
      "trajectories are in its coordinates",
      box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()));
}

/// A machine that cannot draw still palpates, and a run that was ended is not drawn.
std::optional<view::Image> drawnSheet(const RunRecorder& recorder, SimulationResult& result, const Progress& progress) {
  try {
    return contactSheet(result.world, {recorder.deepest(), recorder.farthest()}, endingWhenAsked(progress));
  } catch (const Error& error) {
    result.notes.push_back(fmt::format("no {}: {}", kPicturesFile, error.what()));
  } catch (const Ended& ended) {
    result.notes.push_back(fmt::format("no {}: {}", kPicturesFile, ended.what()));
  }
  return std::nullopt;
}

void leavePictures(const RunRecorder& recorder, SimulationResult& result, const Progress& progress) {
  const std::int64_t started_ns = monotonicNs();
  const std::optional<view::Image> sheet = drawnSheet(recorder, result, progress);
  if (!sheet) return;
  view::writePng(result.folder / kPicturesFile, *sheet);
  result.files.emplace_back(kPicturesFile);
  result.pictures_s = static_cast<double>(monotonicNs() - started_ns) * 1e-9;
}

/// Ticks that were left out in real time passed too.
void noteEnd(const scene::World& world, SimulationResult& result) {
  const double seconds = static_cast<double>(result.loop.ticks + result.loop.overruns) / world.scene.ticks_per_s;
  result.ended_by = endAskedBy();
  if (result.ended_by == 0 || seconds >= result.planned_s) return;
  result.duration_s = seconds;
  result.notes.push_back(fmt::format("ended by {} after {:.3f} of {:.3f} s: the results are those of this part",
                                     nameOfSignal(result.ended_by), seconds, result.planned_s));
}

/// `palpate plot` draws the same from forces.csv.
void leavePlot(const RunRecorder& recorder, SimulationResult& result) {
  const auto ran = [](const RunStrip& strip) { return !strip.steps().empty(); };
  if (!std::ranges::all_of(recorder.strips(), ran)) return;  // stopped before the first tick
  const ForcesPlot plot{.title = result.world->scene.title};
  figures::writePng(forcesFigure(plot, recorder.strips()), result.folder / kPlotFile, kPlotScale);
  result.files.emplace_back(kPlotFile);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

SimulationResult simulate(const scene::Scene& scene, const SimulationSettings& settings, const Progress& progress) {
  SimulationResult result;
  result.folder = settings.folder;
  const std::int64_t started_ns = monotonicNs();
  result.world = scene::build(scene, endingWhenAsked(progress));
  const scene::World& world = *result.world;
  const device::FingerPaths paths = device::pathsOf(world);
  result.build_s = static_cast<double>(monotonicNs() - started_ns) * 1e-9;
  result.planned_s = result.duration_s = static_cast<double>(paths.ticks) / scene.ticks_per_s;
  makeFolder(settings.folder);
  saveAutomaticPaths(world, paths, result);

  RunRecorder recorder(world, paths, settings.folder);
  run(world, paths, settings.realtime, recorder, result, progress);
  recorder.finish(progress);

  result.fingers = recorder.statistics().fingers();
  result.hash = recorder.statistics().hash();
  append(result.files, recorder.files());
  noteEnd(world, result);
  append(result.notes, world.notes);
  if (world.hdb) result.notes.push_back(scene::describe(*world.hdb));
  append(result.notes, recorder.notes());
  noteUntouched(world, recorder.statistics(), result.notes);
  if (settings.plot) leavePlot(recorder, result);
  if (settings.pictures) leavePictures(recorder, result, progress);
  result.ended_by = endAskedBy();
  return result;
}

}  // namespace palpate::app
