#include "cli/simulate/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/device_option.h"
#include "cli/kit/families.h"
#include "cli/kit/interruption.h"
#include "cli/kit/output_place.h"
#include "cli/render/contact_sheet.h"
#include "cli/simulate/realtime_run.h"
#include "cli/simulate/run_recorder.h"
#include "palpate/base/error.h"
#include "palpate/base/made_folder.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/back_ends.h"
#include "palpate/engine/bone_cover.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/hdb_source.h"
#include "palpate/servo/device_limits.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::app {

namespace {

constexpr const char* kAutomaticFile = "trajectory_automatic.csv";
constexpr const char* kPicturesFile = "pictures.png";
constexpr const char* kForcesFile = "forces.csv";
constexpr const char* kPlotFile = "forces.png";

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void saveAutomaticPaths(const scene::World& world, const device::FingerPaths& paths, SimulationResult& result) {
  for (std::size_t i = 0; i < world.scene.fingers.size(); ++i) {
    if (!world.scene.fingers[i].hasAutomaticPath()) continue;
    device::Trajectory path;
    path.tip_mm = *paths.tips[i];
    for (std::size_t k = 0; k < path.tip_mm.size(); ++k) {
      path.time_s.push_back(static_cast<double>(k) / world.scene.ticks_per_s);
    }
    device::writeTrajectory(result.folder / kAutomaticFile, path);
    result.files.emplace_back(kAutomaticFile);
  }
}

/// The limits of the weakest device hold for all fingers: forces of two of them must compare.
void applyLimits(const std::vector<device::Device>& devices, servo::Rig& rig, SimulationResult& result) {
  const scene::World& world = *result.world;
  std::vector<device::Capabilities> able;
  for (const device::Device& device : devices) able.push_back(device.capabilities);
  const device::DeviceProfile profile = device::profileOf(world.scene.safety.device, able);
  servo::requireStable(profile, world.scene.safety, 1.0 / world.scene.ticks_per_s);
  result.limits = servo::limiterSettings(world, profile);
  for (servo::FingerChain& finger : rig.fingers) finger.limiter_settings = result.limits;
  const std::vector<std::string> notes = servo::safetyNotes(world.scene.safety, profile, result.limits.tick_s);
  printUnsafeNotes(notes);
  append(result.notes, notes);
}

/// Opens the devices and puts them in place of the first fingers' paths, where these begin.
void useDevices(const SimulationSettings& settings, const device::FingerPaths& paths, servo::Rig& rig,
                SimulationResult& result) {
  std::vector<device::OpenOptions> fingers(paths.tips.size());
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    fingers[i].tips = paths.tips[i];
    fingers[i].tick_s = rig.tick_s;
  }
  std::vector<device::Device> devices = openDevices(settings.devices, fingers);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].capabilities.rhythm != device::Rhythm::on_call && !settings.realtime) {
      throw Error(devices[i].name + ": a haptic device runs in real time; add --realtime");
    }
    devices[i] = placedDevice(devices[i], settings.devices[i], i, paths.tips[i]->front(), result.world->scene);
    servo::giveDevice(rig.fingers[i], devices[i]);
  }
  applyLimits(devices, rig, result);
  const double factor = result.limits.stiffness_factor;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    result.notes.push_back(fmt::format("finger {} is moved by {}{}", result.world->scene.fingers[i].name,
                                       device::describe(devices[i]),
                                       factor < 1.0 ? fmt::format("; all forces times {:.2f}", factor) : ""));
  }
}

void noteTroubles(const servo::Rig& rig, SimulationResult& result) {
  for (const servo::FingerChain& finger : rig.fingers) {
    const std::string trouble = finger.device.explain ? finger.device.explain() : std::string();
    if (!trouble.empty()) result.notes.push_back(finger.device.name + ": " + trouble);
  }
}

void run(const device::FingerPaths& paths, const SimulationSettings& settings, RunRecorder& recorder,
         SimulationResult& result, const Progress& progress) {
  const scene::World& world = *result.world;
  servo::Rig rig = servo::scriptedRig(world, paths);
  useDevices(settings, paths, rig, result);
  if (settings.recording) recorder.startRecording(rig);
  if (settings.realtime) {
    const auto record = [&](const trace::Sample& sample) { recorder.add(sample); };
    RealtimeReport report = runRealtime(world, rig, paths.ticks, record, progress);
    result.loop = std::move(report.loop);
    result.display = report.display;
    noteTroubles(rig, result);
    return;
  }
  const auto record = [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) recorder.add(sample);
  };
  result.loop = servo::runHeadless(rig, paths.ticks, record, progress, [] { return endingSignal() != 0; });
}

