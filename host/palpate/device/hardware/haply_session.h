// The connection to one service, shared by all of its devices that are held here: an exchange is one message with a
// force for each of them and one answer with the place of each, on a thread beside the servo or by hand.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/detail/driver_thread.h"
#include "palpate/device/detail/turns.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/haply_service.h"

namespace palpate::device::haply {

/// Exchanges a second: two to a tick of the servo, so that neither waits for the other.
inline constexpr double kExchangesPerS = 2000.0;

/// One device. What has no other remark is the session's, in its turns.
struct Slot {
  Slot(const DriverLinkSettings& settings, const DeviceFrame& place) : frame(place), link(settings) {}

  std::string id;
  DeviceFrame frame;
  Capabilities capabilities;
  DriverLink link;
  bool listed = true;       ///< the service's last answer had it
  bool configured = false;  ///< since it was listed
  bool leaving = false;
  std::string trouble;  ///< guarded by the session's words_mutex_
};

/// A device, or why there is none.
struct Added {
  std::shared_ptr<Slot> slot;
  std::string reason;
  std::string remedy;
};

class Session {
 public:
  explicit Session(Settings settings) : settings_(std::move(settings)) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The device of that id or hand, or the first that is not held. Throws Error for axes that are none.
  Added add(const OpenOptions& options);
  /// Zero force, then none: the service lets the device go idle. The last one closes the connection.
  void release(const std::shared_ptr<Slot>& slot);
  /// Of a session without a thread: an exchange, if this is the device that was opened first. It serves all of them.
  void exchangeByHand(const Slot& slot);
  /// Connects again where the connection was lost; true when the device is there.
  bool revive(const Slot& slot);
  /// What is wrong with it now, in words; empty: nothing.
  std::string explain(const Slot& slot);

 private:
  void exchange() noexcept;
  void exchangeInTurn() noexcept;
  void askAndTell();
  void tell(Slot& slot, const Reply& reply, bool late);
  void tellTrouble(Slot& slot, const std::string& trouble) noexcept;
  void setTrouble(Slot& slot, const std::string& trouble);
  Added choose(const Service& service, const OpenOptions& options);
  bool isHeld(const std::string& id) const;
  void adopt(Service service);

  Settings settings_;
  std::mutex mutex_;  ///< of add, release and revive
  std::unique_ptr<DriverThread> thread_;

  Turns turns_;
  std::vector<std::shared_ptr<Slot>> slots_;
  std::unique_ptr<Connection> connection_;
  ForceKey force_key_ = ForceKey::vector;
  bool introduced_ = false;
  double tick_s_ = 0.001;
  bool by_clock_ = false;

  std::mutex words_mutex_;
};

/// "Inverse3 049D, right"
std::string modelOf(const DeviceReply& device);

/// Why the service has no device of that name, and what mends it.
Added whyNoneOf(const Service& service, const std::string& which);

/// The session of these settings, shared by all devices that are open.
std::shared_ptr<Session> sessionOf(const Settings& settings);

}  // namespace palpate::device::haply
