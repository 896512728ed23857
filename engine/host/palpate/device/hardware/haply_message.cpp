// Text that does not parse is refused. Every number is checked before it is believed.
// A force is written with all its digits, so that the service gets no more than the limit.
#include "palpate/device/hardware/haply_message.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::device::haply {

namespace {

constexpr double kMaxSpeedMS = 100.0;
constexpr const char* kNoForm = "the service's answer is not JSON";

/// The member of an object; null if missing, or if it is not an object.
const Json& findMember(const Json& object, const char* name) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

std::string textOf(const Json& value) { return value.is_string() ? oneLine(value.text()) : ""; }

/// Three finite numbers of at most that size.
std::optional<Vec3> parseVector(const Json& value, double most) {
  Vec3 vector;
  int axis = 0;
  for (const char* name : {"x", "y", "z"}) {
    const Json& number = findMember(value, name);
    if (!number.is_number()) return std::nullopt;
    vector[axis] = number.get<double>();
    if (!(std::abs(vector[axis]) <= most)) return std::nullopt;
    ++axis;
  }
  return vector;
}

std::uint32_t parseButtons(const Json& grip) {
  const Json& buttons = findMember(findMember(grip, "state"), "buttons");
  std::uint32_t bits = 0;
  std::uint32_t bit = 1;
  for (const char* name : {"a", "b", "c"}) {
    const Json& button = findMember(buttons, name);
    if (button.is_boolean() && button.get<bool>()) bits |= bit;
    bit <<= 1;
  }
  return bits;
}

DeviceReply parseDevice(const std::string& id, const Json& element) {
  DeviceReply device;
  device.id = id;
  const Json& config = findMember(element, "config");
  device.type = textOf(findMember(config, "type"));
  device.handedness = textOf(findMember(config, "handedness"));
  const Json& state = findMember(element, "state");
  device.has_state = state.is_object();
  device.place_m = parseVector(findMember(state, "cursor_position"), kMaxReachM);
  device.speed_m_s = parseVector(findMember(state, "cursor_velocity"), kMaxSpeedMS).value_or(Vec3::Zero());
  return device;
}

/// An id that another message could not carry back is invalid.
bool isId(const std::string& id) {
  const auto plain = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !id.empty() && id.size() <= 32 && std::all_of(id.begin(), id.end(), plain);
}

/// A list of devices that name themselves, or an object of devices by their ids, which come sorted.
void readDevices(const Json& list, Reply& reply) {
  std::vector<std::pair<std::string, const Json*>> devices;
  if (list.is_object()) {
    for (const auto& [id, element] : list.items()) devices.emplace_back(id, &element);
    std::sort(devices.begin(), devices.end());
  } else {
    for (const Json& element : list) devices.emplace_back(textOf(findMember(element, "device_id")), &element);
  }
  for (const auto& [id, element] : devices) {
    if (isId(id)) reply.devices.push_back(parseDevice(id, *element));
    if (reply.devices.size() == kMaxDevices) return;
  }
}

std::string forceText(const Vec3& force, ForceKey key) {
  return fmt::format(R"("set_cursor_force":{{"{}":{{"x":{},"y":{},"z":{}}}}})",
                     key == ForceKey::values ? "values" : "vector", force.x(), force.y(), force.z());
}

std::string elementText(const DeviceOrder& order, ForceKey key) {
  const char* configure = order.configure ? R"("configure":{"preset":"arm_front_centered"},)" : "";
  return fmt::format(R"({{"device_id":"{}",{}"commands":{{{}}}}})", order.id, configure,
                     order.probe ? R"("probe_position":{})" : forceText(order.force_n, key));
}

/// The number before the next point; the text continues behind it.
int nextPart(std::string_view& words) {
  const std::size_t point = std::min(words.find('.'), words.size());
  const std::optional<double> part = parseNumber(words.substr(0, point));
  words.remove_prefix(std::min(point + 1, words.size()));
  return part && *part >= 0.0 && *part < 1e6 ? static_cast<int>(*part) : 0;
}

}  // namespace

Reply parseReply(std::string_view text) {
  Reply reply;
  reply.wrong = kNoForm;
  if (text.size() > kMaxReplyBytes) return reply;
  const Json json = Json::tryParse(text);
  if (!json.is_object()) return reply;
  const Json& list = findMember(json, "inverse3");
  if (!list.is_array() && !list.is_object()) {
    const std::string words = textOf(findMember(json, "error"));
    reply.wrong = "the service's answer has no devices" + (words.empty() ? "" : ": " + words);
    return reply;
  }
  reply.wrong.clear();
  readDevices(list, reply);
  const Json& grips = findMember(json, "wireless_verse_grip");
  for (std::size_t i = 0; grips.is_array() && i < std::min(grips.size(), reply.devices.size()); ++i) {
    reply.devices[i].buttons = parseButtons(grips[i]);
  }
  return reply;
}

Version parseVersion(std::string_view text) {
  Version version;
  if (text.size() > kMaxReplyBytes) return version;
  version.words = textOf(findMember(Json::tryParse(text), "project_version"));
  std::string_view words = version.words;
  version.major = nextPart(words);
  version.minor = nextPart(words);
  return version;
}

ForceKey chooseForceKey(ForceKey wanted, const Version& version, bool old_port) {
  if (wanted != ForceKey::automatic) return wanted;
  if (version.major == 0) return old_port ? ForceKey::values : ForceKey::vector;
  return version.major == 3 && version.minor < 5 ? ForceKey::values : ForceKey::vector;
}

std::string orderText(std::span<const DeviceOrder> orders, const OrderForm& form) {
  std::string text = "{";
  if (form.introduce) text += R"("session":{"configure":{"profile":{"name":"palpate"}}},)";
  text += R"("inverse3":[)";
  for (const DeviceOrder& order : orders) {
    if (text.back() == '}') text += ',';
    text += elementText(order, form.key);
  }
  return text + "]}";
}

}  // namespace palpate::device::haply
