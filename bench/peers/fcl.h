#pragma once

#include "bench/peers/peer.h"

namespace palpate::bench {

Peer fclPeer();

}  // namespace palpate::bench
