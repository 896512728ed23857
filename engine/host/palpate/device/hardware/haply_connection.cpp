// HTTP and WebSocket to a service on this computer, over one stream. Each operation ends in time or throws; what the
// service sends is bounded before it is waited for. Cold path: the servo is never here.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/system/tcp.h"
#include "palpate/base/text.h"
#include "palpate/base/web_socket.h"
#include "palpate/device/hardware/haply_message.h"
#include "palpate/device/hardware/haply_session.h"

namespace palpate::device::haply {

namespace {

constexpr std::size_t kMaxTroubleLetters = 200;
constexpr std::size_t kMaxHeadBytes = 8192;  ///< limit for an answer by HTTP
constexpr std::size_t kMaxChunkLineBytes = 256;
constexpr std::size_t kBytesAtOnce = 16384;
constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";
constexpr const char* kEndOfFile = "End of file";
constexpr const char* kHasClosed = "The WebSocket stream was gracefully closed at both endpoints";

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

/// A stream whose operations end in time. Outside of the unnamed namespace: a Connection has one.
class Wire {
 public:
  Wire(Address address, double patience_s)
      : address_(std::move(address)),
        patience_s_(patience_s),
        deadline_(after(patience_s)),
        stream_(address_.host, static_cast<std::uint16_t>(address_.port), deadline_) {
    if (!stream_.trouble().empty()) refuseTrouble();
  }

  /// The time of the next operation begins.
  void begin() { deadline_ = after(patience_s_); }

  void send(std::string_view bytes) {
    if (!stream_.send(bytes, deadline_)) refuseTrouble();
  }
  /// The next bytes; empty where the service has ended.
  std::string_view receive() {
    const std::size_t bytes = stream_.receive(buffer_, deadline_);
    if (!stream_.trouble().empty()) refuseTrouble();
    return {buffer_.data(), bytes};
  }
  [[noreturn]] void refuse(std::string_view why) const {
    throw Error(words(address_) + ": " + oneLine(why, kMaxTroubleLetters));
  }
  const Address& address() const { return address_; }

 private:
  [[noreturn]] void refuseTrouble() const {
    refuse(stream_.isLate() ? fmt::format("no answer within {:.2f} s", patience_s_) : stream_.trouble());
  }

  Address address_;
  double patience_s_;
  Clock::time_point deadline_;
  system::TcpStream stream_;
  std::array<char, kBytesAtOnce> buffer_;
};

namespace {

/// The head of an answer by HTTP.
struct HttpHead {
  int status = 0;
  std::vector<std::pair<std::string, std::string>> fields;  ///< names in small letters

  /// Null if missing.
  const std::string* field(std::string_view name) const {
    const auto at = std::find_if(fields.begin(), fields.end(), [&](const auto& one) { return one.first == name; });
    return at == fields.end() ? nullptr : &at->second;
  }
  /// Whether a word is in a field's list, in letters of any size.
  bool lists(std::string_view name, std::string_view word) const {
    const std::string* value = field(name);
    if (value == nullptr) return false;
    const std::string lower = inSmallLetters(*value);
    const auto all = split(lower, ',');
    return std::find(all.begin(), all.end(), word) != all.end();
  }
};

/// A whole number in decimal or hexadecimal digits alone.
std::optional<std::size_t> parseCount(std::string_view text, int base) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count, base);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return count;
}

/// Reads answers by HTTP/1.1 off a wire.
class HttpReader {
 public:
  explicit HttpReader(Wire& wire) : wire_(wire) {}

  HttpHead readHead() {
    const std::string text = readUntil(kHeadEnd, kMaxHeadBytes, "header limit exceeded");
    HttpHead head;
    std::string_view rest = std::string_view(text).substr(0, text.size() - kLineEnd.size());
    head.status = parseStatus(nextLine(rest));
    while (!rest.empty()) {
      const std::string_view line = nextLine(rest);
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos || colon == 0) wire_.refuse("bad field");
      head.fields.emplace_back(inSmallLetters(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
    }
    return head;
  }

  std::string readBody(const HttpHead& head) {
    if (head.lists("transfer-encoding", "chunked")) return readChunks();
    if (const std::string* length = head.field("content-length")) {
      const std::optional<std::size_t> bytes = parseCount(*length, 10);
      if (!bytes) wire_.refuse("bad Content-Length");
      requireFits(*bytes);
      return readBytes(*bytes);
    }
    while (fill()) requireFits(in_.size());
    return std::exchange(in_, {});
  }

  /// The bytes behind the head.
  std::string extractRest() { return std::exchange(in_, {}); }

 private:
  static std::string_view nextLine(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find(kLineEnd));
    text.remove_prefix(line.size() + kLineEnd.size());
    return line;
  }

  /// Status from "HTTP/1.1 200 OK".
  int parseStatus(std::string_view line) const {
    constexpr std::string_view kVersion = "HTTP/1.";
    constexpr std::size_t kStatusAt = kVersion.size() + 2;
    constexpr std::size_t kStatusDigits = 3;
    if (!line.starts_with(kVersion) || line.size() < kStatusAt + kStatusDigits) wire_.refuse("bad version");
    const auto status = parseCount(line.substr(kStatusAt, kStatusDigits), 10);
    if (!status) wire_.refuse("bad status");
    return static_cast<int>(*status);
  }

  void requireFits(std::size_t body_bytes) const {
    if (body_bytes > kMaxReplyBytes) wire_.refuse("body limit exceeded");
  }

