#include "palpate/base/web_socket.h"

#include <array>
#include <utility>

#include "palpate/base/base64.h"
#include "palpate/base/error.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"

namespace palpate::websocket {

namespace {

constexpr unsigned kLastBit = 0x80;
constexpr unsigned kReservedBits = 0x70;
constexpr unsigned kKindBits = 0x0f;
constexpr unsigned kMaskBit = 0x80;
constexpr unsigned kLengthBits = 0x7f;
/// Longer lengths are in two more bytes, or in eight.
constexpr unsigned kInTwoBytes = 126;
constexpr unsigned kInEightBytes = 127;
constexpr std::size_t kMaskBytes = 4;

unsigned byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

bool isControl(Kind kind) { return static_cast<unsigned>(kind) >= static_cast<unsigned>(Kind::close); }

bool isKnown(unsigned kind) { return kind <= 2 || (kind >= 8 && kind <= 10); }

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = letterBytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

/// The codes that a frame may have (section 7.4).
bool isSendable(unsigned code) {
  return (code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1014) || (code >= 3000 && code <= 4999);
}

void applyMask(char* bytes, std::size_t count, const char* mask) {
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<char>(bytes[i] ^ mask[i % kMaskBytes]);
}

template <std::size_t N>
std::array<unsigned char, N> randomBytes() {
  std::array<unsigned char, N> bytes{};
  if (!system::fillWithRandom(bytes)) throw Error("the system's random number generator is unavailable");
  return bytes;
}

/// Up to the mask.
std::string makeFrameHead(Side own, Kind kind, std::uint64_t size) {
  const unsigned mask_bit = own == Side::client ? kMaskBit : 0;
  std::string head(1, static_cast<char>(kLastBit | static_cast<unsigned>(kind)));
  const auto add = [&](std::uint64_t byte) { head += static_cast<char>(byte); };
  if (size < kInTwoBytes) {
    add(mask_bit | size);
    return head;
  }
  const bool fits_two = size < 0x10000u;
  add(mask_bit | (fits_two ? kInTwoBytes : kInEightBytes));
  for (int shift = fits_two ? 8 : 56; shift >= 0; shift -= 8) add(size >> shift & 0xff);
  return head;
}

}  // namespace

std::nullopt_t FrameReader::refuse(CloseCode code, const char* text) {
  fault_ = Fault{code, text};
  in_.clear();
  message_.clear();
  return std::nullopt;
}

bool FrameReader::isAllowed(const Head& head, unsigned first, bool masked) {
  const auto fail = [&](const char* text) { return refuse(CloseCode::protocol_error, text), false; };
  if ((first & kReservedBits) != 0) return fail("The WebSocket frame contained illegal reserved bits");
  if (!isKnown(first & kKindBits)) return fail("The WebSocket frame contained an illegal opcode");
  if (masked && own_ == Side::client) return fail("The WebSocket frame was masked");
  if (!masked && own_ == Side::server) return fail("The WebSocket frame was unmasked");
  if (isControl(head.kind)) {
    if (!head.is_last) return fail("The WebSocket control frame was fragmented");
    if (head.length > kMaxControlBytes) return fail("The WebSocket control frame size was invalid");
    return true;
  }
  if (head.kind == Kind::continuation && !begun_) return fail("The WebSocket continuation frame was unexpected");
  if (head.kind != Kind::continuation && begun_) return fail("The WebSocket data frame was unexpected");
  if (head.length > max_message_bytes_ - message_.size()) {
    refuse(CloseCode::too_big, "The WebSocket message exceeded the locally configured limit");
    return false;
  }
  return true;
}

std::optional<FrameReader::Head> FrameReader::readHead() {
  if (in_.size() < 2) return std::nullopt;
  const unsigned first = byteAt(in_, 0);
  const bool masked = (byteAt(in_, 1) & kMaskBit) != 0;
  const unsigned said = byteAt(in_, 1) & kLengthBits;
  const std::size_t more = said == kInTwoBytes ? 2 : said == kInEightBytes ? 8 : 0;
  Head head{static_cast<Kind>(first & kKindBits), (first & kLastBit) != 0, 2 + more + (masked ? kMaskBytes : 0), said};
  if (more > 0) {
    if (in_.size() < 2 + more) return std::nullopt;
    head.length = 0;
    for (std::size_t i = 0; i < more; ++i) head.length = head.length << 8 | byteAt(in_, 2 + i);
    const std::uint64_t least = more == 2 ? kInTwoBytes : 0x10000u;
    if (head.length < least) {
      return refuse(CloseCode::protocol_error, "The WebSocket frame size was not canonical");
    }
  }
  if (!isAllowed(head, first, masked)) return std::nullopt;
  return head;
}

std::optional<Received> FrameReader::finish(const Head& head, std::string_view payload) {
  if (isControl(head.kind)) {
    if (head.kind == Kind::close && payload.size() == 1) {
      return refuse(CloseCode::protocol_error, "The WebSocket close frame payload size was invalid");
    }
    return Received{head.kind, payload};
  }
  const Kind kind = begun_.value_or(head.kind);
  const bool in_one = !begun_ && head.is_last;
  if (!in_one) {
    message_.append(payload);
    payload = message_;
  }
  begun_ = kind;
  if (!head.is_last) return std::nullopt;
  begun_.reset();
  if (kind == Kind::text && !isUtf8(payload)) {
    return refuse(CloseCode::bad_payload, "The WebSocket frame payload was not valid utf8");
  }
  return Received{kind, payload};
}

std::optional<Received> FrameReader::next() {
  in_.erase(0, std::exchange(used_, 0));
  if (!begun_) message_.clear();
  while (!fault_) {
    const std::optional<Head> head = readHead();
    if (!head || in_.size() < head->size || in_.size() - head->size < head->length) return std::nullopt;
    const auto length = static_cast<std::size_t>(head->length);
    if (own_ == Side::server) applyMask(in_.data() + head->size, length, in_.data() + head->size - kMaskBytes);
    const std::optional<Received> whole = finish(*head, std::string_view(in_).substr(head->size, length));
    if (whole) used_ = head->size + length;
    if (whole) return whole;
    if (!fault_) in_.erase(0, head->size + length);
  }
  return std::nullopt;
}

std::string makeFrame(Side own, Kind kind, std::string_view bytes) {
  std::string frame = makeFrameHead(own, kind, bytes.size());
  if (own == Side::server) return frame.append(bytes);
  for (const unsigned char byte : randomBytes<kMaskBytes>()) frame += static_cast<char>(byte);
  const std::size_t at = frame.size();
  frame.append(bytes);
  applyMask(frame.data() + at, bytes.size(), frame.data() + at - kMaskBytes);
  return frame;
}

std::string makeClose(Side own, CloseCode code, std::string_view reason) {
  const auto number = static_cast<unsigned>(code);
  std::string payload = {static_cast<char>(number >> 8), static_cast<char>(number & 0xff)};
  payload.append(reason.substr(0, kMaxControlBytes - payload.size()));
  return makeFrame(own, Kind::close, payload);
}

std::string answerClose(Side own, std::string_view payload) {
  if (payload.size() < 2) return makeFrame(own, Kind::close, {});
  const unsigned code = byteAt(payload, 0) << 8 | byteAt(payload, 1);
  return makeClose(own, isSendable(code) ? static_cast<CloseCode>(code) : CloseCode::protocol_error);
}

std::string makeKey() {
  const auto bytes = randomBytes<16>();
  return base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string acceptFor(std::string_view key) {
  constexpr std::string_view kProtocolsOwn = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";  // section 1.3
  const Sha1Digest digest = sha1(std::string(key).append(kProtocolsOwn));
  return base64({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

}  // namespace palpate::websocket
