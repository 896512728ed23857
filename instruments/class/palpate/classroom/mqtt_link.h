// A connection to a class's broker: MQTT 5 over TLS with a certificate, kept up automatically. Thin on purpose: what
// may be lost, must not be lost and is resent is decided by those who use it (station_link.h, collector.h).
//
//   publish ─► a limited number in flight ─► broker        broker ─► on_message, in the link's own thread
//
// Based on: libmosquitto, the client library of Eclipse Mosquitto; its names do not leave mqtt_link.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/classroom/class_settings.h"

namespace palpate::classroom {

struct OutMessage {
  std::string topic;
  std::string payload;
  int quality = 1;  ///< 0: at most once; 1: at least once, as far as the broker
  bool retained = false;
  std::uint32_t expiry_s = 0;  ///< the broker forgets it then; 0: never
};

struct Subscription {
  std::string topic;  ///< with + and # as MQTT has them
  int quality = 1;
};

struct MqttSettings {
  std::string host = "localhost";
  int port = kStandardPort;
  std::filesystem::path authority;
  std::filesystem::path certificate;  ///< with `key`; empty: none is shown, for tests and checks
  std::filesystem::path key;
  std::string client_id;
  /// The broker keeps what comes while this client is away; 0: nothing.
  std::uint32_t session_expiry_s = 0;
  int keep_alive_s = 10;  ///< half as long again without a word, and the broker publishes the last will
  std::optional<OutMessage> will;
  std::vector<Subscription> subscriptions;
};
/// Connects as this member, without subscriptions.
MqttSettings makeMqttSettings(const Member& member);

/// Called in the link's thread; they may publish, and must be quick.
struct MqttHandlers {
  std::function<void(std::string_view topic, std::string_view payload)> on_message;
  std::function<void()> on_connected;  ///< each time, after subscribing
};

class MqttLink {
 public:
  /// Returns at once and connects automatically, again and again, 0.5 to 8 s apart: the longer, the shorter its
  /// connections last, as where another program uses the same certificate. Throws Error for certificates that cannot be
  /// used.
  MqttLink(const MqttSettings& settings, MqttHandlers handlers);
  /// Ends in order: waiting messages go out first, for at most this long.
  ~MqttLink();
  MqttLink(const MqttLink&) = delete;
  MqttLink& operator=(const MqttLink&) = delete;

  // Any thread; none of these waits.
  /// False: not connected, or too much is on its way already; nothing was taken.
  bool publish(const OutMessage& message);
  bool connected() const;
  /// Why it is not connected, in words; empty: it is.
  std::string trouble() const;
  /// Messages and subscriptions that the broker would not have from this certificate.
  std::uint64_t refused() const;

  /// Messages that may be on their way to the broker: a slow network must not fill the memory.
  static constexpr int kMaxUnderWay = 2000;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::classroom
