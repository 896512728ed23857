// Winsock, which is started once and never stopped: other threads may still use it. Waits are select()'s: WSAPoll does
// not report a connection that failed before Windows 10 of 2020.
#include <winsock2.h>
#include <ws2tcpip.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <system_error>

#include "palpate/base/system/tcp.h"

namespace palpate::system {

namespace {

/// One call sends or receives no more: it counts in int.
constexpr std::size_t kMaxBytesOfACall = 1u << 20;

bool streamsCanBeOpened() {
  static const bool runs = [] {
    WSADATA facts;
    return ::WSAStartup(MAKEWORD(2, 2), &facts) == 0;
  }();
  return runs;
}

bool setUpStream(SOCKET socket) {
  const BOOL no_delay = TRUE;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&no_delay), sizeof(no_delay));
  u_long on = 1;
  return ::ioctlsocket(socket, static_cast<long>(FIONBIO), &on) == 0;
}

/// For select(), rounded up: it must not return too early again and again.
timeval timeUntil(TcpStream::Deadline deadline) {
  constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
  const auto left = std::chrono::ceil<std::chrono::microseconds>(deadline - Clock::now()).count();
  const std::int64_t us = std::max<std::int64_t>(left, 0);
  return {static_cast<long>(us / kMicrosecondsPerSecond), static_cast<long>(us % kMicrosecondsPerSecond)};
}

int callBytes(std::size_t bytes) { return static_cast<int>(std::min(bytes, kMaxBytesOfACall)); }

}  // namespace

bool TcpStream::failWith(int error) {
  trouble_ = std::system_category().message(error);
  return false;
}

bool TcpStream::failLate() {
  late_ = true;
  return failWith(WSAETIMEDOUT);
}

bool TcpStream::waitUntilReady(For what, Deadline deadline) {
  while (true) {
    fd_set ready;
    fd_set failed;  // where select() reports a connection that was refused
    FD_ZERO(&ready);
    FD_ZERO(&failed);
    FD_SET(static_cast<SOCKET>(socket_), &ready);
    FD_SET(static_cast<SOCKET>(socket_), &failed);
    timeval time = timeUntil(deadline);
    const bool reading = what == For::reading;
    const int found = ::select(0, reading ? &ready : nullptr, reading ? nullptr : &ready, &failed, &time);
    if (found > 0) return true;
    if (found < 0) return failWith(::WSAGetLastError());
    if (Clock::now() < deadline) continue;
    return failLate();
  }
}

bool TcpStream::connectTo(const void* address, Deadline deadline) {
  const auto& one = *static_cast<const addrinfo*>(address);
  if (socket_ >= 0) ::closesocket(static_cast<SOCKET>(socket_));
  const SOCKET socket = ::socket(one.ai_family, SOCK_STREAM, 0);
  socket_ = static_cast<std::intptr_t>(socket);
  if (socket == INVALID_SOCKET || !setUpStream(socket)) return failWith(::WSAGetLastError());
  if (::connect(socket, one.ai_addr, static_cast<int>(one.ai_addrlen)) == 0) return true;
  if (const int error = ::WSAGetLastError(); error != WSAEWOULDBLOCK) return failWith(error);
  if (!waitUntilReady(For::writing, deadline)) return false;
  int error = 0;
  int size = sizeof(error);
  if (::getsockopt(socket, SOL_SOCKET, SO_ERROR, reinterpret_cast<char*>(&error), &size) != 0) {
    return failWith(::WSAGetLastError());
  }
  return error == 0 || failWith(error);
}

TcpStream::TcpStream(const std::string& host, std::uint16_t port, Deadline deadline) {
  if (!streamsCanBeOpened()) {
    failWith(::WSAGetLastError());
    return;
  }
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found); error != 0) {
    failWith(error);
    return;
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, &::freeaddrinfo);
  bool connected = false;
  for (const addrinfo* one = found; one != nullptr && !connected && !late_; one = one->ai_next) {
    connected = connectTo(one, deadline);
  }
  if (connected) trouble_.clear();
}

TcpStream::~TcpStream() {
  if (socket_ >= 0) ::closesocket(static_cast<SOCKET>(socket_));
}

bool TcpStream::send(std::string_view bytes, Deadline deadline) {
  while (!bytes.empty()) {
    const int sent = ::send(static_cast<SOCKET>(socket_), bytes.data(), callBytes(bytes.size()), 0);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (const int error = ::WSAGetLastError(); error != WSAEWOULDBLOCK) {
      return failWith(error);
    } else if (!waitUntilReady(For::writing, deadline)) {
      return false;
    }
  }
  return true;
}

std::size_t TcpStream::receive(std::span<char> buffer, Deadline deadline) {
  while (Clock::now() < deadline) {  // also when there is always something to read
    const int got = ::recv(static_cast<SOCKET>(socket_), buffer.data(), callBytes(buffer.size()), 0);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (const int error = ::WSAGetLastError(); error != WSAEWOULDBLOCK) return failWith(error), 0;
    if (!waitUntilReady(For::reading, deadline)) return 0;
  }
  return failLate(), 0;
}

}  // namespace palpate::system
