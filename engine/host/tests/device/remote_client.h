// A program that moves a finger by datagrams (docs/reference/remote.md), without waiting for anything.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace palpate::device {

/// A program at the other end of `remote`.
class RemoteClient {
 public:
  /// A port that nobody else uses while these tests run side by side.
  static int port() { return 20000 + ::getpid() % 20000; }

  RemoteClient() : file_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port()));
    ::inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
    EXPECT_EQ(::connect(file_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)), 0);
  }
  ~RemoteClient() { ::close(file_); }
  RemoteClient(const RemoteClient&) = delete;
  RemoteClient& operator=(const RemoteClient&) = delete;

  void send(const std::string& message) const { (void)::send(file_, message.data(), message.size(), 0); }
  /// The newest answer; empty when none waits.
  std::string answer() const {
    std::string newest;
    char text[256];
    for (ssize_t size; (size = ::recv(file_, text, sizeof(text), 0)) > 0;)
      newest.assign(text, static_cast<std::size_t>(size));
    return newest;
  }

 private:
  int file_;
};

}  // namespace palpate::device
