// One device of a plugin: a thread outside the servo calls a plugin that may wait, the servo itself one that answers at
// once. DriverLink is between them either way, so that the promises are the same.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/detail/driver_thread.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/shared_library.h"
#include "palpate/device/palpate_device.h"

namespace palpate::device::plugin {

// Plugins looked for: a file by its path, or by its name in the folders of PALPATE_DEVICE_PLUGINS.

/// Folders, `:` between them.
inline constexpr const char* kFoldersVariable = "PALPATE_DEVICE_PLUGINS";

struct Plugin {
  std::string file;                             ///< as requested
  const palpate_device_table* table = nullptr;  ///< null: it does not load
  std::string reason;                           ///< why not
  std::string remedy;
};

/// Opens the library and checks its table. It stays in memory until the program ends.
Plugin load(const std::string& file);

/// "point_mass"
std::string nameOf(const Plugin& plugin);
std::string pluginDescription(const Plugin& plugin);

/// The folders of the environment's variable.
std::vector<std::filesystem::path> folders();
/// Files of these folders that end in .so, in the order of their names.
std::vector<std::string> filesIn(const std::vector<std::filesystem::path>& folders);

struct Wanted {
  std::string file;   ///< empty: none was named
  std::string which;  ///< name among the plugin's devices
};
/// "PATH", "PATH:WHICH", or a NAME short for NAME.so or libNAME.so in one of the folders. A colon that belongs to a
/// file's name stays in it.
Wanted parsePluginName(const std::string& words);

/// Exchanges a second with a plugin that may wait: two to a tick of the servo, so that neither waits for the other.
inline constexpr double kExchangesPerS = 2000.0;

class Driver {
 public:
  /// Wraps a device that was opened, with its capabilities.
  Driver(const palpate_device_table& table, palpate_device_handle device, const palpate_device_capabilities& able,
         const DeviceFrame& frame, const OpenOptions& options, std::string which);
  ~Driver() { releaseDevice(); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  bool isOnCall() const { return capabilities_.rhythm == Rhythm::on_call; }
  const Capabilities& capabilities() const { return capabilities_; }

  /// For a plugin that may wait: force out, position in.
  void exchange() noexcept;

  // The servo's thread. They ask the plugin itself where it answers at once.
  Vec3 read(std::uint64_t tick) noexcept;
  void write(const Vec3& force) noexcept;
  const DeviceState& state() const noexcept { return link_.state(); }

  /// Zero force, and the plugin releases the device; it is not called from then on.
  void releaseDevice() noexcept;
  /// Reopens a device that was closed for its failures; true when it is there.
  bool revive();
  /// Its present fault, in words; empty: none.
  std::string explain();

 private:
  int sendForce(const Vec3& force) noexcept;
  /// True when there was something new.
  bool fetchReading(int told) noexcept;
  void refused() noexcept;
  std::string pluginErrorText() noexcept;

  const palpate_device_table& table_;
  palpate_device_handle device_;  ///< null: closed for its failures
  DeviceFrame frame_;
  Capabilities capabilities_;
  DriverLink link_;
  std::string which_;
  double tick_s_;

  Turns turns_;  ///< order of all calls for a device that may wait, and of its release
  int refusals_ = 0;
  std::atomic<bool> gone_{false};
  std::atomic<bool> servo_is_in_{false};  ///< in a plugin that answers at once
  int told_ = PALPATE_DEVICE_OK;          ///< its answer to the last force

  std::mutex words_mutex_;
  std::string trouble_;
};

/// A device, or the reason why not.
struct Opened {
  std::unique_ptr<Driver> driver;
  std::string reason;
};

/// Throws Error for invalid axes.
Opened openDriver(const palpate_device_table& table, const std::string& which, const OpenOptions& options);

}  // namespace palpate::device::plugin
