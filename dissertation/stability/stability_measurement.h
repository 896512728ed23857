// The servo's loop closed over simulated devices and hands: where it stops resting, with and without the controller.
#pragma once

#include <string>
#include <vector>

#include "lab/loops/random_loops.h"
#include "palpate/base/progress.h"

namespace palpate::study {

struct StabilityPlan {
  double onset_factor = 1.15;                                       ///< between two stiffnesses that are tried
  std::vector<double> delays;                                       ///< of the map, in ticks
  std::vector<double> stiffness;                                    ///< of the map, N/mm
  std::vector<double> rates;                                        ///< Hz
  std::size_t systems = 400;                                        ///< random ones of a cell
  int phases = 40;                                                  ///< of a tap
  std::vector<scene::DeviceModel> devices = lab::nominalDevices();  ///< that are kicked until they oscillate
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

/// The stiffness at which a device stops resting after a kick, N/mm; `kMostStiffness` where it always rests.
struct OnsetRow {
  scene::DeviceModel device = scene::DeviceModel::unknown;
  double delay_ticks = 1.0;
  bool controlled = false;
  double dead_load = 0.0;
  double worst_hand = 0.0;
};
inline constexpr double kMostStiffness = 11.5;

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
  lab::TapResult worst;  ///< of every hand and phase, at 0.5 m/s
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

}  // namespace palpate::study
