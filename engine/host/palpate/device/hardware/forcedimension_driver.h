// One Force Dimension device: an exchange reads its position and writes a force, and waits for the bus. So it runs
// outside the servo, on a thread of its own or wherever Device::exchange is called; DriverLink joins the two.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/forcedimension_api.h"

namespace palpate::device::forcedimension {

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

/// The device of that index, or the first that this program does not hold. Throws Error for invalid axes.
Opened openDriver(const Api& api, const OpenOptions& options);

/// Their number, as the library counts them.
int devicesFound(const Api& api);

}  // namespace palpate::device::forcedimension
