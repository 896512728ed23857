// Receives until nothing waits, the newest good pose counts; sends to the finger's holder.
#include "palpate/device/detail/remote_device.h"
#include "palpate/device/detail/remote_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/device/detail/remote_socket.h"

namespace palpate::device {

namespace {

constexpr const char* kWho = "remote";

SocketAddress listenAt(const std::string& which) {
  return parseSocketAddress(which, {.address = kRemoteAddress, .port = kRemotePort}, kWho);
}

/// The secret that clients must have; none where the variable is not set, on loopback. Throws Error.
std::optional<std::string> keyFor(const SocketAddress& listen) {
  if (const std::string file = system::variable(kRemoteKeyVariable); !file.empty()) return readRemoteKey(pathOf(file));
  if (isOnThisMachine(listen)) return std::nullopt;
  throw Error(
      fmt::format("remote: {}:{} is reachable from other computers, so clients need a key; name its file in {} "
                  "(docs/reference/remote.md)",
                  listen.address, listen.port, kRemoteKeyVariable));
}

RemoteGate::Seed randomSeed() {
  std::array<unsigned char, RemoteGate::Seed().size() / 2> random{};
  if (!system::fillWithRandom(random)) throw Error("remote: the system's random number generator is unavailable");
  RemoteGate::Seed seed;
  for (std::size_t i = 0; i < random.size(); ++i) fmt::format_to_n(seed.data() + 2 * i, 2, "{:02x}", random[i]);
  return seed;
}

/// Counts are for `explain`, on another thread than the servo's.
class Remote {
 public:
  Remote(const SocketAddress& listen, const OpenOptions& options)
      : gate_(keyFor(listen), randomSeed(), static_cast<std::uint64_t>(std::ceil(kHandoverS / options.tick_s))),
        socket_(listen, kWho),
        listen_(listen),
        origin_mm_(options.origin_mm),
        scale_(options.scale) {}

  Vec3 read(std::uint64_t tick) noexcept {
    if (closed_.load(std::memory_order_relaxed)) {
      state_.faults = kClosed;
      return kNoPlace;
    }
    if (receive(tick)) {
      last_tick_ = tick;
      has_pose_ = true;
    }
    state_.age_ticks = tick > last_tick_ ? tick - last_tick_ : 0;
    state_.faults = !has_pose_ ? kNoPose : state_.age_ticks > kMaxSilentTicks ? kStalePose : 0u;
    faults_.store(state_.faults, std::memory_order_relaxed);
    return state_.faults == 0 ? Vec3(origin_mm_ + scale_ * pose_.tip_mm) : kNoPlace;
  }

  void write(const Vec3& force) noexcept {
    if (closed_.load(std::memory_order_relaxed)) return;
    answer(state_.faults == 0 && force.allFinite() ? force : Vec3::Zero());
  }

  const DeviceState& state() const noexcept { return state_; }

  void close() noexcept {
    if (!closed_.exchange(true)) answer(Vec3::Zero());
  }

  std::string explain() const {
    const std::uint32_t faults = faults_.load(std::memory_order_relaxed);
    std::vector<std::string> words;
    if (faults == kNoPose) {
      words.push_back(fmt::format("no position has come to {}:{} yet", listen_.address, listen_.port));
    }
    if (faults == kStalePose) words.emplace_back("the client has fallen silent");
    const RemoteCounts& counts = gate_.counts();
    for (const auto& [count, what] :
         {std::pair(&counts.malformed, "messages were not \"p x y z\""),
          std::pair(&counts.not_signed, "messages were not signed, or not new"),
          std::pair(&counts.ignored, "messages came while another client had the finger")}) {
      if (const std::uint64_t many = count->load(std::memory_order_relaxed); many > 0) {
        words.push_back(fmt::format("{} {}", many, what));
      }
    }
    return fmt::format("{}", fmt::join(words, "; "));
  }

 private:
  /// True when a good pose came.
  bool receive(std::uint64_t tick) noexcept {
    bool came = false;
    gate_.tick(tick);
    std::array<char, kMaxDatagramBytes + 1> message;
    for (int i = 0; i < kMaxDatagramsPerTick; ++i) {
      RemotePeer sender;
      const int bytes = socket_.port().receive(message, sender);
      if (bytes < 0) break;  // nothing waits, or an earlier answer did not arrive
      const std::size_t size = std::min(static_cast<std::size_t>(bytes), message.size());
      const auto pose = gate_.acceptPose({message.data(), size}, sender, tick);
      send(gate_.reply(), sender);
      if (!pose) continue;
      pose_ = *pose;
      came = true;
    }
    state_.buttons = pose_.buttons;
    return came;
  }

  void answer(const Vec3& force) noexcept {
    const std::string_view text = gate_.answer(force);
    if (!text.empty()) send(text, *gate_.holder());
  }

  void send(std::string_view text, const RemotePeer& peer) noexcept {
    if (!text.empty()) socket_.port().send(text, peer);
  }

  RemoteGate gate_;
  UdpSocket socket_;
  SocketAddress listen_;
  Vec3 origin_mm_;
  double scale_;
  DeviceState state_{.faults = kNoPose};
  RemotePose pose_;
  bool has_pose_ = false;
  std::uint64_t last_tick_ = 0;
  std::atomic<std::uint32_t> faults_{kNoPose};
  std::atomic<bool> closed_{false};
};

}  // namespace

Probe probeRemote(const OpenOptions& options) {
  Probe probe;
  try {
    const SocketAddress listen = listenAt(options.which);
    const bool has_key = keyFor(listen).has_value();
    const UdpSocket socket(listen, kWho);
    probe.available = true;
    probe.devices.push_back(fmt::format("any program that {} {}:{}", has_key ? "has the key and sends to" : "sends to",
                                        listen.address, listen.port));
  } catch (const Error& error) {
    probe.reason = error.what();
    probe.remedy = "name another port, remote:PORT, or the file of a key (docs/reference/remote.md)";
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
