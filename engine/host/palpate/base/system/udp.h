// A UDP socket of IPv4 that never waits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace palpate::system {

/// In the machine's own order of bytes.
struct UdpPeer {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  bool operator==(const UdpPeer&) const = default;
};

class UdpPort {
 public:
  /// Bound and open; `trouble` is empty then, else the reason.
  explicit UdpPort(const UdpPeer& at);
  ~UdpPort();
  UdpPort(const UdpPort&) = delete;
  UdpPort& operator=(const UdpPort&) = delete;
  const std::string& trouble() const { return trouble_; }

  /// The next message, cut where it is longer than the buffer: its whole length where the system reports it, else at
  /// least one more than the buffer; -1: none waits. Any thread, takes no memory.
  int receive(std::span<char> buffer, UdpPeer& from) const noexcept;
  /// Lost where it cannot go at once.
  void send(std::string_view message, const UdpPeer& to) const noexcept;

 private:
  std::intptr_t socket_ = -1;
  std::string trouble_;
};

}  // namespace palpate::system
