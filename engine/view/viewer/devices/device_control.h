// Devices that come and go while the window is open: found, opened, closed and monitored on threads of their own; the
// clutch, the emergency stop, and the panel's data about all of them.
//
//   OpenDevice ─► open on its own thread ─► LiveServo::hold, in one tick with its limits ─► DevicesShown, once a frame
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "view/viewer/state/async_task.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"
#include "view/viewer/world/world_swap.h"

namespace palpate::viewer {

/// The limits, the names of the fingers' holders and the panel follow the servo's state.
class DeviceControl {
 public:
  /// All must outlive it.
  DeviceControl(LiveServo& servo, WorldSwap& world_swap, const scene::Scene& scene, FingerHolders& holders,
                Conversation& user)
      : servo_(servo), world_swap_(world_swap), scene_(scene), holders_(holders), user_(user) {}
  /// Abandons devices that are still being opened.
  ~DeviceControl();
  DeviceControl(const DeviceControl&) = delete;
  DeviceControl& operator=(const DeviceControl&) = delete;

  /// Adopts the devices that the window began with; opens those that the scene names, after a question where they reach
  /// beyond this program.
  void begin();
  /// Opens the devices of `begin`'s question, whatever the scene says by now.
  void openAsked();
  void open(std::size_t finger, const std::string& words);
  void close(std::size_t finger);
  void lookForBackEnds();
  void stop();
  void release();
  /// Returns true if the event was only the emergency stop's or the clutch's. The stop works in every state.
  bool handle(const window::InputEvent& event, bool text_wanted);
  /// One tick of a finger.
  void noteInterventions(const trace::Sample& sample);
  /// Once a frame, before changes of the scene take effect.
  void advance(std::size_t& active_finger, const scene::World& world);
  /// Another body, or a scene read: devices without a place are put next to it.
  void bodyChanged() { origins_ = {}; }

 private:
  struct Look {
    double since_s = 0.0;
    std::uint64_t fresh = 0;
    double most_loss_n_mm = 0.0;
  };

  void adoptOpened(std::size_t finger, std::size_t& active_finger, const scene::World& world);
  void placeDevices(const scene::World& world);
  device::Workspace workspaceNow(std::size_t finger, const std::string& words, const scene::World& world);
  void publishHeldDevices() const;
  void tend();
  void reportTrouble(std::size_t finger, std::string trouble);
  void readState(std::size_t finger);

  LiveServo& servo_;
  WorldSwap& world_swap_;
  const scene::Scene& scene_;
  FingerHolders& holders_;
  Conversation& user_;
  bool clutch_key_ = false;
  std::vector<OpenDevice> asked_;                      ///< named in the open question
  std::array<std::optional<Vec3>, kFingers> origins_;  ///< default origins; computed when needed
  double tended_s_ = 0.0;
  std::array<Look, kFingers> looks_;
  std::atomic<bool> give_up_{false};
  // Last, because they use the above.
  std::array<AsyncTask<device::Device>, kFingers> opening_;
  AsyncTask<std::vector<BackEndFound>> looking_;
  AsyncTask<std::array<std::string, kFingers>> tending_;
  AsyncTask<int> closing_;
};

}  // namespace palpate::viewer
