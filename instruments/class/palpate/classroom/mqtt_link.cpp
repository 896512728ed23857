#include "palpate/classroom/mqtt_link.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <netdb.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"

namespace palpate::classroom {

namespace {

constexpr std::chrono::milliseconds kFirstPause(500);
constexpr std::chrono::milliseconds kLongestPause(8000);
/// A connection that lasted as long was a good one. A certificate is one connection (use_username_as_clientid): two
/// programs with the same would else throw each other out twice a second.
constexpr double kSteadyS = 10.0;
constexpr const char* kTakenOver =
    "the connection was ended; another program may use this certificate, and each needs its own";
constexpr int kLoopMs = 200;    // delay of its end; messages wake it at once
constexpr int kReachMs = 2000;  // a computer of the same room answers sooner
constexpr double kLongestGoodbyeS = 1.0;
constexpr int kMaxPacket = 1 << 20;  // bytes: nothing of a class is longer

/// Once for the program, for as long as it runs: links of other threads may still be ending at its end.
void startLibrary() {
  static const int started = mosquitto_lib_init();
  static_cast<void>(started);
}

/// Whether a server answers there. The library's own attempt would block the thread for minutes where none does.
bool isServerReachable(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return false;
  bool answers = false;
  for (const addrinfo* place = found; place != nullptr && !answers; place = place->ai_next) {
    const int handle = socket(place->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (handle < 0) continue;
    answers = connect(handle, place->ai_addr, place->ai_addrlen) == 0;
    if (!answers && errno == EINPROGRESS) {
      pollfd waiting{handle, POLLOUT, 0};
      int fault = 0;
      socklen_t size = sizeof(fault);
      answers = poll(&waiting, 1, kReachMs) == 1 && getsockopt(handle, SOL_SOCKET, SO_ERROR, &fault, &size) == 0 &&
                fault == 0;
    }
    close(handle);
  }
  freeaddrinfo(found);
  return answers;
}

std::string explainMqttError(int code) {
  if (code == MOSQ_ERR_TLS) return "the broker's certificate is not of this class, or it does not accept this one";
  return mosquitto_strerror(code);
}

/// The properties of one call, given back after it.
class Properties {
 public:
  Properties() = default;
  ~Properties() { mosquitto_property_free_all(&list_); }
  Properties(const Properties&) = delete;
  Properties& operator=(const Properties&) = delete;
  void add(int name, std::uint32_t value) { mosquitto_property_add_int32(&list_, name, value); }
  const mosquitto_property* list() const { return list_; }

 private:
  mosquitto_property* list_ = nullptr;
};

}  // namespace

struct MqttLink::Impl {
  Impl(const MqttSettings& link_settings, MqttHandlers link_handlers)
      : settings(link_settings), handlers(std::move(link_handlers)) {
    startLibrary();
    client = mosquitto_new(settings.client_id.c_str(), settings.session_expiry_s == 0, this);
    if (client == nullptr) throw Error("broker: cannot create a connection (out of memory, or an invalid client id)");
    try {
      prepare();
    } catch (...) {
      mosquitto_destroy(client);
      throw;
    }
    thread = std::thread([this] { run(); });
  }
  ~Impl() {
    // Gives the last messages, a goodbye among them, a moment to leave.
    const auto until = Clock::now() + std::chrono::duration<double>(kLongestGoodbyeS);
    while (is_connected && under_way > 0 && Clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    woken.notify_all();
    if (is_connected) mosquitto_disconnect_v5(client, MQTT_RC_NORMAL_DISCONNECTION, nullptr);
    thread.join();
    mosquitto_destroy(client);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void prepare() {
    mosquitto_threaded_set(client, true);
    mosquitto_int_option(client, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V5);
    mosquitto_int_option(client, MOSQ_OPT_TCP_NODELAY, 1);
    const bool has_certificate = !settings.certificate.empty();
    const int code = mosquitto_tls_set(client, settings.authority.c_str(), nullptr,
                                       has_certificate ? settings.certificate.c_str() : nullptr,
                                       has_certificate ? settings.key.c_str() : nullptr, nullptr);
    if (code != MOSQ_ERR_SUCCESS) {
      throw Error::inFile((has_certificate ? settings.certificate : settings.authority).string(),
                          fmt::format("cannot be used for a connection: {}", mosquitto_strerror(code)));
    }
    mosquitto_tls_opts_set(client, SSL_VERIFY_PEER, nullptr, nullptr);
    if (settings.will) {
      const OutMessage& will = *settings.will;
      mosquitto_will_set_v5(client, will.topic.c_str(), static_cast<int>(will.payload.size()), will.payload.data(),
                            will.quality, will.retained, nullptr);
    }
    mosquitto_connect_v5_callback_set(client, &Impl::connectedCallback);
    mosquitto_disconnect_v5_callback_set(client, &Impl::disconnectedCallback);
    mosquitto_publish_v5_callback_set(client, &Impl::publishedCallback);
    mosquitto_subscribe_v5_callback_set(client, &Impl::subscribedCallback);
    mosquitto_message_v5_callback_set(client, &Impl::messageCallback);
  }

  static Impl& of(void* self) { return *static_cast<Impl*>(self); }
  static void connectedCallback(mosquitto* /*client*/, void* self, int code, int /*flags*/,
                                const mosquitto_property* /*list*/) {
    of(self).connectedWith(code);
  }
  static void disconnectedCallback(mosquitto* /*client*/, void* self, int code, const mosquitto_property* /*list*/) {
    of(self).lost(code);
  }
  static void publishedCallback(mosquitto* /*client*/, void* self, int /*message*/, int reason,
                                const mosquitto_property* /*list*/) {
    Impl& course = of(self);
    if (course.under_way > 0) --course.under_way;
    if (reason >= kFirstRefusal) ++course.refused;
  }
  static void subscribedCallback(mosquitto* /*client*/, void* self, int /*message*/, int count, const int* granted,
                                 const mosquitto_property* /*list*/) {
    of(self).refused += static_cast<std::uint64_t>(
        std::count_if(granted, granted + count, [](int quality) { return quality >= kFirstRefusal; }));
  }
  static void messageCallback(mosquitto* /*client*/, void* self, const mosquitto_message* message,
                              const mosquitto_property* /*list*/) {
    const Impl& course = of(self);
    if (!course.handlers.on_message || message->payloadlen < 0 || message->payloadlen > kMaxPacket) return;
    course.handlers.on_message(
        message->topic, {static_cast<const char*>(message->payload), static_cast<std::size_t>(message->payloadlen)});
  }

  void connectedWith(int code) {
    if (code != 0) return lost(code);
    under_way = 0;
    for (const Subscription& wanted : settings.subscriptions) {
      mosquitto_subscribe_v5(client, nullptr, wanted.topic.c_str(), wanted.quality, 0, nullptr);
    }
    is_connected = true;
    connected_at = Clock::now();
    say({});
    if (handlers.on_connected) handlers.on_connected();
  }
  void lost(int code) {
    is_connected = false;
    if (code == MQTT_RC_SESSION_TAKEN_OVER) return say(kTakenOver);  // mosquitto 2.0.11 only hangs up
    say(code == 0               ? "the connection ended"
        : code >= kFirstRefusal ? mosquitto_reason_string(code)
                                : explainMqttError(code));
  }
  void say(const std::string& what) {
    const std::lock_guard lock(mutex);
    trouble = what;
  }

  int connectNow() {
    if (!isServerReachable(settings.host, settings.port)) {
      say(fmt::format("no broker answers at {}:{}", settings.host, settings.port));
      return MOSQ_ERR_ERRNO;
    }
    Properties properties;
    if (settings.session_expiry_s > 0) properties.add(MQTT_PROP_SESSION_EXPIRY_INTERVAL, settings.session_expiry_s);
    properties.add(MQTT_PROP_MAXIMUM_PACKET_SIZE, kMaxPacket);
    const int code = mosquitto_connect_bind_v5(client, settings.host.c_str(), settings.port, settings.keep_alive_s,
                                               nullptr, properties.list());
    if (code != MOSQ_ERR_SUCCESS) say(explainMqttError(code));
    return code;
  }

  /// Connects, and stays until the connection is lost.
  void runConnection() {
    int code = connectNow();
    while (code == MOSQ_ERR_SUCCESS && !isEnding()) code = mosquitto_loop(client, kLoopMs, 1);
    const bool was_connected = is_connected.exchange(false);
    if (const auto since = std::exchange(connected_at, {})) {
      if (secondsSince(*since) >= kSteadyS) {
        pause = kFirstPause;
      } else if (code == MOSQ_ERR_CONN_LOST || code == MOSQ_ERR_NO_CONN || code == MOSQ_ERR_TLS) {
        return say(kTakenOver);
      }
    }
    if (code != MOSQ_ERR_SUCCESS && (was_connected || code == MOSQ_ERR_TLS)) say(explainMqttError(code));
  }
  bool isEnding() {
    const std::lock_guard lock(mutex);
    return ending;
  }
  void run() {
    for (;;) {
      runConnection();
      std::unique_lock lock(mutex);
      if (woken.wait_for(lock, pause, [this] { return ending; })) return;
      pause = std::min(2 * pause, kLongestPause);
    }
  }

  static constexpr int kFirstRefusal = 128;  // MQTT 5: reason codes from here on are failures

  const MqttSettings settings;
  const MqttHandlers handlers;
  mosquitto* client = nullptr;
  std::atomic<bool> is_connected = false;
  std::atomic<int> under_way = 0;
  std::atomic<std::uint64_t> refused = 0;
  std::chrono::milliseconds pause = kFirstPause;  ///< before the next attempt; the link's thread alone
  std::optional<Clock::time_point> connected_at;  ///< the link's thread alone
  mutable std::mutex mutex;
  std::condition_variable woken;
  bool ending = false;
  std::string trouble = "not connected yet";
  std::thread thread;
};

MqttSettings makeMqttSettings(const Member& member) {
  MqttSettings settings;
  settings.host = member.host;
  settings.port = member.port;
  settings.authority = member.authority;
  settings.certificate = member.certificate;
  settings.key = member.key;
  settings.client_id = fmt::format("palpate-{}-{}", member.class_id, member.name);
  return settings;
}

MqttLink::MqttLink(const MqttSettings& settings, MqttHandlers handlers)
    : impl_(std::make_unique<Impl>(settings, std::move(handlers))) {}
MqttLink::~MqttLink() = default;

bool MqttLink::publish(const OutMessage& message) {
  if (!impl_->is_connected || impl_->under_way >= kMaxUnderWay) return false;
  Properties properties;
  if (message.expiry_s > 0) properties.add(MQTT_PROP_MESSAGE_EXPIRY_INTERVAL, message.expiry_s);
  ++impl_->under_way;
  const int code =
      mosquitto_publish_v5(impl_->client, nullptr, message.topic.c_str(), static_cast<int>(message.payload.size()),
                           message.payload.data(), message.quality, message.retained, properties.list());
  if (code != MOSQ_ERR_SUCCESS) --impl_->under_way;
  return code == MOSQ_ERR_SUCCESS;
}

bool MqttLink::connected() const { return impl_->is_connected; }

std::string MqttLink::trouble() const {
  if (impl_->is_connected) return {};
  const std::lock_guard lock(impl_->mutex);
  return impl_->trouble;
}

std::uint64_t MqttLink::refused() const { return impl_->refused; }

}  // namespace palpate::classroom
