// A servo loop that a script turns by hand: tick by tick through contact and limiter to the devices, and into a
// session.
//
//   script's tips or devices ─► servo::runTick ─► samples ─► trace::RecordingWriter
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device_handle.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/recording_writer.h"
#include "world_handle.h"

namespace palpate::python {

/// The limits of the weakest of these devices; the scene's own where none has force feedback.
servo::LimiterSettings limitsFor(const scene::World& world, const std::vector<device::Device>& devices);
/// The scene's, then "finger 3".
std::string nameOfFinger(const scene::World& world, std::size_t finger);

struct HandLoopSettings {
  std::vector<contact::FingerSettings> fingers;
  std::optional<std::filesystem::path> session;  ///< empty: no recording
  std::string notes;
};

/// One thread at a time.
class HandLoop {
 public:
  /// Without devices: the script sets each finger's place. Throws Error.
  HandLoop(WorldPointer world, std::vector<DevicePointer> devices, HandLoopSettings settings);
  /// Zero force; an unfinished recording stays under its partial name.
  ~HandLoop();
  HandLoop(const HandLoop&) = delete;
  HandLoop& operator=(const HandLoop&) = delete;

  std::size_t fingers() const { return rig_.fingers.size(); }
  bool takesTips() const { return !tips_.empty(); }
  bool closed() const { return closed_; }
  std::uint64_t ticks() const { return tick_; }

  /// The fingers' places from now on, one per finger. Only without devices.
  void place(std::span<const Vec3> tips);
  const std::vector<trace::Sample>& tick();
  const std::vector<trace::Sample>& felt() const { return samples_; }
  /// A finger was put elsewhere and forgets what it touched.
  void lift(std::size_t finger);
  /// An event at the newest tick. Throws ValueError where nothing is recorded.
  void mark(const std::string& text);
  /// Zero force; the recording is finished. Throws Error.
  void close(std::string_view ended_by);

  Busy busy;

 private:
  void record();
  void rest();

  WorldPointer world_;
  LentDevices lent_;
  std::vector<std::shared_ptr<Vec3>> tips_;  ///< used by a loop without devices
  servo::Rig rig_;
  std::vector<trace::Sample> samples_;
  std::optional<trace::RecordingWriter> writer_;
  std::uint64_t tick_ = 0;
  bool closed_ = false;
};

}  // namespace palpate::python
