// Our finger and its peers in one process: what each peer answered becomes figures, and every answer is checked: a fast
// wrong one must show. The numbers of `palpate study bench contact --peers` and `palpate study bench partition
// --peers`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/counters/statistics.h"
#include "lab/peers/peer.h"

namespace palpate::bench {

struct PeerFigures {
  std::string name;
  std::string package;
  std::string skipped;  ///< why there are no figures; empty: there are
  std::size_t queries = 0;
  lab::Percentiles query_us;
  double build_ns_per_triangle = 0.0;
  std::optional<double> bytes_per_triangle;
  std::size_t disagreements = 0;  ///< answers other than ours by more than single precision explains
  std::uint64_t hash = 0;         ///< hash of every bit of every answer
  // Contact
  double mean_distance_mm = 0.0;  ///< mean distance of the nearest points
  std::size_t hits = 0;           ///< segments that cross the surface
  // Boxes
  double mean_triangles = 0.0;
  // Tools
  double mean_touching = 0.0;  ///< pads
};

/// Builds, queries and checks each peer, one after the other; peers that cannot do it are left out. `mesh` is the
/// world's own, repaired.
std::vector<PeerFigures> comparePeers(std::span<const Peer> peers, const ContactWorld& world,
                                      std::span<const ContactQuery> queries, double seconds_per_peer);
std::vector<PeerFigures> comparePeers(std::span<const Peer> peers, const mesh::TriangleMesh& mesh,
                                      std::span<const Box3> boxes, double seconds_per_peer);

/// The same of a tool in a world of scale 1.
std::vector<PeerFigures> comparePeers(std::span<const ToolPeer> peers, const ContactWorld& world,
                                      const ToolQueries& queries, double seconds_per_peer);

struct ContactComparison {
  ContactFigures ours;
  std::size_t queries = 0;        ///< ticks of the window
  std::size_t nearest_asked = 0;  ///< those with a nearest point to find; all have a segment
  std::vector<PeerFigures> peers;
};

/// Runs our finger, then puts the queries of its run to the peers. `seconds_per_peer` bounds the time of the queries,
/// not of building.
ContactComparison compareContact(ContactWorld& world, const device::Trajectory& trajectory,
                                 const contact::FingerSettings& real, const Window& window, std::span<const Peer> peers,
                                 double seconds_per_peer);

}  // namespace palpate::bench
