#include "palpate/device/detail/remote_socket.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::device {

namespace {

constexpr std::uint32_t kLoopbackNet = 127;

/// "127.0.0.1"; nothing for anything but four numbers of a byte.
std::optional<std::uint32_t> parseIpv4(std::string_view text) {
  std::uint32_t address = 0;
  for (int i = 0; i < 4; ++i) {
    std::uint8_t byte = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), byte);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (i < 3 && !text.starts_with('.')) return std::nullopt;
    if (i < 3) text.remove_prefix(1);
    address = address << 8 | byte;
  }
  return text.empty() ? std::optional(address) : std::nullopt;
}

system::UdpPeer peerAt(const SocketAddress& listen, const char* who) {
  const std::optional<std::uint32_t> address = parseIpv4(listen.address);
  if (!address) throw Error(fmt::format("{}: '{}' must be an IPv4 address", who, oneLine(listen.address)));
  return {*address, static_cast<std::uint16_t>(listen.port)};
}

}  // namespace

SocketAddress parseSocketAddress(const std::string& which, SocketAddress standard, const char* who) {
  SocketAddress listen = std::move(standard);
  std::string port = which;
  if (const std::size_t colon = which.rfind(':'); colon != std::string::npos) {
    listen.address = which.substr(0, colon);
    port = which.substr(colon + 1);
  }
  if (port.empty()) return listen;
  const std::optional<double> number = parseNumber(port);
  if (!number || *number < 1.0 || *number > 65535.0 || *number != std::floor(*number)) {
    throw Error(fmt::format("{}: '{}' must be a port (1 to 65535)", who, oneLine(port)));
  }
  listen.port = static_cast<int>(*number);
  return listen;
}

bool isOnThisMachine(const SocketAddress& listen) {
  const std::optional<std::uint32_t> address = parseIpv4(listen.address);
  return !address || *address >> 24 == kLoopbackNet;
}

UdpSocket::UdpSocket(const SocketAddress& listen, const char* who) : port_(peerAt(listen, who)) {
  if (port_.trouble().empty()) return;
  throw Error(fmt::format("{}: cannot listen on {}:{}: {}; another program may be using the port, try {}:PORT", who,
                          listen.address, listen.port, port_.trouble(), who));
}

}  // namespace palpate::device
