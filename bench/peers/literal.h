// The literal dissertation (bench/literal/hdb_contact.h) as a peer: it needs no library.
#pragma once

#include "bench/peers/peer.h"

namespace palpate::bench {

Peer literalPeer();

}  // namespace palpate::bench
