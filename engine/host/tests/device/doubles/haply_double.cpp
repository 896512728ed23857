// A thread accepts, a thread a client serves: pages of HTTP, or a WebSocket after its handshake. Everything waits.
#include "host/tests/device/doubles/haply_double.h"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

namespace palpate::doubles {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Json = nlohmann::json;
using Tcp = asio::ip::tcp;
using Stream = beast::websocket::stream<Tcp::socket>;
using Request = http::request<http::string_body>;

constexpr double kExchangeS = 0.0005;
constexpr double kUnitM = 1.0;
constexpr std::array<const char*, 2> kIds = {"049D", "12AB"};
constexpr std::array<const char*, 2> kHands = {"left", "right"};

struct Service {
  DoubleControl control;
  asio::io_context events;
  Tcp::acceptor door{events, Tcp::endpoint(asio::ip::make_address("127.0.0.1"), 0)};
  std::mutex mutex;
  std::string last_order;
  std::array<std::atomic<const void*>, 2> owners{};  ///< the client that spoke last of a device
};

void serve(Service& self, Tcp::socket socket);

Service& service() {
  static Service* const only = [] {
    auto* made = new Service;  // outlives every thread
    std::thread([made] {
      for (;;) {
        Tcp::socket socket(made->events);
        made->door.accept(socket);
        socket.set_option(Tcp::no_delay(true));
        std::thread([made, guest = std::move(socket)]() mutable { serve(*made, std::move(guest)); }).detach();
      }
    }).detach();
    return made;
  }();
  return *only;
}

bool exists(Service& self, std::size_t i) {
  return static_cast<int>(i) < self.control.count && self.control.devices[i].connected;
}

Json toVectorJson(const std::array<std::atomic<double>, 3>& v) {
  return {{"x", v[0].load()}, {"y", v[1].load()}, {"z", v[2].load()}};
}

Json makeStateJson(DoubleDevice& device) {
  Json state = {{"cursor_position", toVectorJson(device.place)},
                {"cursor_velocity", toVectorJson(device.speed)},
                {"current_cursor_force", toVectorJson(device.force)},
                {"control_domain", "cartesian"}};
  if (device.gives_no_number) state["cursor_position"]["y"] = nullptr;  // how JSON writes what is none
  if (device.error == kWrongTypes) state["cursor_position"] = Json::array({"0.1", true});
  if (device.error == kHuge) state["cursor_position"]["z"] = 1e6;
  return state;
}

bool isOld(Service& self) { return self.control.major == 3 && self.control.minor == 0; }

Json makeStateMessage(Service& self, bool whole) {
  Json devices = isOld(self) ? Json::object() : Json::array();
  Json grips = Json::array();
  for (std::size_t i = 0; i < kIds.size(); ++i) {
    if (!exists(self, i)) continue;
    DoubleDevice& device = self.control.devices[i];
    Json element = {{"device_id", kIds[i]}, {"state", makeStateJson(device)}, {"status", Json::object()}};
    if (device.error == kNoState) element.erase("state");
    if (whole) element["config"] = {{"type", "inverse3"}, {"handedness", kHands[i]}};
    const unsigned pressed = device.buttons;
    const Json buttons = {{"a", (pressed & 1) != 0}, {"b", (pressed & 2) != 0}, {"c", (pressed & 4) != 0}};
    grips.push_back({{"device_id", "F00" + std::to_string(i)}, {"state", {{"buttons", buttons}}}});
    if (isOld(self)) {
      devices[kIds[i]] = element;
    } else {
      devices.push_back(element);
    }
    device.frames = device.frames + 1;
  }
  return {{"session_id", 7}, {"inverse3", devices}, {"wireless_verse_grip", grips}};
}

/// What one client has asked its devices to do; they are idle again when it leaves.
class Client {
 public:
  explicit Client(Service& self) : self_(self) {}
  ~Client() { obey(Json::object()); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// A device that is not spoken of goes idle.
  void obey(const Json& order) {
    std::array<bool, 2> told{};
    for (const Json& element : order.value("inverse3", Json::array())) {
      for (std::size_t i = 0; i < kIds.size(); ++i) {
        if (element.value("device_id", "") == kIds[i] && exists(self_, i)) told[i] = obey(i, element["commands"]);
      }
    }
    for (std::size_t i = 0; i < kIds.size(); ++i) {
      const bool mine = self_.owners[i] == this;
      if (mine && !told[i]) rest(self_.control.devices[i]);
    }
  }

 private:
  bool obey(std::size_t i, const Json& commands) {
    if (!commands.contains("set_cursor_force")) return false;
    const bool old = self_.control.major == 3 && self_.control.minor < 5;
    const Json force = commands["set_cursor_force"].value(old ? "values" : "vector", Json::object());
    DoubleDevice& device = self_.control.devices[i];
    device.open = true;
    self_.owners[i] = this;
    device.force[0] = force.value("x", 0.0);
    device.force[1] = force.value("y", 0.0);
    device.force[2] = force.value("z", 0.0);
    move(device, kExchangeS, kUnitM);
    return true;
  }
  static void rest(DoubleDevice& device) {
    for (auto& force : device.force) force = 0.0;
    device.open = false;
  }

  Service& self_;
};

/// The fault of either device that takes the whole answer.
unsigned deviceFault(Service& self) {
  for (DoubleDevice& device : self.control.devices) {
    if (device.error > kNoState) return device.error;
  }
  return 0;
}

void rest(Service& self) {
  if (self.control.slow_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(self.control.slow_us));
  while (deviceFault(self) == kSilent || (self.control.stands && !self.control.by_hand)) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

std::string faultyText(unsigned fault, const std::string& text) {
  if (fault == kNoJson) return text.substr(0, text.size() / 2);
  if (fault == kTooLong) return R"({"inverse3":[],"padding":")" + std::string(1u << 20, 'x') + "\"}";
  if (fault == kNotANumber) return R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":NaN}}}]})";
  if (fault == kNoDevices) return R"({"error":"device busy"})";
  return text;
}

void converse(Service& self, Stream& stream) {
  Client client(self);
  const std::string snapshot = self.control.refusal == kOddSnapshot ? "hello" : makeStateMessage(self, true).dump();
  stream.write(asio::buffer(snapshot));
  for (;;) {
    beast::flat_buffer buffer;
    stream.read(buffer);
    const std::string order = beast::buffers_to_string(buffer.data());
    client.obey(Json::parse(order));
    {
      const std::lock_guard lock(self.mutex);
      self.last_order = order;
    }
    rest(self);
    const unsigned fault = deviceFault(self);
    if (fault == kCloses) return stream.close(beast::websocket::close_code::going_away);
    stream.write(asio::buffer(faultyText(fault, makeStateMessage(self, false).dump())));
  }
}

void answerPage(Service& self, const Request& request, Tcp::socket& socket) {
  http::response<http::string_body> page(http::status::not_found, 11);
  const bool knows = self.control.refusal != kNoVersion && !request.count(http::field::upgrade);
  if (knows && request.target() == (isOld(self) ? "/3.0/version" : "/version")) {
    page.result(http::status::ok);
    page.body() = Json{
        {"project_version",
         std::to_string(self.control.major) + "." + std::to_string(self.control.minor) +
             ".0.0"}}.dump();
  }
  page.prepare_payload();
  http::write(socket, page);
}

void serve(Service& self, Tcp::socket socket) {
  try {
    if (self.control.refusal == kHangsUp) return;
    beast::flat_buffer buffer;
    Request request;
    http::read(socket, buffer, request);
    if (!beast::websocket::is_upgrade(request) || self.control.refusal == kNoWebSocket) {
      return answerPage(self, request, socket);
    }
    Stream stream(std::move(socket));
    stream.accept(request);
    stream.text(true);
    converse(self, stream);
  } catch (const std::exception&) {  // the client has gone
  }
}

}  // namespace

DoubleControl& haplyControl() { return service().control; }

std::string haplyWords() {
  const std::string port = std::to_string(service().door.local_endpoint().port());
  return "127.0.0.1:" + port + ",http_port=" + port;
}

std::string lastHaplyOrder() {
  const std::lock_guard lock(service().mutex);
  return service().last_order;
}

}  // namespace palpate::doubles
