#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "palpate/base/system/udp.h"

namespace palpate::system {

namespace {

sockaddr_in systemsAddress(const UdpPeer& peer) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(peer.port);
  address.sin_addr.s_addr = htonl(peer.address);
  return address;
}

std::string reason() { return std::generic_category().message(errno); }

#ifdef SOCK_CLOEXEC  // at once: a program that another thread starts must not get it
constexpr int kKind = SOCK_DGRAM | SOCK_CLOEXEC;
#else
constexpr int kKind = SOCK_DGRAM;
#endif

/// Not waiting, and not handed on to programs that are started.
bool setUp(int socket) {
  return ::fcntl(socket, F_SETFL, O_NONBLOCK) == 0 && ::fcntl(socket, F_SETFD, FD_CLOEXEC) == 0;
}

}  // namespace

UdpPort::UdpPort(const UdpPeer& at) : socket_(::socket(AF_INET, kKind, 0)) {
  const int socket = static_cast<int>(socket_);
  const sockaddr_in address = systemsAddress(at);
  const bool bound =
      socket >= 0 && setUp(socket) && ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  if (!bound) trouble_ = reason();
}

UdpPort::~UdpPort() {
  if (socket_ >= 0) ::close(static_cast<int>(socket_));
}

int UdpPort::receive(std::span<char> buffer, UdpPeer& from) const noexcept {
  sockaddr_in sender{};
  socklen_t length = sizeof(sender);
  const ssize_t bytes = ::recvfrom(static_cast<int>(socket_), buffer.data(), buffer.size(), MSG_TRUNC,
                                   reinterpret_cast<sockaddr*>(&sender), &length);
  from = {ntohl(sender.sin_addr.s_addr), ntohs(sender.sin_port)};
  return static_cast<int>(bytes);
}

void UdpPort::send(std::string_view message, const UdpPeer& to) const noexcept {
  const sockaddr_in address = systemsAddress(to);
#ifdef MSG_NOSIGNAL
  constexpr int kFlags = MSG_DONTWAIT | MSG_NOSIGNAL;
#else
  constexpr int kFlags = MSG_DONTWAIT;
#endif
  (void)::sendto(static_cast<int>(socket_), message.data(), message.size(), kFlags,
                 reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}

}  // namespace palpate::system
