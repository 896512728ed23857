#pragma once

#include "bench/peers/peer.h"

namespace palpate::bench {

Peer embreePeer();
/// The same, but the point query starts with the distance that the last tick's proxy proves. Contact only.
Peer embreeToldPeer();

}  // namespace palpate::bench
