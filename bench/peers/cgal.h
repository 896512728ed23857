#pragma once

#include "bench/peers/peer.h"

namespace palpate::bench {

Peer cgalPeer();

}  // namespace palpate::bench
