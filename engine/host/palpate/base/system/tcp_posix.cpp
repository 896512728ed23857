#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <memory>
#include <system_error>

#include "palpate/base/system/tcp.h"

namespace palpate::system {

namespace {

#ifdef MSG_NOSIGNAL
constexpr int kSendFlags = MSG_NOSIGNAL;  // to write to one that is gone is an error, not the end of the program
#else
constexpr int kSendFlags = 0;
#endif

/// Not waiting, not handed on to programs that are started, without the wait for a fuller packet.
bool setUpStream(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
#ifdef SO_NOSIGPIPE
  ::setsockopt(socket, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof(on));
#endif
  return ::fcntl(socket, F_SETFL, O_NONBLOCK) == 0 && ::fcntl(socket, F_SETFD, FD_CLOEXEC) == 0;
}

/// Milliseconds for poll(), rounded up: it must not return too early again and again.
int millisecondsUntil(TcpStream::Deadline deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, INT_MAX));
}

bool wouldWait(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

std::string lookUpTrouble(int error) {
  return error == EAI_NONAME   ? "Host not found"
         : error == EAI_SYSTEM ? std::generic_category().message(errno)
                               : ::gai_strerror(error);
}

}  // namespace

bool TcpStream::failWith(int error) {
  trouble_ = std::generic_category().message(error);
  return false;
}

bool TcpStream::failLate() {
  late_ = true;
  return failWith(ETIMEDOUT);
}

bool TcpStream::waitUntilReady(For what, Deadline deadline) {
  while (true) {
    pollfd ready{static_cast<int>(socket_), static_cast<short>(what == For::reading ? POLLIN : POLLOUT), 0};
    const int found = ::poll(&ready, 1, millisecondsUntil(deadline));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return failWith(errno);
    if (Clock::now() < deadline) continue;
    return failLate();
  }
}

bool TcpStream::connectTo(const void* address, Deadline deadline) {
  const auto& one = *static_cast<const addrinfo*>(address);
  if (socket_ >= 0) ::close(static_cast<int>(socket_));
#ifdef SOCK_CLOEXEC  // at once: a program that another thread starts must not get it
  socket_ = ::socket(one.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
#else
  socket_ = ::socket(one.ai_family, SOCK_STREAM, 0);
#endif
  const int socket = static_cast<int>(socket_);
  if (socket < 0 || !setUpStream(socket)) return failWith(errno);
  if (::connect(socket, one.ai_addr, one.ai_addrlen) == 0) return true;
  if (errno != EINPROGRESS) return failWith(errno);
  if (!waitUntilReady(For::writing, deadline)) return false;
  int error = 0;
  socklen_t size = sizeof(error);
  if (::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) != 0) return failWith(errno);
  return error == 0 || failWith(error);
}

TcpStream::TcpStream(const std::string& host, std::uint16_t port, Deadline deadline) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found); error != 0) {
    trouble_ = lookUpTrouble(error);
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
  if (socket_ >= 0) ::close(static_cast<int>(socket_));
}

bool TcpStream::send(std::string_view bytes, Deadline deadline) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(static_cast<int>(socket_), bytes.data(), bytes.size(), kSendFlags);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (wouldWait(errno)) {
      if (!waitUntilReady(For::writing, deadline)) return false;
    } else if (errno != EINTR) {
      return failWith(errno);
    }
  }
  return true;
}

std::size_t TcpStream::receive(std::span<char> buffer, Deadline deadline) {
  while (Clock::now() < deadline) {  // also when there is always something to read
    const ssize_t got = ::recv(static_cast<int>(socket_), buffer.data(), buffer.size(), 0);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (wouldWait(errno)) {
      if (!waitUntilReady(For::reading, deadline)) return 0;
    } else if (errno != EINTR) {
      return failWith(errno), 0;
    }
  }
  return failLate(), 0;
}

}  // namespace palpate::system
