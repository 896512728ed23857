// Winsock, which is started once and never stopped: other threads may still use it.
#include <winsock2.h>
#include <ws2tcpip.h>

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

bool winsockRuns() {
  static const bool runs = [] {
    WSADATA facts;
    return ::WSAStartup(MAKEWORD(2, 2), &facts) == 0;
  }();
  return runs;
}

std::string reason() { return std::system_category().message(::WSAGetLastError()); }

/// Non-blocking; and an unreachable receiver of an answer does not fail the next message (SIO_UDP_CONNRESET).
bool setUp(SOCKET socket) {
  u_long on = 1;
  DWORD off = 0;
  DWORD bytes = 0;
  constexpr DWORD kTellOfResets = 0x9800000C;
  ::WSAIoctl(socket, kTellOfResets, &off, sizeof(off), nullptr, 0, &bytes, nullptr, nullptr);
  return ::ioctlsocket(socket, static_cast<long>(FIONBIO), &on) == 0;
}

}  // namespace

UdpPort::UdpPort(const UdpPeer& at) {
  if (!winsockRuns()) {
    trouble_ = reason();
    return;
  }
  const SOCKET socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  socket_ = static_cast<std::intptr_t>(socket);
  const sockaddr_in address = systemsAddress(at);
  const bool bound = socket != INVALID_SOCKET && setUp(socket) &&
                     ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  if (!bound) trouble_ = reason();
}

UdpPort::~UdpPort() {
  if (socket_ >= 0) ::closesocket(static_cast<SOCKET>(socket_));
}

int UdpPort::receive(std::span<char> buffer, UdpPeer& from) const noexcept {
  sockaddr_in sender{};
  int length = sizeof(sender);
  int bytes = ::recvfrom(static_cast<SOCKET>(socket_), buffer.data(), static_cast<int>(buffer.size()), 0,
                         reinterpret_cast<sockaddr*>(&sender), &length);
  if (bytes < 0 && ::WSAGetLastError() == WSAEMSGSIZE) bytes = static_cast<int>(buffer.size()) + 1;
  from = {ntohl(sender.sin_addr.s_addr), ntohs(sender.sin_port)};
  return bytes;
}

void UdpPort::send(std::string_view message, const UdpPeer& to) const noexcept {
  const sockaddr_in address = systemsAddress(to);
  (void)::sendto(static_cast<SOCKET>(socket_), message.data(), static_cast<int>(message.size()), 0,
                 reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}

}  // namespace palpate::system
