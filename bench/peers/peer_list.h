// Which peers there are, and which of them this program was built with.
#pragma once

#include <vector>

#include "bench/peers/peer.h"

namespace palpate::bench {

/// All peers, in the order of reports. Those of libraries that were not found at build time cannot do anything. For
/// programs that link the target palpate_peer_libraries only.
std::vector<Peer> linkedPeers();

/// For every other program: the literal dissertation can, the libraries cannot.
std::vector<Peer> peersWithoutLibraries();

}  // namespace palpate::bench
