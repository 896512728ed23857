// Winsock, started by who has made the sockets.
#include <winsock2.h>
#include <ws2tcpip.h>
// After those.
#include <iphlpapi.h>

#include <array>
#include <utility>

#include "palpate/base/system/network.h"

namespace palpate::system {

namespace {

void setOption(std::intptr_t socket, int option, int value) {
  ::setsockopt(static_cast<SOCKET>(socket), SOL_SOCKET, option, reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Empty unless it is an IP address that a browser can use.
std::string textOf(const sockaddr* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address->sa_family == AF_INET) {
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, text.data(), text.size());
  } else if (address->sa_family == AF_INET6) {
    const in6_addr& v6 = reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr;
    if (IN6_IS_ADDR_LINKLOCAL(&v6) == 0) ::inet_ntop(AF_INET6, &v6, text.data(), text.size());
  }
  return text.data();
}

/// The system's list of adapters; empty where it gives none.
std::vector<unsigned char> listAdapters(ULONG family) {
  constexpr ULONG kWithout = GAA_FLAG_SKIP_ANYCAST | GAA_FLAG_SKIP_MULTICAST | GAA_FLAG_SKIP_DNS_SERVER;
  constexpr int kTries = 4;  // it may grow between two calls
  ULONG size = 16384;        // size that the system's documentation recommends, so that once is enough
  std::vector<unsigned char> list;
  for (int i = 0; i < kTries; ++i) {
    list.resize(size);
    const ULONG answer =
        ::GetAdaptersAddresses(family, kWithout, nullptr, reinterpret_cast<IP_ADAPTER_ADDRESSES*>(list.data()), &size);
    if (answer == ERROR_SUCCESS) return list;
    if (answer != ERROR_BUFFER_OVERFLOW) break;
  }
  return {};
}

}  // namespace

std::vector<std::string> ownAddresses(bool v6_too) {
  const std::vector<unsigned char> list = listAdapters(v6_too ? AF_UNSPEC : AF_INET);
  std::vector<std::string> addresses;
  const auto* at = list.empty() ? nullptr : reinterpret_cast<const IP_ADAPTER_ADDRESSES*>(list.data());
  for (; at != nullptr; at = at->Next) {
    if (at->OperStatus != IfOperStatusUp) continue;
    for (const auto* one = at->FirstUnicastAddress; one != nullptr; one = one->Next) {
      if (std::string found = textOf(one->Address.lpSockaddr); !found.empty()) addresses.push_back(std::move(found));
    }
  }
  return addresses;
}

void claimPort(std::intptr_t socket) { setOption(socket, SO_EXCLUSIVEADDRUSE, 1); }

void limitUnsent(std::intptr_t socket, int bytes) { setOption(socket, SO_SNDBUF, bytes); }

}  // namespace palpate::system
