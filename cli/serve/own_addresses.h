// Under which addresses a browser reaches what listens at an address of this computer.
#pragma once

#include <string>
#include <vector>

namespace palpate::app::serving {

/// The address itself; for 0.0.0.0 and :: those of this computer's interfaces that are up, loopback last. IPv6 in
/// brackets, link-local ones left out: a browser cannot name their interface.
std::vector<std::string> reachableHosts(const std::string& host);

}  // namespace palpate::app::serving
