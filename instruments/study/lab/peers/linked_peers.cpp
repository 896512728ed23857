// The libraries that were found at build time, in the places of those of their name.
#include "lab/peers/peer.h"

namespace palpate::bench {

namespace {

/// In the place of the one of its name, which can do nothing.
template <class OnePeer>
[[maybe_unused]] void put(const OnePeer& peer, std::vector<OnePeer>& peers) {
  for (OnePeer& place : peers) {
    if (place.name == peer.name) place = peer;
  }
}

}  // namespace

std::vector<Peer> linkedPeers() {
  std::vector<Peer> peers = peersWithoutLibraries();
#ifdef PALPATE_HAS_EMBREE
  put(embreePeer(), peers);
  peers.insert(peers.begin() + 1, embreeBoundedPeer());
#endif
#ifdef PALPATE_HAS_CGAL
  put(cgalPeer(), peers);
#endif
#ifdef PALPATE_HAS_FCL
  put(fclPeer(), peers);
#endif
  return peers;
}

std::vector<ToolPeer> linkedToolPeers() {
  std::vector<ToolPeer> peers = toolPeersWithoutLibraries();
#ifdef PALPATE_HAS_BULLET
  put(bulletToolPeer(), peers);
#endif
#ifdef PALPATE_HAS_FCL
  put(fclToolPeer(), peers);
#endif
  return peers;
}

}  // namespace palpate::bench