void noteUntouched(const scene::World& world, const RunStatistics& statistics, std::vector<std::string>& notes) {
  if (statistics.anyTouch()) return;
  const Eigen::AlignedBox3d box = mesh::boundingBox(world.body->skin);
  notes.push_back(
      fmt::format("no finger touched the body, which extends from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f}) "
                  "mm; trajectories use its coordinates",
                  box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()));
}

/// Drawing may fail without ending the run, and an interrupted run is not drawn.
std::optional<view::Image> drawnSheet(const RunRecorder& recorder, SimulationResult& result, const Progress& progress) {
  try {
    return contactSheet(result.world, {recorder.deepest(), recorder.farthest()}, interruptible(progress));
  } catch (const Error& error) {
    result.notes.push_back(fmt::format("{} was not written: {}", kPicturesFile, error.what()));
  } catch (const Ended& ended) {
    result.notes.push_back(fmt::format("{} was not written: {}", kPicturesFile, ended.what()));
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

/// Ticks that were left out in real time count too.
void noteEnd(const scene::World& world, SimulationResult& result) {
  const double seconds = static_cast<double>(result.loop.ticks + result.loop.overruns) / world.scene.ticks_per_s;
  result.ended_by = endingSignal();
  if (result.ended_by == 0 || seconds >= result.planned_s) return;
  result.duration_s = seconds;
  result.notes.push_back(fmt::format("ended by {} after {:.3f} of {:.3f} s; the results cover this part only",
                                     nameOfSignal(result.ended_by), seconds, result.planned_s));
}

std::optional<engine::BoneCover> measureBoneCover(const scene::World& world, const servo::TickSamples& deepest) {
  if (deepest.empty() || world.body->anatomy.bones.empty()) return std::nullopt;
  engine::LivingSkin skin(world, {.strain = false});
  skin.follow(deepest);
  return engine::BoneCoverMeter(world).of(skin.surface());
}

/// `palpate recording plot` draws it: without its package, the table remains.
void leavePlot(SimulationResult& result) {
  const bool has_table = std::ranges::find(result.files, kForcesFile) != result.files.end();
  if (!has_table || result.loop.ticks == 0) return;
  std::vector<std::string> words = {"recording", "plot", (result.folder / kForcesFile).string(), "--out",
                                    (result.folder / kPlotFile).string()};
  if (const std::string& title = result.world->scene.title; !title.empty()) words.push_back("--title=" + title);
  if (runFamily("report", words)) {
    result.files.emplace_back(kPlotFile);
  } else {
    result.notes.push_back(
        fmt::format("{} was not written: palpate-report, which draws it, is not installed, or failed", kPlotFile));
  }
}

}  // namespace

SimulationResult simulate(const scene::Scene& scene, const SimulationSettings& settings, const Progress& progress) {
  SimulationResult result;
  result.folder = settings.folder;
  const std::int64_t started_ns = monotonicNs();
  {
    const EndAtOnce nothing;
    result.world = scene::build(scene, progress);
  }
  const scene::World& world = *result.world;
  const device::FingerPaths paths = device::pathsOf(world);
  result.build_s = static_cast<double>(monotonicNs() - started_ns) * 1e-9;
  result.planned_s = result.duration_s = static_cast<double>(paths.ticks) / scene.ticks_per_s;
  const MadeFolder made(settings.folder);
  saveAutomaticPaths(world, paths, result);

  RunRecorder recorder(world, paths, settings.folder);
  run(paths, settings, recorder, result, progress);
  recorder.finish(progress);
  recorder.finishRecording(endingSignal() == 0 ? "done" : nameOfSignal(endingSignal()), result.loop.dropped_samples);

  result.fingers = recorder.statistics().fingers();
  result.cover = measureBoneCover(world, recorder.deepest());
  result.hash = recorder.statistics().hash();
  append(result.files, recorder.files());
  noteEnd(world, result);
  append(result.notes, world.notes);
  if (world.hdb) result.notes.push_back(scene::describe(*world.hdb));
  append(result.notes, recorder.notes());
  noteUntouched(world, recorder.statistics(), result.notes);
  if (settings.plot) leavePlot(result);
  if (settings.pictures) leavePictures(recorder, result, progress);
  result.ended_by = endingSignal();
  return result;
}

}  // namespace palpate::app
