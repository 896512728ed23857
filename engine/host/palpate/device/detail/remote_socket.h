// A UDP socket of this machine that never waits, and the words that name where it listens.
#pragma once

#include <string>

#include "palpate/base/system/udp.h"

namespace palpate::device {

struct SocketAddress {
  std::string address = "127.0.0.1";  ///< IPv4
  int port = 0;
};

/// "4730", "0.0.0.0:4730", or nothing -> where to listen; missing parts are `standard`'s. `who` begins the message of
/// the Error for anything else.
SocketAddress parseSocketAddress(const std::string& which, SocketAddress standard, const char* who);

/// Only programs of this machine reach it.
bool isOnThisMachine(const SocketAddress& listen);

/// Bound and open; not waiting. Throws Error with `who` and the address where that is refused.
class UdpSocket {
 public:
  UdpSocket(const SocketAddress& listen, const char* who);
  const system::UdpPort& port() const noexcept { return port_; }

 private:
  system::UdpPort port_;
};

}  // namespace palpate::device
