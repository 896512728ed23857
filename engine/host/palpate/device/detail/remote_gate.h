// Decides who may move a finger by datagrams, and how much is answered: the protocol of docs/reference/remote.md
// without its socket.
//
//   datagram ─ holder? ─ signed, fresh? ─ a pose? ─► acceptPose   answer ─► "f x y z", some for each pose and no more
//
// One sender holds the finger until it has been silent for a second. With a key every message is signed (HMAC-SHA256):
// "hello" is answered by the nonce of the conversation and the number of its last pose, poses count up within it, and a
// finger that becomes free begins another conversation: nothing that was sent before counts again.
//
// For the servo's thread: no lock, no memory, nothing thrown. Its counts may be read on another.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/base/hmac_sha256.h"
#include "palpate/base/system/udp.h"
#include "palpate/base/vec.h"

namespace palpate::device {

/// A client that is silent for longer has no position and gets no force, ticks: programs at 100 Hz are welcome.
inline constexpr std::uint64_t kMaxSilentTicks = 20;

/// A pose is answered in each tick until it is too old, and then once by zero.
inline constexpr std::uint64_t kAnswersPerPose = kMaxSilentTicks + 2;

/// So long the finger waits for a client that fell silent before another may have it.
inline constexpr double kHandoverS = 1.0;

/// A longer datagram is refused.
inline constexpr std::size_t kMaxDatagramBytes = 256;

/// A shorter hello gets no answer: the answer must not be longer than the request.
inline constexpr std::size_t kHelloBytes = 192;

inline constexpr std::size_t kMinKeyBytes = 32;
inline constexpr std::size_t kMaxKeyBytes = 128;

struct RemotePose {
  Vec3 tip_mm = Vec3::Zero();
  std::uint32_t buttons = 0;
};

/// "p x y z" or "p x y z buttons", numbers between blanks, a line end allowed; nothing for anything else, for what is
/// not finite and for places farther than kMaxCoordinateMm. No allocation.
std::optional<RemotePose> parsePose(std::string_view message) noexcept;

/// The secret in this file: one line of kMinKeyBytes to kMaxKeyBytes letters and digits. Throws Error for a missing
/// file, other content, or a file that others than its owner may read.
std::string readRemoteKey(const std::filesystem::path& file);

/// Where a datagram came from, IPv4.
using RemotePeer = system::UdpPeer;

struct RemoteCounts {
  std::atomic<std::uint64_t> malformed{0};   ///< not "p x y z"
  std::atomic<std::uint64_t> not_signed{0};  ///< without the key, or not new
  std::atomic<std::uint64_t> ignored{0};     ///< another client had the finger
};

class RemoteGate {
 public:
  /// A random start of the nonces, new for each run.
  using Seed = std::array<char, 24>;

  /// Without a key, every client that reaches the port is accepted.
  RemoteGate(const std::optional<std::string>& key, const Seed& seed, std::uint64_t handover_ticks) noexcept;

  /// Once before the datagrams of a tick: frees a finger whose client fell silent.
  void tick(std::uint64_t tick) noexcept;

  /// The pose in a datagram, where it counts. Sets `reply`.
  std::optional<RemotePose> acceptPose(std::string_view datagram, const RemotePeer& from, std::uint64_t tick) noexcept;

  /// Immediate answer to the sender of the last datagram, whether or not it has the finger; empty for most. Valid until
  /// `acceptPose`.
  std::string_view reply() const noexcept { return {reply_.data(), reply_size_}; }

  /// The next answer for the holder; empty where none is due. Valid until the next one.
  std::string_view answer(const Vec3& force) noexcept;

  const std::optional<RemotePeer>& holder() const noexcept { return holder_; }
  const RemoteCounts& counts() const noexcept { return counts_; }

 private:
  using Text = std::array<char, kMaxDatagramBytes>;

  /// The pose's text out of a signed message that is new; empty where it is not.
  std::string_view opened(std::string_view message) noexcept;
  void answerHello(std::string_view message, std::size_t bytes, std::uint64_t tick) noexcept;
  /// The text before the signature, if that is right.
  std::optional<std::string_view> verified(std::string_view message) const noexcept;
  /// Appends blank, signature and line end.
  std::size_t signedSize(Text& text, std::size_t size) const noexcept;
  void beginConversation() noexcept;

  std::optional<HmacSha256> key_;
  std::array<char, 32> nonce_;  // the run's seed, and which conversation of it
  std::uint32_t conversation_ = 0;
  std::uint64_t handover_ticks_;
  std::optional<RemotePeer> holder_;
  std::uint64_t heard_tick_ = 0;
  std::optional<std::uint64_t> greeted_tick_;
  std::uint64_t pose_number_ = 0;    // the last that counted, of this conversation
  std::uint64_t answer_number_ = 0;  // likewise
  std::uint64_t answers_left_ = 0;
  Text reply_{}, answer_{};
  std::size_t reply_size_ = 0;
  RemoteCounts counts_;
};

}  // namespace palpate::device
