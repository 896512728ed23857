// Connections of things in groups of 64: a search moves through it with whole words, one bit a thing.
//
// The skin has two of these, one above the other: vertices in blocks, and blocks in tiles. Edges within a group are one
// word a thing; edges between two groups are collected in a link with its ends, so that a group that is reached as a
// whole crosses it in one step.
#pragma once

#include <span>

#include "palpate/mesh/topology.h"

namespace palpate::deform {

/// An edge between two groups: thing `from` of this group, thing `to` of the other (both within their group).
struct CrossEdge {
  std::uint8_t from;
  std::uint8_t to;
};

/// All edges from one group to one other.
struct GroupLink {
  Index group;
  Index first_edge;  ///< in GroupGraph::cross_edges
  Index end_edge;
  std::uint64_t from;  ///< things of this group that have such an edge
  std::uint64_t to;    ///< things of the other group that they reach
};

struct GroupGraph {
  Index groups = 0;
  std::vector<std::uint64_t> members;     ///< per group: which of its 64 places are taken
  std::vector<std::uint64_t> neighbours;  ///< per thing (padded to whole groups): those within its group
  std::vector<Index> first_link;          ///< per group, groups + 1 entries
  std::vector<GroupLink> links;
  std::vector<CrossEdge> cross_edges;

  std::span<const GroupLink> linksOf(Index group) const {
    return {links.data() + first_link[group], links.data() + first_link[group + 1]};
  }
};

/// Graph of things by their neighbours (row i: those joined to thing i; symmetric).
GroupGraph groupGraph(const mesh::IndexRows& neighbours);

/// The same things one level up: groups, joined where a link is.
mesh::IndexRows neighboursOfGroups(const GroupGraph& graph);

/// The things of `allowed` that are connected with `start` within a group.
std::uint64_t grownWithin(const GroupGraph& graph, Index group, std::uint64_t start, std::uint64_t allowed) noexcept;

/// The things of the linked group that have an edge to one of `from`.
std::uint64_t acrossLink(const GroupGraph& graph, const GroupLink& link, std::uint64_t from) noexcept;

}  // namespace palpate::deform
