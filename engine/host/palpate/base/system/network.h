// A server's requests to the system about its network. Sockets are named by their numbers (handles on Windows).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::system {

/// The IP addresses of those of this computer's interfaces that are up, loopback among them, in the order in which the
/// system has them; none if unknown. Link-local ones of IPv6 are left out: users cannot name their interface in a
/// browser.
std::vector<std::string> ownAddresses(bool v6_too);

/// Call before the socket is bound: reserves its port, which a socket that ended a moment ago does not keep.
///
/// POSIX refuses a second socket at the port in any case, and SO_REUSEADDR only frees it from connections that ended.
/// On Windows the option of that name would let any program listen there, too, and take half of the connections;
/// SO_EXCLUSIVEADDRUSE is what is meant.
void claimPort(std::intptr_t socket);

/// Limits the sent bytes that wait in the system for a slow reader; where it cannot be set, more do. Windows does not
/// separate unsent from unacknowledged data: there it is both together (SO_SNDBUF).
void limitUnsent(std::intptr_t socket, int bytes);

}  // namespace palpate::system
