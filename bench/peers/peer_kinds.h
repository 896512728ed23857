// The literal dissertation (bench/literal/hdb_contact.h) as a peer: it needs no library.
#pragma once

#include "bench/peers/peer.h"

namespace palpate::bench {

Peer cgalPeer();

Peer embreePeer();
/// The same, but the point query starts with the distance that the last tick's proxy proves. Contact only.
Peer embreeToldPeer();

Peer fclPeer();

Peer literalPeer();

}  // namespace palpate::bench
