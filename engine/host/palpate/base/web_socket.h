// The frames of a WebSocket (RFC 6455), for either side and for any connection: bytes in, whole messages out. It knows
// no socket and no clock, and trusts nothing that comes: every length is checked before its bytes are waited for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace palpate {

using Sha1Digest = std::array<std::uint8_t, 20>;

/// SHA-1 (FIPS 180-4), by which the handshake proves that the other side speaks the protocol. Nothing secret may rest
/// on it: collisions have been found. Signatures take base/hmac_sha256.h.
Sha1Digest sha1(std::string_view message) noexcept;

}  // namespace palpate

namespace palpate::websocket {

enum class Kind : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// Reason of the side that ends (section 7.4.1).
enum class CloseCode : std::uint16_t {
  normal = 1000,
  going_away = 1001,
  protocol_error = 1002,
  unknown_data = 1003,
  bad_payload = 1007,
  policy_error = 1008,
  too_big = 1009,
  try_again_later = 1013,
};

/// The reading side: a server takes frames with a mask only, a client only those without.
enum class Side : std::uint8_t { client, server };

/// The other side sent something that is not allowed: what to end with, and a sentence for its user.
struct Fault {
  CloseCode code = CloseCode::protocol_error;
  const char* text = "";
};

/// A message that has come in one frame or several, or a frame of control.
struct Received {
  Kind kind = Kind::text;  ///< never continuation
  std::string_view bytes;  ///< text is UTF-8; valid until the next call of the reader
};

/// The longest payload of a frame of control (section 5.5).
inline constexpr std::size_t kMaxControlBytes = 125;

class FrameReader {
 public:
  FrameReader(Side own, std::size_t max_message_bytes) : own_(own), max_message_bytes_(max_message_bytes) {}

  /// Holds on to these bytes until next() has used them up: call it until it has nothing before more is fed, and no
  /// more is held back than a message.
  void feed(std::string_view bytes) { in_.append(bytes); }

  /// Nothing: more bytes are needed, or there is a fault, after which nothing comes any more.
  std::optional<Received> next();

  const std::optional<Fault>& fault() const { return fault_; }

 private:
  struct Head {
    Kind kind;
    bool is_last;
    std::size_t size;      ///< bytes of the head itself
    std::uint64_t length;  ///< bytes of the payload
  };
  std::optional<Head> readHead();
  bool isAllowed(const Head& head, unsigned first, bool masked);
  std::optional<Received> finish(const Head& head, std::string_view payload);
  std::nullopt_t refuse(CloseCode code, const char* text);

  Side own_;
  std::size_t max_message_bytes_;
  std::string in_;
  std::size_t used_ = 0;  ///< bytes of `in_` of the last returned message
  std::string message_;   ///< the fragments so far
  std::optional<Kind> begun_;
  std::optional<Fault> fault_;
};

/// A whole frame as this side must send it. A client's mask comes from the system's randomness; throws Error where it
/// has none.
std::string makeFrame(Side own, Kind kind, std::string_view bytes);
/// Like makeFrame; a reason of more than 123 bytes is cut.
std::string makeClose(Side own, CloseCode code, std::string_view reason = {});
/// The answer to the other side's close: its own code, where that is one that may be sent.
std::string answerClose(Side own, std::string_view payload);

/// 16 bytes of the system's randomness, in base64: the value of a client's Sec-WebSocket-Key. Throws Error.
std::string makeKey();
/// The server's value of Sec-WebSocket-Accept.
std::string acceptFor(std::string_view key);

}  // namespace palpate::websocket
