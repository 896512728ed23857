// The keys and lines that `--peers` adds to a benchmark's report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "bench/peers/judge.h"

namespace palpate::app {

/// What a benchmark asks of its peers: the names of its own keys.
enum class PeerTask { contact, boxes };

/// Adds `peers` and `ratio_to` (ours over theirs at p50) to the report of ours.
void addPeers(nlohmann::ordered_json& json, std::span<const bench::PeerFigures> peers, PeerTask task, double ours_p50);

/// A line or two a peer.
std::string peersText(std::span<const bench::PeerFigures> peers, PeerTask task, double ours_p50);

}  // namespace palpate::app
