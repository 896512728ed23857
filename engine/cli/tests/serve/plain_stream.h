// A client of `palpate serve` that shares no code with it: sockets, HTTP and WebSocket by hand (RFC 6455), so that it
// can also be wrong in every way. Over TLS where it is given a context.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/base/stopwatch.h"

namespace palpate::support {

/// A connection; what it does not get within its patience it does not get.
class PlainWire {
 public:
  explicit PlainWire(int port, SSL_CTX* tls = nullptr, int receive_bytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_bytes > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof(receive_bytes));
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port));
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof(at)) == 0;
    if (tls == nullptr) return;
    tls_ = SSL_new(tls);
    SSL_set_fd(tls_, socket_);
    open_ = open_ && SSL_connect(tls_) == 1;
  }
  ~PlainWire() { hangUp(); }
  PlainWire(PlainWire&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)),
        tls_(std::exchange(other.tls_, nullptr)),
        open_(std::exchange(other.open_, false)),
        in_(std::move(other.in_)) {}
  PlainWire& operator=(PlainWire&&) = delete;

  void hangUp() {
    if (tls_ != nullptr) SSL_free(std::exchange(tls_, nullptr));
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    open_ = false;
  }
  bool isOpen() const { return open_; }

  bool send(std::string_view bytes) {
    while (open_ && !bytes.empty()) {
      const auto sent = tls_ != nullptr ? SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size()))
                                        : ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return open_ = false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return open_;
  }
  /// So many bytes; nothing when they do not come in time or the other side is gone.
  std::optional<std::string> receive(std::size_t size, double patience_s) {
    if (!fill([&] { return in_.size() >= size; }, patience_s)) return std::nullopt;
    return taken(size);
  }
  std::optional<std::string> receiveUntil(std::string_view end, double patience_s) {
    if (!fill([&] { return in_.find(end) != std::string::npos; }, patience_s)) return std::nullopt;
    return taken(in_.find(end) + end.size());
  }
  /// The other side hangs up within this time.
  bool endsWithin(double patience_s) {
    fill([] { return false; }, patience_s);
    return !open_;
  }

 private:
  template <class Enough>
  bool fill(const Enough& enough, double patience_s) {
    const auto began = Clock::now();
    while (!enough()) {
      const double left_s = patience_s - secondsSince(began);
      if (!open_ || left_s <= 0.0) return false;
      pollfd ready{socket_, POLLIN, 0};
      const bool waiting = tls_ != nullptr && SSL_pending(tls_) > 0;
      if (!waiting && ::poll(&ready, 1, static_cast<int>(1000.0 * left_s) + 1) <= 0) continue;
      char buffer[16384];
      const auto got =
          tls_ != nullptr ? SSL_read(tls_, buffer, sizeof(buffer)) : ::recv(socket_, buffer, sizeof(buffer), 0);
      if (got <= 0) {
        open_ = false;
      } else {
        in_.append(buffer, static_cast<std::size_t>(got));
      }
    }
    return true;
  }
  std::string taken(std::size_t size) {
    std::string bytes = in_.substr(0, size);
    in_.erase(0, size);
    return bytes;
  }

  int socket_;
  SSL* tls_ = nullptr;
  bool open_ = false;
  std::string in_;
};

struct PlainAnswer {
  int status = 0;  ///< 0: none came
  std::string head, body;
  bool has(std::string_view line) const { return head.find(line) != std::string::npos; }
};

