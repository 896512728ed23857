// recvfrom until nothing waits, the newest good pose counts; sendto whoever that came from. Numbers by std::from_chars
// and fmt::format_to_n, which know no locale and take no memory. Own.
#include "palpate/device/remote_device.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <memory>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/device/trajectory.h"

namespace palpate::device {

namespace {

/// A flood of messages must not keep a tick from ending.
constexpr int kMostMessagesATick = 32;

constexpr const char* kLoopback = "127.0.0.1";

std::string_view nextWord(std::string_view& text) noexcept {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return text = {};
  const std::size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

template <class Number>
bool readNumber(std::string_view word, Number& value) noexcept {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

struct Listen {
  std::string address = kLoopback;
  int port = kRemotePort;
};

/// "4730", "0.0.0.0:4730" -> where to listen. Throws Error.
Listen listenAt(const std::string& which) {
  Listen listen;
  std::string port = which;
  if (const std::size_t colon = which.rfind(':'); colon != std::string::npos) {
    listen.address = which.substr(0, colon);
    port = which.substr(colon + 1);
  }
  if (port.empty()) return listen;
  const std::optional<double> number = parseNumber(port);
  if (!number || *number < 1.0 || *number > 65535.0 || *number != std::floor(*number)) {
    throw Error(fmt::format("remote: '{}' is no port, which is 1 to 65535", oneLine(port)));
  }
  listen.port = static_cast<int>(*number);
  return listen;
}

/// An open socket that does not wait.
class Socket {
 public:
  explicit Socket(const Listen& listen) : file_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    if (file_ < 0) refuse("no socket", listen);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(listen.port));
    if (::inet_pton(AF_INET, listen.address.c_str(), &address.sin_addr) != 1) {
      ::close(file_);
      throw Error(fmt::format("remote: '{}' is no IPv4 address", oneLine(listen.address)));
    }
    if (::bind(file_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
      refuse("cannot listen", listen);
  }
  ~Socket() { ::close(file_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int file() const noexcept { return file_; }

 private:
  [[noreturn]] void refuse(const char* what, const Listen& listen) const {
    const std::string why = std::generic_category().message(errno);
    if (file_ >= 0) ::close(file_);
    throw Error(fmt::format("remote: {} at {}:{}: {}; another program may listen there: say remote:PORT", what,
                            listen.address, listen.port, why));
  }
  int file_;
};

/// What the servo's thread keeps of its clients. Counts are for `explain`, on another.
class Remote {
 public:
  Remote(const Listen& listen, const OpenOptions& options)
      : socket_(listen), listen_(listen), origin_mm_(options.origin_mm), scale_(options.scale) {}

  Vec3 read(std::uint64_t tick) noexcept {
    if (closed_.load(std::memory_order_relaxed)) {
      state_.faults = kClosed;
      return kNoPlace;
    }
    if (receive()) last_tick_ = tick;
    state_.age_ticks = tick > last_tick_ ? tick - last_tick_ : 0;
    state_.faults = !has_client_ ? kNoPose : state_.age_ticks > kMostSilentTicks ? kStalePose : 0u;
    faults_.store(state_.faults, std::memory_order_relaxed);
    return state_.faults == 0 ? Vec3(origin_mm_ + scale_ * pose_.tip_mm) : kNoPlace;
  }

  void write(const Vec3& force) noexcept {
    if (!has_client_ || closed_.load(std::memory_order_relaxed)) return;
    send(state_.faults == 0 && force.allFinite() ? force : Vec3::Zero());
  }

  const DeviceState& state() const noexcept { return state_; }

  void close() noexcept {
    if (closed_.exchange(true) || !has_client_) return;
    send(Vec3::Zero());
  }

  std::string explain() const {
    const std::uint32_t faults = faults_.load(std::memory_order_relaxed);
    const std::uint64_t refused = refused_.load(std::memory_order_relaxed);
    std::string text;
    if (faults == kNoPose) text = fmt::format("nobody has sent a position to {}:{} yet", listen_.address, listen_.port);
    if (faults == kStalePose) text = "the client has fallen silent";
    if (refused > 0) {
      text += fmt::format("{}{} messages were not \"p x y z\"", text.empty() ? "" : "; ", refused);
    }
    return text;
  }

 private:
  /// True when a good pose came.
  bool receive() noexcept {
    bool came = false;
    std::array<char, kMostMessageBytes + 1> message;
    for (int i = 0; i < kMostMessagesATick; ++i) {
      sockaddr_in from{};
      socklen_t length = sizeof(from);
      const ssize_t bytes =
          ::recvfrom(socket_.file(), message.data(), message.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
      if (bytes < 0) break;  // nothing waits, or an earlier answer found nobody
      const auto size = static_cast<std::size_t>(bytes);
      const std::optional<RemotePose> pose =
          size > kMostMessageBytes ? std::nullopt : parsePose({message.data(), size});
      if (!pose) {
        refused_.fetch_add(1, std::memory_order_relaxed);
        continue;
      }
      pose_ = *pose;
      client_ = from;
      has_client_ = came = true;
    }
    state_.buttons = pose_.buttons;
    return came;
  }

  void send(const Vec3& force) noexcept {
    std::array<char, 128> text;
    const auto end =
        fmt::format_to_n(text.data(), text.size(), "f {:.6f} {:.6f} {:.6f}\n", force.x(), force.y(), force.z());
    (void)::sendto(socket_.file(), text.data(), std::min(end.size, text.size()), MSG_DONTWAIT | MSG_NOSIGNAL,
                   reinterpret_cast<const sockaddr*>(&client_), sizeof(client_));
  }

  Socket socket_;
  Listen listen_;
  Vec3 origin_mm_;
  double scale_;
  DeviceState state_{.faults = kNoPose};
  RemotePose pose_;
  sockaddr_in client_{};
  bool has_client_ = false;
  std::uint64_t last_tick_ = 0;
  std::atomic<std::uint32_t> faults_{kNoPose};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace

std::optional<RemotePose> parsePose(std::string_view message) noexcept {
  if (nextWord(message) != "p") return std::nullopt;
  RemotePose pose;
  for (int axis = 0; axis < 3; ++axis) {
    double& value = pose.tip_mm[axis];
    if (!readNumber(nextWord(message), value) || !(std::abs(value) <= kMaxCoordinateMm)) return std::nullopt;
  }
  const std::string_view buttons = nextWord(message);
  if (!buttons.empty() && !readNumber(buttons, pose.buttons)) return std::nullopt;
  if (!nextWord(message).empty()) return std::nullopt;
  return pose;
}

Probe probeRemote(const OpenOptions& options) {
  Probe probe;
  try {
    const Listen listen = listenAt(options.which);
    const Socket socket(listen);
    probe.available = true;
    probe.devices.push_back(fmt::format("any program that sends to {}:{}", listen.address, listen.port));
  } catch (const Error& error) {
    probe.reason = error.what();
    probe.remedy = "say another port: remote:PORT (docs/remote.md)";
  }
  return probe;
}

Device openRemote(const OpenOptions& options) {
  const auto remote = std::make_shared<Remote>(listenAt(options.which), options);
  Device device;
  device.name = options.which.empty() ? "remote" : "remote:" + options.which;
  device.capabilities.takes_force = true;
  device.capabilities.delay_ticks = 1;
  device.capabilities.rhythm = Rhythm::self_paced;
  device.read_tip = [remote](std::uint64_t tick) { return remote->read(tick); };
  device.write_force = [remote](const Vec3& force) { remote->write(force); };
  device.state = [remote] { return remote->state(); };
  device.explain = [remote] { return remote->explain(); };
  device.close = [remote] { remote->close(); };
  return device;
}

}  // namespace palpate::device
