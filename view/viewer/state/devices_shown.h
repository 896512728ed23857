// What the panel of the devices shows and changes, as plain data (device_control.h fills it in once a frame).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "palpate/device/device_frame.h"
#include "palpate/device/workspace.h"
#include "palpate/servo/limiter.h"

namespace palpate::viewer {

// What the servo did to the forces of a held finger: counted, and said in a few words while it is going on. Pure.

class Interventions {
 public:
  /// One tick's safety bits.
  void add(std::uint32_t safety, double now_s);
  /// "held back 812, damped 3": those of the last two seconds with their ticks in all, the newest of them first; empty
  /// when there was none.
  std::string recent(double now_s) const;
  /// Ticks in which each bit was set.
  const std::array<std::uint64_t, servo::kSafetyBits>& counts() const { return counts_; }

 private:
  std::array<std::uint64_t, servo::kSafetyBits> counts_{};
  std::array<double, servo::kSafetyBits> last_s_{};
};

/// A back end as it was found.
struct BackEndFound {
  std::string name = {};
  std::string about = {};
  bool available = false;
  std::string reason = {};  ///< why not, and what mends it
  std::string remedy = {};
  std::string version = {};
  std::vector<std::string> devices = {};
};

/// Who has a finger.
struct FingerHeld {
  // What is.
  std::string words;            ///< of the device, as it was asked for; empty: the mouse has it
  std::string opening;          ///< the one that is being opened
  std::string about;            ///< what it says of itself
  std::string trouble;          ///< in words, while there is some
  device::Capabilities able;    ///< as the driver says, before the workspace
  device::Workspace workspace;  ///< at work
  device::WorkspaceReading reading;
  /// Of the device itself, mm: its newest place, kept over a tick without one, lost after half a second.
  Vec3 known_place = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  double known_s = -1.0;
  double positions_per_s = 0.0;  ///< of the last second
  double most_loss_n_mm = 0.0;   ///< that the loop gave beyond the skin's law, in the last second
  Interventions interventions;
  // What is chosen.
  std::size_t back_end = 0;  ///< of the list, to be opened
  std::string which;
  bool clutch = false;  ///< held by the panel
};

/// Three places touched one after the other; what was found waits to be used.
struct CalibrationSteps {
  std::optional<std::size_t> finger;  ///< nothing: none is under way
  std::vector<Vec3> of_device;
  std::vector<Vec3> of_body;
  std::optional<device::Calibration> found;
  std::string trouble;  ///< why these places were no good

  /// One more pair; after the third there is a calibration, or it begins again and says why.
  void take(const Vec3& device, const Vec3& body);
};

struct DevicesShown {
  std::vector<BackEndFound> back_ends;
  bool looking = false;  ///< for them, beside the window
  std::array<FingerHeld, 2> fingers;
  bool stopped = false;                   ///< the emergency stop is latched
  double stiffness_factor = 1.0;          ///< of all forces: no place stiffer than the devices can render
  double ratios_kept_to_n = 0.0;          ///< above this force slopes are held at the devices' cap; 0: nowhere
  std::vector<std::string> safety_notes;  ///< what the scene asks for and does not get (servo::safetyNotes)
  bool unsafe = false;                    ///< --unsafe-stiffness was given, and this scene is the one it was given for
  CalibrationSteps calibration;

  bool anyHeld() const { return !fingers[0].words.empty() || !fingers[1].words.empty(); }
};

}  // namespace palpate::viewer
