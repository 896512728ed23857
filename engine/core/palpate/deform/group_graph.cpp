// Adjacency turned into words of 64: made when a skin is built, moved through by region_by_blocks.cpp.
#include "palpate/deform/group_graph.h"

#include <algorithm>

#include "palpate/deform/kernels/blocks.h"

namespace palpate::deform {

namespace {

struct EdgeOut {
  Index group;
  CrossEdge edge;
};

/// Splits the neighbours of a group's things into those inside and those in other groups.
std::vector<EdgeOut> sortedEdgesOut(const mesh::IndexRows& neighbours, Index group, GroupGraph& graph) {
  std::vector<EdgeOut> out;
  forEachBit(graph.members[group], [&](Index from) {
    const Index item = group * kBlockVertices + from;
    for (const Index other : neighbours[item]) {
      if (blockOf(other) == group) {
        graph.neighbours[item] |= bitOf(other);
      } else {
        const CrossEdge edge{static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(other % kBlockVertices)};
        out.push_back({blockOf(other), edge});
      }
    }
  });
  std::stable_sort(out.begin(), out.end(), [](const EdgeOut& a, const EdgeOut& b) { return a.group < b.group; });
  return out;
}

void appendLinks(const std::vector<EdgeOut>& edges, GroupGraph& graph) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto here = static_cast<Index>(graph.cross_edges.size());
    if (i == 0 || edges[i].group != edges[i - 1].group) graph.links.push_back({edges[i].group, here, here, 0, 0});
    graph.cross_edges.push_back(edges[i].edge);
    GroupLink& link = graph.links.back();
    link.end_edge = here + 1;
    link.from |= std::uint64_t{1} << edges[i].edge.from;
    link.to |= std::uint64_t{1} << edges[i].edge.to;
  }
}

}  // namespace

GroupGraph groupGraph(const mesh::IndexRows& neighbours) {
  GroupGraph graph;
  graph.groups = blocksFor(neighbours.rows());
  graph.neighbours.assign(std::size_t{graph.groups} * kBlockVertices, 0);
  graph.first_link.push_back(0);
  for (Index group = 0; group < graph.groups; ++group) {
    const Index count = std::min(kBlockVertices, neighbours.rows() - group * kBlockVertices);
    graph.members.push_back(~std::uint64_t{0} >> (kBlockVertices - count));
    appendLinks(sortedEdgesOut(neighbours, group, graph), graph);
    graph.first_link.push_back(static_cast<Index>(graph.links.size()));
  }
  return graph;
}

mesh::IndexRows neighboursOfGroups(const GroupGraph& graph) {
  mesh::IndexRows rows{graph.first_link, {}};
  for (const GroupLink& link : graph.links) rows.entries.push_back(link.group);
  return rows;
}

std::uint64_t grownWithin(const GroupGraph& graph, Index group, std::uint64_t start, std::uint64_t allowed) noexcept {
  const std::uint64_t* neighbours = graph.neighbours.data() + std::size_t{group} * kBlockVertices;
  std::uint64_t grown = start & allowed;
  // Ring by ring, until nothing is left to reach: the loads of one ring do not wait for each other.
  for (std::uint64_t ring = grown; ring != 0 && grown != allowed;) {
    std::uint64_t next = 0;
    for (; ring != 0; ring &= ring - 1) next |= neighbours[std::countr_zero(ring)];
    ring = next & allowed & ~grown;
    grown |= ring;
  }
  return grown;
}

std::uint64_t acrossLink(const GroupGraph& graph, const GroupLink& link, std::uint64_t from) noexcept {
  if ((from & link.from) == link.from) return link.to;
  if ((from & link.from) == 0) return 0;
  std::uint64_t to = 0;
  for (Index e = link.first_edge; e < link.end_edge; ++e) {
    const CrossEdge edge = graph.cross_edges[e];
    to |= (from >> edge.from & 1) << edge.to;
  }
  return to;
}

}  // namespace palpate::deform
