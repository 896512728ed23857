#include "palpate/deform/skin.h"

#include <gtest/gtest.h>

#include "core/tests/deform/shapes.h"

namespace palpate::deform {

TEST(GroupGraph, HasEveryEdgeOnceWithinOrAcross) {
  const mesh::TriangleMesh torso = test::torso();
  const Skin skin = buildSkin(torso);
  const GroupGraph& graph = skin.vertex_graph;
  std::size_t edges = graph.cross_edges.size();
  for (const std::uint64_t word : graph.neighbours) edges += static_cast<std::size_t>(std::popcount(word));
  EXPECT_EQ(edges, skin.neighbours.entries.size());
  for (Index block = 0; block < graph.groups; ++block) {
    for (const GroupLink& link : graph.linksOf(block)) {
      EXPECT_NE(link.group, block);
      EXPECT_EQ(acrossLink(graph, link, ~std::uint64_t{0}), link.to);
      EXPECT_EQ(acrossLink(graph, link, ~link.from), 0u);
    }
  }
}

// Every single vertex of a block: what it reaches across a link is what its own edges say.
TEST(GroupGraph, CrossesALinkFromEachVertex) {
  const mesh::TriangleMesh torso = test::torso(2);
  const Skin skin = buildSkin(torso);
  const GroupGraph& graph = skin.vertex_graph;
  for (Index v = 0; v < skin.vertices; ++v) {
    for (const GroupLink& link : graph.linksOf(blockOf(v))) {
      std::uint64_t expected = 0;
      for (const Index w : skin.neighbours[v]) expected |= blockOf(w) == link.group ? bitOf(w) : 0;
      EXPECT_EQ(acrossLink(graph, link, bitOf(v)), expected);
    }
  }
}

TEST(GroupGraph, GrowsOnlyThroughWhatIsAllowed) {
  // A chain of eight things.
  mesh::IndexRows chain{{0}, {}};
  for (Index i = 0; i < 8; ++i) {
    if (i > 0) chain.entries.push_back(i - 1);
    if (i < 7) chain.entries.push_back(i + 1);
    chain.offsets.push_back(static_cast<Index>(chain.entries.size()));
  }
  const GroupGraph graph = groupGraph(chain);
  EXPECT_EQ(graph.members, (std::vector<std::uint64_t>{0xff}));
  EXPECT_EQ(grownWithin(graph, 0, 0b00000001, 0b11101111), 0b00001111u);
  EXPECT_EQ(grownWithin(graph, 0, 0b10000001, 0b11101111), 0b11101111u);
  EXPECT_EQ(grownWithin(graph, 0, 0b00010000, 0b11101111), 0u);
}

}  // namespace palpate::deform