  bool fill() {
    const std::string_view more = wire_.receive();
    in_.append(more);
    return !more.empty();
  }

  std::string readBytes(std::size_t bytes) {
    while (in_.size() < bytes) {
      if (!fill()) wire_.refuse("partial message");
    }
    std::string taken = in_.substr(0, bytes);
    in_.erase(0, bytes);
    return taken;
  }

  std::string readUntil(std::string_view end, std::size_t max_bytes, const char* too_long) {
    std::size_t at = in_.find(end);
    while (at == std::string::npos) {
      if (in_.size() > max_bytes) wire_.refuse(too_long);
      if (!fill()) wire_.refuse(in_.empty() ? "end of stream" : "partial message");
      at = in_.find(end);
    }
    if (at > max_bytes) wire_.refuse(too_long);
    return readBytes(at + end.size());
  }

  std::string readChunks() {
    std::string body;
    while (true) {
      const std::string line = readUntil(kLineEnd, kMaxChunkLineBytes, "bad chunk");
      const std::string_view size = std::string_view(line).substr(0, line.find_first_of("; \t\r"));
      const std::optional<std::size_t> bytes = parseCount(size, 16);
      if (!bytes) wire_.refuse("bad chunk");
      if (*bytes == 0) return body;  // the trailer is of no interest, nor is the connection
      requireFits(*bytes);           // before the sum, which could wrap around
      requireFits(body.size() + *bytes);
      body += readBytes(*bytes);
      if (readBytes(kLineEnd.size()) != kLineEnd) wire_.refuse("bad chunk");
    }
  }

  Wire& wire_;
  std::string in_;
};

}  // namespace

std::string words(const Address& address) { return fmt::format("{}:{}", address.host, address.port); }

struct Connection::Impl {
  Impl(const Address& address, double patience_s) : wire(address, patience_s) { shakeHands(); }

  void shakeHands() {
    const std::string key = websocket::makeKey();
    wire.begin();
    wire.send(
        fmt::format("GET / HTTP/1.1\r\nHost: {}\r\nUpgrade: websocket\r\nConnection: upgrade\r\n"
                    "Sec-WebSocket-Key: {}\r\nSec-WebSocket-Version: 13\r\n\r\n",
                    words(wire.address()), key));
    HttpReader answer(wire);
    const HttpHead head = answer.readHead();
    constexpr int kSwitchingProtocols = 101;
    if (head.status != kSwitchingProtocols) wire.refuse("The WebSocket handshake was declined by the remote peer");
    if (!head.lists("connection", "upgrade")) {
      wire.refuse("The WebSocket handshake Connection field is missing the upgrade token");
    }
    if (!head.lists("upgrade", "websocket")) {
      wire.refuse("The WebSocket handshake Upgrade field is missing the websocket token");
    }
    const std::string* accept = head.field("sec-websocket-accept");
    if (accept == nullptr) wire.refuse("The WebSocket handshake Sec-WebSocket-Accept field is missing");
    if (*accept != websocket::acceptFor(key)) {
      wire.refuse("The WebSocket handshake Sec-WebSocket-Accept field is invalid");
    }
    if (head.field("sec-websocket-extensions") != nullptr || head.field("sec-websocket-protocol") != nullptr) {
      wire.refuse("The WebSocket handshake names an extension or a protocol that was not asked for");
    }
    frames.feed(answer.extractRest());
  }

  /// Reports the reason to the service; whether it arrives does not matter any more.
  [[noreturn]] void refuse(const websocket::Fault& fault) {
    try {
      wire.send(websocket::makeClose(websocket::Side::client, fault.code));
    } catch (const Error&) {  // the fault comes first
    }
    wire.refuse(fault.text);
  }

  std::string_view receive() {
    using websocket::Kind;
    wire.begin();
    while (true) {
      if (const auto message = frames.next()) {
        if (message->kind == Kind::text || message->kind == Kind::binary) return message->bytes;
        if (message->kind == Kind::ping) {
          wire.send(websocket::makeFrame(websocket::Side::client, Kind::pong, message->bytes));
        }
        if (message->kind == Kind::close) {
          wire.send(websocket::answerClose(websocket::Side::client, message->bytes));
          wire.refuse(kHasClosed);
        }
        continue;
      }
      if (frames.fault()) refuse(*frames.fault());
      const std::string_view more = wire.receive();
      if (more.empty()) wire.refuse(kEndOfFile);
      frames.feed(more);
    }
  }

  Wire wire;
  websocket::FrameReader frames{websocket::Side::client, kMaxReplyBytes};
};

Connection::Connection(const Address& address, double patience_s)
    : impl_(std::make_unique<Impl>(address, patience_s)) {}

Connection::~Connection() = default;

std::string_view Connection::receive() { return impl_->receive(); }

void Connection::send(std::string_view text) {
  impl_->wire.begin();
  impl_->wire.send(websocket::makeFrame(websocket::Side::client, websocket::Kind::text, text));
}

std::string httpGet(const Address& address, const std::string& path, double patience_s) {
  Wire wire(address, patience_s);
  wire.begin();
  wire.send(fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n\r\n", path, words(address)));
  wire.begin();
  HttpReader answer(wire);
  const HttpHead head = answer.readHead();
  std::string body = answer.readBody(head);
  constexpr int kOk = 200;
  if (head.status != kOk) throw Error(fmt::format("{}{}: status {}", words(address), path, head.status));
  return body;
}

}  // namespace palpate::device::haply
