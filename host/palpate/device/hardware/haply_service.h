// Haply's Inverse Service looked for: at which addresses, which version, what devices it has, and why not.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/hardware/haply_connection.h"
#include "palpate/device/hardware/haply_message.h"

namespace palpate::device::haply {

/// The environment variable that says where the service is, and how to speak to it.
inline constexpr const char* kServiceVariable = "PALPATE_HAPLY";

/// Of a service of 3.1 or newer, and of one of 3.0.
inline constexpr int kPort = 10001;
inline constexpr int kOldPort = 10000;

struct Settings {
  std::string words;  ///< that they came from
  std::vector<Address> addresses = {{"127.0.0.1", kPort}, {"127.0.0.1", kOldPort}};
  int http_port = 0;  ///< 0: that of the address, then kOldPort
  ForceKey force_key = ForceKey::automatic;
  /// No maker's figure is at hand for what the motors hold.
  double most_force_n = 5.0;
};

/// "HOST:PORT,force_key=auto|vector|values,most_force_n=N,http_port=PORT", any part of it; `said` where it is not
/// empty, else what the environment says, else the usual. Throws Error for what is none of it.
Settings settingsOf(const std::string& said);

/// A service that has answered.
struct Service {
  std::unique_ptr<Connection> connection;  ///< null: none, and the probe says why
  Version version;
  ForceKey force_key = ForceKey::vector;
  Reply snapshot;
};

/// Connects to the first address that answers, asks for the version and takes the snapshot. Every step is in the
/// probe's looked_for, the first that fails in its reason and remedy.
Service findService(const Settings& settings, const std::filesystem::path& system_root, Probe& probe);

}  // namespace palpate::device::haply
