// One simulated palpation from its settings to its files: what `palpate simulate` does between reading its options and
// printing its summary.
//
//   scene ─ build ─► world ─ paths ─► rig ─ headless │ realtime ─► recorder ─► forces.csv, surfaces, plot, pictures
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/simulate/run_recorder.h"
#include "palpate/base/json.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::app {

/// The 60 Hz side of a realtime run.
struct DisplayReport {
  std::uint64_t frames = 0;
  double period_ms = 0.0;                ///< between two frames that were asked for
  servo::DurationPercentiles deform;     ///< one frame's deformation, strain included
  servo::DurationPercentiles staleness;  ///< age of the newest contact when a frame took it
};

struct SimulationResult {
  std::string preset;  ///< that it was asked for by; empty: none
  std::shared_ptr<const scene::World> world;
  std::filesystem::path folder;
  double build_s = 0.0;
  double pictures_s = 0.0;  ///< spent on drawing pictures.png; 0 when none was drawn
  double duration_s = 0.0;  ///< of what was simulated
  double planned_s = 0.0;   ///< of what was asked for
  int ended_by = 0;         ///< the signal that ended it early, or 0
  servo::LoopReport loop;
  servo::LimiterSettings limits;         ///< that held: of the weakest device for all fingers
  std::optional<DisplayReport> display;  ///< of a realtime run
  std::vector<FingerStatistics> fingers;
  std::optional<engine::BoneCover> cover;  ///< between skin and bone where the fingers pressed deepest
  std::uint64_t hash = 0;                  ///< of all contact forces
  std::vector<std::string> files;
  std::vector<std::string> notes;
};

struct SimulationSettings {
  std::filesystem::path folder = "results";
  bool realtime = false;
  std::vector<std::string> devices = {};  ///< back ends that hold the first fingers (device/back_ends.h)
  bool recording = false;                 ///< leave a recording file, which can be replayed bit for bit
  bool pictures = true;                   ///< leave a contact sheet, where pictures can be drawn
  bool plot = true;                       ///< leave a plot of what was felt
};

/// Builds the scene, runs it and writes its files into the folder, which is made if needed. A signal ends the run,
/// whose files are finished all the same (interruption.h). Throws Error, and Ended when there is no run yet.
SimulationResult simulate(const scene::Scene& scene, const SimulationSettings& settings, const Progress& progress);

// What it tells its user: simulate_report.cpp.

/// Keys carry their units; docs/reference/simulate.md lists them.
Json reportOf(const SimulationResult& result);

/// Some twenty lines, fit for a terminal of 100 columns.
std::string summaryOf(const SimulationResult& result);

}  // namespace palpate::app
