#include "palpate/device/detail/remote_socket.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::device {

namespace {

[[noreturn]] void refuse(const char* who, const char* what, const SocketAddress& listen) {
  throw Error(fmt::format("{}: {} at {}:{}: {}; another program may listen there: say {}:PORT", who, what,
                          listen.address, listen.port, std::generic_category().message(errno), who));
}

}  // namespace

SocketAddress socketAddressOf(const std::string& which, SocketAddress standard, const char* who) {
  SocketAddress listen = std::move(standard);
  std::string port = which;
  if (const std::size_t colon = which.rfind(':'); colon != std::string::npos) {
    listen.address = which.substr(0, colon);
    port = which.substr(colon + 1);
  }
  if (port.empty()) return listen;
  const std::optional<double> number = parseNumber(port);
  if (!number || *number < 1.0 || *number > 65535.0 || *number != std::floor(*number)) {
    throw Error(fmt::format("{}: '{}' must be a port, 1 to 65535", who, oneLine(port)));
  }
  listen.port = static_cast<int>(*number);
  return listen;
}

bool isOnThisMachine(const SocketAddress& listen) {
  in_addr address{};
  constexpr std::uint32_t kLoopbackNet = 127;
  return ::inet_pton(AF_INET, listen.address.c_str(), &address) != 1 || ntohl(address.s_addr) >> 24 == kLoopbackNet;
}

UdpSocket::UdpSocket(const SocketAddress& listen, const char* who) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(listen.port));
  if (::inet_pton(AF_INET, listen.address.c_str(), &address.sin_addr) != 1) {
    throw Error(fmt::format("{}: '{}' must be an IPv4 address", who, oneLine(listen.address)));
  }
  file_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (file_ < 0) refuse(who, "no socket", listen);
  if (::bind(file_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return;
  const int reason = errno;
  ::close(file_);
  errno = reason;
  refuse(who, "cannot listen", listen);
}

UdpSocket::~UdpSocket() { ::close(file_); }

}  // namespace palpate::device
