// One Force Dimension device: an exchange reads its position and writes a force, and waits for the bus. So it runs
// outside the servo, on a thread of its own or wherever Device::exchange is called; DriverLink joins the two.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/shared_library.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::device::forcedimension {

// The used part of Force Dimension's DHD library, in declarations of our own: it is opened at run time, no SDK is
// needed to build. Metres, newtons; +x towards the operator, +y to the operator's right, +z up.

/// Answers of the library: below zero an error, above it a remark.
inline constexpr int kTimeGuard = 1;       ///< asked too soon: the data are those of before
inline constexpr int kMotorSaturated = 2;  ///< the force was shortened

/// Every function takes the number of an opened device last.
struct Api {
  int (*device_count)() = nullptr;
  int (*open)(char index) = nullptr;
  int (*close)(char id) = nullptr;
  int (*enable_force)(unsigned char on, char id) = nullptr;
  int (*get_position)(double* x, double* y, double* z, char id) = nullptr;
  int (*set_force)(double x, double y, double z, char id) = nullptr;
  // Optional: old libraries lack some.
  int (*get_velocity)(double* x, double* y, double* z, char id) = nullptr;
  unsigned (*button_mask)(char id) = nullptr;
  int (*button)(int index, char id) = nullptr;
  int (*system_type)(char id) = nullptr;
  const char* (*system_name)(char id) = nullptr;
  const char* (*last_error)() = nullptr;
  void (*sdk_version)(int* major, int* minor, int* release, int* revision) = nullptr;
};

/// The environment variable that names the library's file.
inline constexpr const char* kLibraryVariable = "PALPATE_LIBDHD";

/// The names that are tried, in their order; only `file` where it is not empty.
std::vector<std::string> libraryNames(const std::string& file);

/// Fills in the library's functions; returns the names of functions that are needed and missing.
std::vector<std::string> resolveApi(const SharedLibrary& library, Api& api);

struct Version {
  int major = 0;  ///< 0: unknown
  std::string words;
};
Version readVersion(const Api& api);

/// Published figures of a type of device, used where the library has none.
struct TypeProfile {
  int type;
  const char* model;
  double max_force_n;
  double nominal_stiffness_n_per_mm;
  double reach_mm;                                        ///< radius of the ball that it reaches
  scene::DeviceModel kind = scene::DeviceModel::unknown;  ///< mechanics assumed for it
};
/// Null for a type that is not listed.
const TypeProfile* profileOf(int type);

/// Exchanges a second: two to a tick of the servo, so that neither waits for the other.
inline constexpr double kExchangesPerS = 2000.0;

class Driver {
 public:
  Driver(const Api& api, char index, char id, const DeviceFrame& frame, const OpenOptions& options);
  ~Driver() { releaseDevice(); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  /// One exchange. A device that does not answer for kLostAfter of them is looked for again now and then.
  void exchange() noexcept;

  /// Zero force, forces off, and the library releases the device; nothing is exchanged from then on.
  void releaseDevice() noexcept;

  DriverLink& link() { return *link_; }
  const Capabilities& capabilities() const { return capabilities_; }
  int index() const { return index_; }
  /// Its present fault, in words; empty: none.
  std::string explain() const;

 private:
  void askAbilities(const OpenOptions& options);
  Vec3 velocityAt(const Vec3& place) noexcept;
  std::uint32_t buttons() const noexcept;
  void refused() noexcept;
  void tryReopen() noexcept;

  Api api_;
  char index_;
  char id_;
  DeviceFrame frame_;
  Capabilities capabilities_;
  std::unique_ptr<DriverLink> link_;
  std::atomic<const char*> last_error_{nullptr};  ///< a text of the library's own, which stays
  std::atomic<bool> lost_{false};
  std::atomic<bool> let_go_{false};

  // of the thread that exchanges
  std::uint64_t refusals_ = 0;  ///< one after the other
  Vec3 last_place_ = Vec3::Zero();
  Vec3 speed_ = Vec3::Zero();
  bool has_place_ = false;
};

/// A device, or the reason why not.
struct Opened {
  std::unique_ptr<Driver> driver;
  std::string reason;
  std::string remedy;
};

/// The device of that index, or the first that this program does not hold. Throws Error for axes that are none.
Opened openDriver(const Api& api, const OpenOptions& options);

/// Their number, as the library counts them.
int devicesFound(const Api& api);

}  // namespace palpate::device::forcedimension
