#include "cli/serve/own_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <memory>

#include "cli/serve/access.h"

namespace palpate::app::serving {

namespace {

std::string inBrackets(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

/// Empty for what is no IP address, or no use to a browser.
std::string hostOf(const sockaddr* address, bool v6_too) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address != nullptr && address->sa_family == AF_INET) {
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, text.data(), text.size());
  } else if (address != nullptr && address->sa_family == AF_INET6 && v6_too) {
    const in6_addr& v6 = reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr;
    if (!IN6_IS_ADDR_LINKLOCAL(&v6)) ::inet_ntop(AF_INET6, &v6, text.data(), text.size());
  }
  return inBrackets(text.data());
}

}  // namespace

std::vector<std::string> reachableHosts(const std::string& host) {
  const bool v6 = host == "::";
  if (!v6 && host != "0.0.0.0") return {inBrackets(host)};
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return {inBrackets(host)};
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> all(first, &::freeifaddrs);
  std::vector<std::string> hosts;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if ((at->ifa_flags & IFF_UP) == 0) continue;
    const std::string found = hostOf(at->ifa_addr, v6);
    if (!found.empty() && std::find(hosts.begin(), hosts.end(), found) == hosts.end()) hosts.push_back(found);
  }
  std::stable_partition(hosts.begin(), hosts.end(), [](const std::string& found) { return !isLoopback(found); });
  return hosts.empty() ? std::vector<std::string>{inBrackets(host)} : hosts;
}

}  // namespace palpate::app::serving
