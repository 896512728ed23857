#include "bench/peers/literal.h"
#include "bench/peers/peer_list.h"

namespace palpate::bench {

std::vector<Peer> peersWithoutLibraries() {
  return {{"embree", "libembree-dev"}, {"cgal", "libcgal-dev"}, {"fcl", "libfcl-dev"}, literalPeer()};
}

}  // namespace palpate::bench
