// Our finger and its peers in one process: the numbers of `palpate bench contact --peers`.
#pragma once

#include <span>
#include <vector>

#include "bench/peers/judge.h"
#include "bench/runs/contact_run.h"

namespace palpate::bench {

struct ContactComparison {
  ContactFigures ours;
  std::size_t queries = 0;        ///< ticks of the window
  std::size_t nearest_asked = 0;  ///< of these, with a nearest point to find; all have a segment
  std::vector<PeerFigures> peers;
};

/// Runs our finger, then puts the queries of its run to the peers. `seconds_per_peer` bounds the time of the queries,
/// not of building.
ContactComparison compareContact(ContactWorld& world, const device::Trajectory& trajectory,
                                 const contact::FingerSettings& real, const Window& window, std::span<const Peer> peers,
                                 double seconds_per_peer);

}  // namespace palpate::bench
