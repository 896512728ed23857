// Devices that come and go while the window is open: found, opened, closed and looked after beside the display; the
// clutch, the emergency stop, and what the panel knows of all of them.
//
//   OpenDevice ─► open beside the display ─► LiveServo::hold, in one tick with its limits ─► DevicesShown, once a frame
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

/// The limits, the words for who holds the fingers and the panel follow from what the servo has.
class DeviceControl {
 public:
  /// Both must outlive it.
  DeviceControl(LiveServo& servo, WorldSwap& world_swap) : servo_(servo), world_swap_(world_swap) {}
  /// Gives up what is being opened.
  ~DeviceControl();
  DeviceControl(const DeviceControl&) = delete;
  DeviceControl& operator=(const DeviceControl&) = delete;

  /// The devices that the window began with; those that the scene names are opened, or asked for where they reach
  /// beyond this program.
  void begin(ViewerState& viewer);
  /// What `begin` has asked for, whatever the scene says by now.
  void openAsked(ViewerState& viewer);
  void open(std::size_t finger, const std::string& words, ViewerState& viewer);
  void close(std::size_t finger, ViewerState& viewer);
  void lookForBackEnds(ViewerState& viewer);
  void stop(ViewerState& viewer);
  void release(ViewerState& viewer);
  /// True if the event was the emergency stop's or the clutch's alone. The stop is heard whatever else is asked.
  bool handle(const window::InputEvent& event, bool text_wanted, ViewerState& viewer);
  /// One tick of a finger.
  void felt(const trace::Sample& sample, ViewerState& viewer);
  /// Once a frame, before the changes of the scene are used.
  void advance(ViewerState& viewer, const scene::World& world);
  /// Another body, or a scene read: devices whose place nobody named are put beside it.
  void bodyChanged() { origins_ = {}; }

 private:
  struct Look {
    double since_s = 0.0;
    std::uint64_t fresh = 0;
    double most_loss_n_mm = 0.0;
  };

  void takeOpened(std::size_t finger, ViewerState& viewer, const scene::World& world);
  void placeDevices(ViewerState& viewer, const scene::World& world);
  device::Workspace workspaceNow(std::size_t finger, const std::string& words, const ViewerState& viewer,
                                 const scene::World& world);
  void tellWho(ViewerState& viewer) const;
  void tend(ViewerState& viewer);
  void tellTrouble(std::size_t finger, std::string trouble, ViewerState& viewer);
  void readState(std::size_t finger, ViewerState& viewer);

  LiveServo& servo_;
  WorldSwap& world_swap_;
  bool clutch_key_ = false;
  std::vector<OpenDevice> asked_;                      ///< what the question that is open names
  std::array<std::optional<Vec3>, kFingers> origins_;  ///< where nobody named one; found when it is needed
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
