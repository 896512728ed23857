// A TCP connection that this program opens, and whose every wait for the other side ends at a deadline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "palpate/base/stopwatch.h"

namespace palpate::system {

/// One thread at a time. Small messages go out at once (TCP_NODELAY).
class TcpStream {
 public:
  using Deadline = Clock::time_point;

  /// Tries the addresses of the host one after the other, until one answers or the time is over. `host`: a name or an
  /// address; to look a name up takes as long as the system takes, the deadline does not end that.
  TcpStream(const std::string& host, std::uint16_t port, Deadline deadline);
  ~TcpStream();
  TcpStream(const TcpStream&) = delete;
  TcpStream& operator=(const TcpStream&) = delete;

  /// Hands all bytes to the system. False: trouble() says why not.
  bool send(std::string_view bytes, Deadline deadline);
  /// Waits for the next bytes and returns how many came; 0: trouble(), or the other side has ended, without trouble.
  std::size_t receive(std::span<char> buffer, Deadline deadline);

  /// Empty: nothing is wrong. After trouble the connection is of no use.
  const std::string& trouble() const { return trouble_; }
  /// The trouble is the deadline.
  bool isLate() const { return late_; }

 private:
  enum class For : std::uint8_t { reading, writing };
  bool connectTo(const void* address, Deadline deadline);
  bool waitUntilReady(For what, Deadline deadline);
  bool failWith(int error);
  bool failLate();

  std::intptr_t socket_ = -1;
  std::string trouble_;
  bool late_ = false;
};

}  // namespace palpate::system
