// The connection to one service, shared by all of its devices that are held here: an exchange is one message with a
// force for each of them and one answer with the place of each, on a thread outside the servo or by hand.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/detail/driver_thread.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/haply_message.h"

namespace palpate::device::haply {

// Haply's Inverse Service looked for: at which addresses, which version, what devices it has, and why not.

// One WebSocket to Haply's service, and one question by HTTP: every request is answered within a time, or throws.

struct Address {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// "127.0.0.1:10001"
std::string words(const Address& address);

/// Connects and shakes hands; every wait ends after `patience_s`. One thread at a time.
class Connection {
 public:
  /// Throws Error with the system's words.
  Connection(const Address& address, double patience_s);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// The next message; longer ones than kMaxReplyBytes are an error. Throws Error; then the connection is of no use
  /// any more. The text is valid until the next call.
  std::string_view receive();
  /// Throws Error likewise.
  void send(std::string_view text);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The body of the answer to GET `path`, if it was 200. Throws Error.
std::string httpGet(const Address& address, const std::string& path, double patience_s);

/// The environment variable with the service's address and options.
inline constexpr const char* kServiceVariable = "PALPATE_HAPLY";

/// Ports of a service of 3.1 or newer, and of one of 3.0.
inline constexpr int kPort = 10001;
inline constexpr int kOldPort = 10000;

struct Settings {
  std::string words;  ///< the text that they came from
  std::vector<Address> addresses = {{"127.0.0.1", kPort}, {"127.0.0.1", kOldPort}};
  int http_port = 0;  ///< 0: that of the address, then kOldPort
  ForceKey force_key = ForceKey::automatic;
  /// The maker gives no figure for the motors' force.
  double most_force_n = 5.0;
};

/// "HOST:PORT,force_key=auto|vector|values,most_force_n=N,http_port=PORT", any part of it; `said` where it is not
/// empty, else the environment's, else the usual. Throws Error for anything else.
Settings settingsOf(const std::string& said);

/// A service that has answered.
struct Service {
  std::unique_ptr<Connection> connection;  ///< null: none, and the probe says why
  Version version;
  ForceKey force_key = ForceKey::vector;
  Reply snapshot;
};

/// Connects to the first address that answers, requests the version and takes the snapshot. Every step is in the
/// probe's looked_for, the first that fails in its reason and remedy.
Service findService(const Settings& settings, const std::filesystem::path& system_root, Probe& probe);

/// Exchanges a second: two to a tick of the servo, so that neither waits for the other.
inline constexpr double kExchangesPerS = 2000.0;

/// One device. Members without a remark are the session's, in its turns.
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

using Added = SlotOrReason<Slot>;

class Session {
 public:
  explicit Session(Settings settings) : settings_(std::move(settings)) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The device of that id or hand, or the first that is not held. Throws Error for invalid axes.
  Added add(const OpenOptions& options);
  /// Zero force, then none: the service lets the device become idle. The last one closes the connection.
  void release(const std::shared_ptr<Slot>& slot);
  /// For a session without a thread: an exchange, if this is the device that was opened first. It serves all of them.
  void exchangeByHand(const Slot& slot);
  /// Connects again where the connection was lost; true when the device is there.
  bool revive(const Slot& slot);
  /// Its present fault, in words; empty: none.
  std::string explain(const Slot& slot);

 private:
  void exchange() noexcept;
  void exchangeInTurn() noexcept;
  void exchangeWithService();
  void publishReply(Slot& slot, const Reply& reply, bool late);
  void publishTrouble(Slot& slot, const std::string& trouble) noexcept;
  void setTrouble(Slot& slot, const std::string& trouble);
  Added choose(const Service& service, const OpenOptions& options);
  bool isHeld(const std::string& id) const;
  void adopt(Service service);

  Settings settings_;
  std::mutex mutex_;  ///< guards add, release and revive
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
std::string describeModel(const DeviceReply& device);

/// Reports why the service lacks a device of that name, and the remedy.
Added explainMissingDevice(const Service& service, const std::string& which);

/// The session of these settings, shared by all devices that are open.
std::shared_ptr<Session> sharedSession(const Settings& settings);

}  // namespace palpate::device::haply
