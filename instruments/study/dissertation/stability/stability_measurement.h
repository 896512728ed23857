// The servo's loop closed over simulated devices and hands: where it stops resting, with and without the controller.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lab/loops/random_loops.h"
#include "lab/loops/stability_map.h"
#include "palpate/base/progress.h"
#include "report/page/study_page.h"

namespace palpate::study {

struct StabilityPlan {
  double onset_factor = 1.15;                                       ///< between two stiffnesses that are tried
  std::vector<double> delays;                                       ///< delays of the map, in ticks
  std::vector<double> stiffness;                                    ///< stiffnesses of the map, N/mm
  std::vector<double> rates;                                        ///< Hz
  std::size_t systems = 400;                                        ///< random ones of a cell
  int phases = 40;                                                  ///< phases of a tap
  std::vector<scene::DeviceModel> devices = lab::nominalDevices();  ///< devices that are kicked until they oscillate
  bool every_cell = true;  ///< false: only the cells that the main numbers need
};

StabilityPlan stabilityPlan(bool quick);

/// An ideal device: where growth begins, over b / (T/2 + t_d).
struct TheoryRow {
  double ticks_per_s = 1000.0;
  double delay_ticks = 1.0;
  double theory_n_per_mm = 0.0;
  double measured_n_per_mm = 0.0;
};

/// The stiffness at which a device stops resting after a kick, N/mm; `kMaxStiffness` where it always rests.
struct OnsetRow {
  scene::DeviceModel device = scene::DeviceModel::unknown;
  double delay_ticks = 1.0;
  bool controlled = false;
  double dead_load = 0.0;
  double worst_hand = 0.0;
};
inline constexpr double kMaxStiffness = 11.5;

/// Motion after a kick over delay (columns) and stiffness (rows), um, for one device.
struct MotionMap {
  device::HandKind hand = device::HandKind::dead_load;
  bool controlled = false;
  std::vector<double> motion_um;  ///< row by row
};

struct RateRow {
  double ticks_per_s = 1000.0;
  double line = 0.0;           ///< b / (T/2 + t_d)
  double friction_line = 0.0;  ///< min(2 b / T, 2 c / Delta)
  double off_dead = 0.0, off_hand = 0.0, on_dead = 0.0, on_hand = 0.0;
};

struct CellRow {
  lab::RandomCell cell;
  std::size_t oscillate = 0;
};

struct TouchRow {
  scene::DeviceModel device = scene::DeviceModel::unknown;
  double stiffness_n_per_mm = 1.0;
  bool controlled = false;
  lab::TapResult worst;  ///< over every hand and phase, at 0.5 m/s
};

struct PressRow {
  scene::DeviceModel device = scene::DeviceModel::unknown;
  double stiffness_n_per_mm = 1.0;
  double bias = 0.0;  ///< the worst of every hand, like the others
  double noise_n = 0.0;
  double hysteresis = 0.0;
};

struct StabilityMeasurement {
  StabilityPlan plan;
  std::vector<TheoryRow> theory;
  std::vector<OnsetRow> onsets;
  std::vector<MotionMap> maps;
  std::vector<RateRow> rates;
  std::vector<CellRow> cells;
  std::vector<TouchRow> touches;
  std::vector<PressRow> presses;
  double bare_swing_mm = 0.0;  ///< Touch X, dead load, 1 N/mm, without the controller
};

/// The device of maps and curves.
inline constexpr scene::DeviceModel kMappedDevice = scene::DeviceModel::touch_x;

StabilityMeasurement measureStability(const StabilityPlan& plan, const Progress& progress);

// Findings of the stability measurement, in sentences and numbers; decided by the numbers alone.

/// The worst of all rows, in the units of the JSON keys.
struct StabilityNumbers {
  double theory_error_percent = 0.0;
  double first_contact_force_n = 0.0;  ///< controlled, at most 3 N/mm, at 0.5 m/s
  double port_energy_mj = 0.0;
  double stiffness_bias_percent = 0.0;  ///< at most 1 N/mm
};

StabilityNumbers numbersOf(const StabilityMeasurement& found);

/// Share of the random systems of this cell that oscillate; NaN where it was not measured.
double oscillatingShare(const StabilityMeasurement& found, const lab::RandomCell& cell);

std::vector<std::string> stabilityFindings(const StabilityMeasurement& found);

/// Results by the names that programs know.
std::vector<std::pair<std::string, double>> stabilityPairs(const StabilityMeasurement& found);

// `palpate study stability --map`: the product's limits at every rate and delay, and random systems there.

/// Totals of all cells, and of those where a session may start.
struct StabilityMapTotals {
  std::size_t cells = 0;
  std::size_t allowed = 0;
  std::size_t oscillates_bare = 0;
  std::size_t oscillates_controlled = 0;
  std::size_t controlled_above_bare = 0;  ///< cells
  std::size_t oscillates_allowed = 0;     ///< controlled
  double port_energy_allowed_mj_max = 0.0;
};

StabilityMapTotals computeTotals(const std::vector<lab::StabilityCell>& cells);

StudyPage stabilityMapPage(const lab::StabilityMapPlan& plan, const std::vector<lab::StabilityCell>& cells);

/// Quick: two rates, three delays, two systems a cell.
StudyPage studyStabilityMap(const StudySettings& settings);

}  // namespace palpate::study
