// What a server asks the system about its network. Sockets are named by their numbers (handles on Windows).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::system {

/// The IP addresses of those of this computer's interfaces that are up, loopback among them. Link-local ones of IPv6
/// are left out: nobody can name their interface in a browser.
std::vector<std::string> ownAddresses(bool v6_too);

/// Before the socket is bound: its port is nobody else's, and one that ended a moment ago does not keep it.
void claimPort(std::intptr_t socket);

/// How much of what was sent may wait in the system for a reader that is slow; where it cannot be set, more does.
void limitUnsent(std::intptr_t socket, int bytes);

}  // namespace palpate::system
