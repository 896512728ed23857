#include "bench/peers/peer.h"
#include "bench/peers/peer_kinds.h"

namespace palpate::bench {

std::vector<Peer> peersWithoutLibraries() {
  return {{"embree", "libembree-dev"}, {"cgal", "libcgal-dev"}, {"fcl", "libfcl-dev"}, literalPeer()};
}

}  // namespace palpate::bench
