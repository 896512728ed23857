// Messages of Haply's service: texts of JSON <-> places, forces, versions. Pure functions; texts are not trusted.
// Metres, newtons; +x right, +y away from the operator, +z up.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::device::haply {

/// A longer message is refused before it is read: a whole snapshot of several devices has a few thousand bytes.
inline constexpr std::size_t kMaxReplyBytes = 1u << 18;

/// No arm is longer, m: a place farther away is invalid.
inline constexpr double kMaxReachM = 10.0;

inline constexpr std::size_t kMaxDevices = 16;

/// One device in a message of the service.
struct DeviceReply {
  std::string id;          ///< "049D"
  std::string type;        ///< "inverse3", "minverse"; only in a snapshot
  std::string handedness;  ///< "left", "right"; only in a snapshot
  bool has_state = false;
  std::optional<Vec3> place_m;    ///< nothing where it is missing, no number or too far
  Vec3 speed_m_s = Vec3::Zero();  ///< likewise zero
  std::uint32_t buttons = 0;      ///< buttons of the grip at the same place of its list
};

struct Reply {
  std::vector<DeviceReply> devices;
  std::string wrong;  ///< why this is not a message of the service; empty if it is
};

/// Any text at all. Devices come as a list with `device_id`, or (3.0) as an object keyed by it.
Reply parseReply(std::string_view text);

struct Version {
  int major = 0;  ///< 0: not known
  int minor = 0;
  std::string words;
};

/// Version in the answer to GET /version: {"project_version": "3.5.0.0"}.
Version parseVersion(std::string_view text);

/// Name of a force in a message.
enum class ForceKey : std::uint8_t {
  automatic,  ///< by the version of the service
  vector,     ///< 3.5
  values,     ///< before
};

ForceKey chooseForceKey(ForceKey wanted, const Version& version, bool old_port);

/// Orders for one device in one message.
struct DeviceOrder {
  std::string_view id;
  Vec3 force_n = Vec3::Zero();
  bool configure = false;  ///< moves its origin to the middle of its reach
  bool probe = false;      ///< no force at all: the service lets it become idle
};

struct OrderForm {
  ForceKey key = ForceKey::vector;
  bool introduce = false;  ///< this program's name, once a connection
};

/// The message of one exchange.
std::string orderText(std::span<const DeviceOrder> orders, const OrderForm& form);

}  // namespace palpate::device::haply