/// `lines`: further header lines, each with its end. Does not wait for a body where `only_head`.
inline PlainAnswer ask(PlainWire& wire, const std::string& method, const std::string& path,
                       const std::string& lines = {}, bool only_head = false) {
  PlainAnswer answer;
  wire.send(method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n");
  const auto head = wire.receiveUntil("\r\n\r\n", 10.0);
  if (!head || head->size() < 12) return answer;
  answer.head = *head;
  answer.status = std::stoi(head->substr(9, 3));
  const std::size_t at = head->find("Content-Length: ");
  if (at == std::string::npos || only_head) return answer;
  answer.body = wire.receive(std::stoul(head->substr(at + 16)), 20.0).value_or("");
  return answer;
}

struct PlainMessage {
  int kind = 0;  ///< 1 text, 2 bytes, 8 close, 9 ping, 10 pong
  std::string bytes;
  /// Of a close.
  int code() const {
    return bytes.size() < 2 ? 0 : 256 * static_cast<unsigned char>(bytes[0]) + static_cast<unsigned char>(bytes[1]);
  }
  std::string reason() const { return bytes.size() < 2 ? "" : bytes.substr(2); }
};

/// A stream of contacts.
class PlainStream {
 public:
  PlainStream(int port, const std::string& token, const std::string& lines = {}, SSL_CTX* tls = nullptr,
              int receive_bytes = 0)
      : wire_(port, tls, receive_bytes) {
    wire_.send(
        "GET /served/contacts HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        "Sec-WebSocket-Protocol: palpate.1, palpate.token." +
        token + "\r\n" + lines + "\r\n");
    head_ = wire_.receiveUntil("\r\n\r\n", 10.0).value_or("");
    if (head_.size() > 12) status_ = std::stoi(head_.substr(9, 3));
  }

  /// 101: it streams.
  int status() const { return status_; }
  const std::string& head() const { return head_; }
  PlainWire& wire() { return wire_; }

  std::optional<PlainMessage> receive(double patience_s = 10.0) {
    const auto begin = wire_.receive(2, patience_s);
    if (!begin) return std::nullopt;
    std::uint64_t size = static_cast<unsigned char>((*begin)[1]) & 127u;
    if (size >= 126) {
      const auto more = wire_.receive(size == 126 ? 2 : 8, patience_s);
      if (!more) return std::nullopt;
      size = 0;
      for (const char byte : *more) size = 256 * size + static_cast<unsigned char>(byte);
    }
    auto bytes = wire_.receive(size, patience_s);
    if (!bytes) return std::nullopt;
    return PlainMessage{static_cast<unsigned char>((*begin)[0]) & 15, std::move(*bytes)};
  }
  /// The next of this kind; answers pings meanwhile. Nothing when another goodbye comes first.
  std::optional<PlainMessage> receiveKind(int kind, double patience_s = 10.0) {
    const auto began = Clock::now();
    while (secondsSince(began) < patience_s) {
      auto message = receive(patience_s - secondsSince(began));
      if (!message || message->kind == kind) return message;
      if (message->kind == 9) send(10, message->bytes);
      if (message->kind == 8) return std::nullopt;
    }
    return std::nullopt;
  }
  /// The next text with these words in it.
  std::optional<std::string> receiveText(std::string_view words, double patience_s = 10.0) {
    const auto began = Clock::now();
    while (secondsSince(began) < patience_s) {
      const auto message = receiveKind(1, patience_s - secondsSince(began));
      if (!message) return std::nullopt;
      if (message->bytes.find(words) != std::string::npos) return message->bytes;
    }
    return std::nullopt;
  }
  bool send(int kind, std::string_view bytes) { return wire_.send(framed(kind, bytes)); }
  bool say(std::string_view text) { return send(1, text); }

  /// As a client must: with a mask, here of zeros.
  static std::string framed(int kind, std::string_view bytes) {
    std::string frame(1, static_cast<char>(0x80 | kind));
    if (bytes.size() < 126) {
      frame += static_cast<char>(0x80 | bytes.size());
    } else if (bytes.size() < 65536) {
      frame += static_cast<char>(0xfe);
      frame += {static_cast<char>(bytes.size() >> 8), static_cast<char>(bytes.size() & 255)};
    } else {
      frame += static_cast<char>(0xff);
      for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>((bytes.size() >> shift) & 255);
    }
    return frame + std::string(4, '\0') + std::string(bytes);
  }

 private:
  PlainWire wire_;
  std::string head_;
  int status_ = 0;
};

}  // namespace palpate::support
