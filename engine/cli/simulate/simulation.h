// One simulated palpation from its settings to its files: the work of `palpate simulate` between reading its options
// and printing its summary.
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
#include "palpate/engine/bone_cover.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::app {

/// The 60 Hz side of a realtime run.
struct DisplayReport {
  std::uint64_t frames = 0;
  double period_ms = 0.0;                ///< between two requested frames
  servo::DurationPercentiles deform;     ///< one frame's deformation, strain included
  servo::DurationPercentiles staleness;  ///< age of the newest contact when a frame took it
};

struct SimulationResult {
  std::string preset;  ///< preset of the request; empty: none
  std::shared_ptr<const scene::World> world;
  std::filesystem::path folder;
  double build_s = 0.0;
  double pictures_s = 0.0;  ///< time for drawing pictures.png; 0 when none was drawn
  double duration_s = 0.0;  ///< simulated time
  double planned_s = 0.0;   ///< requested time
  int ended_by = 0;         ///< the signal that ended it early, or 0
  servo::LoopReport loop;
  servo::LimiterSettings limits;         ///< in force: the weakest device's for all fingers
  std::optional<DisplayReport> display;  ///< for a realtime run
  std::vector<FingerStatistics> fingers;
  std::optional<engine::BoneCover> cover;  ///< between skin and bone where the fingers pressed deepest
  std::uint64_t hash = 0;                  ///< over all contact forces
  std::vector<std::string> files;
  std::vector<std::string> notes;
};

struct SimulationSettings {
  std::filesystem::path folder = "results";
  bool realtime = false;
  std::vector<std::string> devices = {};  ///< for the first fingers (device/back_ends.h)
  bool recording = false;                 ///< writes a recording file, which can be replayed bit for bit
  bool pictures = true;                   ///< writes a contact sheet, where pictures can be drawn
  bool plot = true;                       ///< writes a plot of the forces
};

/// Builds the scene, runs it and writes its files into the folder, which is made if needed. A signal ends the run,
/// whose files are still finished (interruption.h). Throws Error, and Ended for a signal before the run.
SimulationResult simulate(const scene::Scene& scene, const SimulationSettings& settings, const Progress& progress);

// Output to the user: simulate_report.cpp.

/// Keys carry their units; docs/reference/simulate.md lists them.
Json reportJson(const SimulationResult& result);

/// Some twenty lines, fit for a terminal of 100 columns.
std::string formatSummary(const SimulationResult& result);

}  // namespace palpate::app
