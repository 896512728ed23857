// The option --peers: ours compared with the libraries that people know, and the keys that it adds to a benchmark's
// report.
//
// The libraries are linked to a program of their own, palpate_peers, which is next to `palpate` in the build folder:
// one of them (CGAL) is under the GPL, and a command for all users should not depend on any of them. That program has
// the same benchmark commands and measures ours and theirs in one process; `palpate` hands over to it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/kit/options.h"
#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "palpate/base/json.h"

namespace palpate::app {

struct PeersOption {
  bool wanted = false;
  double seconds = 5.0;            ///< for the queries of each peer
  std::vector<bench::Peer> peers;  ///< in this program
  std::vector<bench::ToolPeer> tool_peers = bench::toolPeersWithoutLibraries();
};

/// Adds --peers and --peer-seconds. `option` must outlive the command.
void addPeersOption(Command& command, PeersOption& option);

/// In `palpate`: runs palpate_peers in place of this program, with the same arguments, and does not return if there is
/// one. In palpate_peers: nothing.
void handOverToPeersProgram(const PeersOption& option);

/// The benchmark commands with the peers that a program has; those of commands.h have none of the libraries.
void addBenchContactCommand(Command& parent, std::vector<bench::Peer> peers, std::vector<bench::ToolPeer> tool_peers);
void addBenchPartitionCommand(Command& parent, std::vector<bench::Peer> peers);

/// A benchmark's task for its peers: the names of its own keys.
enum class PeerTask { contact, boxes, tool };

/// Adds `peers` and `ratio_to` (ours over theirs at p50) to the report of ours.
void addPeers(Json& json, std::span<const bench::PeerFigures> peers, PeerTask task, double ours_p50);

}  // namespace palpate::app
