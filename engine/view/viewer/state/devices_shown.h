// Data that the panel of the devices shows and changes (device_control.h fills it in once a frame).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "palpate/device/calibration.h"
#include "palpate/device/workspace.h"
#include "palpate/servo/limiter.h"

namespace palpate::viewer {

// The servo's interventions in the forces of a held finger, counted and summarised while they last. Pure.

class Interventions {
 public:
  /// One tick's safety bits.
  void add(std::uint32_t safety, double now_s);
  /// "held back 812, damped 3": interventions of the last two seconds with their total ticks, the newest first; empty
  /// without any.
  std::string recent(double now_s) const;
  /// Ticks in which each bit was set.
  const std::array<std::uint64_t, servo::kSafetyBits>& counts() const { return counts_; }

 private:
  std::array<std::uint64_t, servo::kSafetyBits> counts_{};
  std::array<double, servo::kSafetyBits> last_s_{};
};

/// A back end as found.
struct BackEndFound {
  std::string name = {};
  std::string about = {};
  bool available = false;
  std::string reason = {};  ///< why it is unavailable, and the remedy
  std::string remedy = {};
  std::string version = {};
  std::vector<std::string> devices = {};
};

/// The holder of a finger.
struct FingerHeld {
  // Present state.
  std::string words;            ///< the device's name as requested; empty: the mouse has it
  std::string opening;          ///< the device that is being opened
  std::string about;            ///< its self-description
  std::string trouble;          ///< its fault, if any
  device::Capabilities able;    ///< reported by the driver, before the workspace
  device::Workspace workspace;  ///< in use
  device::WorkspaceReading reading;
  /// The device's own newest place, mm: kept over a tick without one, lost after half a second.
  Vec3 known_place = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  double known_s = -1.0;
  double positions_per_s = 0.0;  ///< in the last second
  double most_loss_n_mm = 0.0;   ///< energy from the loop beyond the skin's law, in the last second
  Interventions interventions;
  // Choices.
  std::size_t back_end = 0;  ///< index into the list, to be opened
  std::string which;
  bool clutch = false;  ///< held by the panel
};

/// Three places touched one after the other; the result waits to be used.
struct CalibrationSteps {
  std::optional<std::size_t> finger;  ///< empty: none in progress
  std::vector<Vec3> of_device;
  std::vector<Vec3> of_body;
  std::optional<device::Calibration> found;
  std::string trouble;  ///< why these places were unsuitable

  /// Adds a pair; after the third there is a calibration, or it starts over with the reason.
  void addPair(const Vec3& device, const Vec3& body);
};

struct DevicesShown {
  std::vector<BackEndFound> back_ends;
  bool looking = false;  ///< searching for them, on its own thread
  std::array<FingerHeld, 2> fingers;
  bool stopped = false;                   ///< the emergency stop is latched
  double stiffness_factor = 1.0;          ///< on all forces: no place is stiffer than the devices can render
  double ratios_kept_to_n = 0.0;          ///< above this force slopes are limited to the devices' cap; 0: nowhere
  std::vector<std::string> safety_notes;  ///< requests of the scene that are refused (servo::safetyNotes)
  bool unsafe = false;                    ///< --unsafe-stiffness was used, with this scene
  CalibrationSteps calibration;

  bool anyHeld() const { return !fingers[0].words.empty() || !fingers[1].words.empty(); }
};

}  // namespace palpate::viewer
