#include "palpate/hdb/literal_traversal.h"

#include <gtest/gtest.h>

#include "core/tests/hdb/partition_judges.h"
#include "palpate/hdb/literal_octree.h"
#include "support/golden.h"

namespace palpate::hdb {

using palpate::test::goldenRows;

namespace {

struct Seen {
  std::size_t rendered = 0;
  std::size_t missed = 0;
  QueryCost cost;
};

Seen look(const Partition& partition, LiteralTraversal traversal, const Box3& box, const std::set<Index>& must) {
  LeafHits hits;
  findLeavesLiterally(partition, traversal, box, hits);
  return {entriesIn(partition, hits.leaves), test::missing(must, test::trianglesOfLeaves(partition, hits.leaves)),
          hits.cost};
}

void expectAsPrinted(const Seen& seen, const nlohmann::json& expected) {
  EXPECT_EQ(seen.rendered, expected.at("rendered").get<std::size_t>());
  EXPECT_EQ(seen.missed, expected.at("missed").get<std::size_t>());
}

}  // namespace

TEST(LiteralTraversal, RendersAndMissesWhatTheGoldenFileSays) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const nlohmann::json& item : goldenRows("hdb_query", "cases")) {
    const auto threshold = item.at("threshold").get<Index>();
    const Partition bsp = buildPartition(mesh, {.tree = TreeKind::Bsp, .threshold = threshold});
    const Partition octree = buildPartition(mesh, {.tree = TreeKind::Octree, .threshold = threshold});
    for (const nlohmann::json& query : item.at("queries")) {
      const Box3 box = hapticBox(palpate::test::vec3(query.at("center")), 100.0);
      const std::set<Index> must = test::trianglesMeeting(mesh, box);
      SCOPED_TRACE("threshold " + std::to_string(threshold) + " query " + query.at("center").dump());

      const Seen else_if = look(bsp, LiteralTraversal::ElseIf, box, must);
      expectAsPrinted(else_if, query.at("bsp_printed"));
      EXPECT_EQ(else_if.cost.nodes_entered, query.at("bsp_printed").at("visited").get<Index>());
      const Seen half_space = look(bsp, LiteralTraversal::HalfSpace, box, must);
      expectAsPrinted(half_space, query.at("bsp_halfspace"));
      EXPECT_EQ(half_space.cost.nodes_entered, query.at("bsp_halfspace").at("visited").get<Index>());
      const Seen cells = look(octree, LiteralTraversal::CellBox, box, must);
      expectAsPrinted(cells, query.at("oct_box"));
      EXPECT_EQ(cells.cost.nodes_tested, query.at("oct_box").at("visited").get<Index>());
    }
  }
}

TEST(LiteralTraversal, SphereCornersMissABoxAroundTheProxyAndOneThatComesInThroughAFace) {  // E11
  // One leaf, the cube from 0 to 10: the sphere touches its face but no corner, or lies inside it.
  const Partition partition = buildPartition(zoo::cube(10.0), {});
  LeafHits literal, corrected;
  for (const Vec3& centre : {Vec3(12, 5, 5), Vec3(9, 5, 5), Vec3(5, 5, 5)}) {
    findLeavesLiterally(partition, LiteralTraversal::SphereCorners, hapticBox(centre, 6.0), literal);
    findLeavesInSphere(partition, centre, 3.0, corrected);
    EXPECT_TRUE(literal.leaves.empty());
    EXPECT_EQ(corrected.leaves.size(), 1u);
  }
  findLeavesLiterally(partition, LiteralTraversal::SphereCorners, hapticBox(Vec3(11, 11, 11), 6.0), literal);
  EXPECT_EQ(literal.leaves.size(), 1u);
  findLeavesLiterally(partition, LiteralTraversal::SphereCorners, hapticBox(Vec3(12, 12, 12), 6.0), literal);
  EXPECT_TRUE(literal.leaves.empty()) << "the corner is 3.5 from the centre, the radius 3";
}

TEST(LiteralTraversal, PlanesSuitTheBspTreeOnly) {
  EXPECT_TRUE(suits(LiteralTraversal::ElseIf, TreeKind::Bsp));
  EXPECT_FALSE(suits(LiteralTraversal::ElseIf, TreeKind::Octree));
  EXPECT_FALSE(suits(LiteralTraversal::HalfSpace, TreeKind::Octree));
  EXPECT_TRUE(suits(LiteralTraversal::CellBox, TreeKind::Octree));
  LeafHits hits;
  findLeavesLiterally(buildPartition(zoo::cube(), {}), LiteralTraversal::ElseIf, hapticBox(Vec3::Zero(), 9), hits);
  EXPECT_TRUE(hits.leaves.empty());
}

TEST(LiteralTraversal, EachErratumAsksForItsOwnForm) {
  const auto with = [](Erratum erratum) {
    Fidelity fidelity;
    fidelity.setLiteral(erratum);
    return fidelity;
  };
  EXPECT_EQ(literalTraversal({}, TreeKind::Bsp), std::nullopt);
  EXPECT_EQ(literalTraversal(with(Erratum::E4_else_if), TreeKind::Bsp), LiteralTraversal::ElseIf);
  EXPECT_EQ(literalTraversal(with(Erratum::E4_else_if), TreeKind::Octree), std::nullopt);
  EXPECT_EQ(literalTraversal(with(Erratum::E10_half_spaces), TreeKind::Bsp), LiteralTraversal::HalfSpace);
  EXPECT_EQ(literalTraversal(with(Erratum::E5_cell_box), TreeKind::Octree), LiteralTraversal::CellBox);
  EXPECT_EQ(literalTraversal(with(Erratum::E11_sphere_corners), TreeKind::Octree), LiteralTraversal::SphereCorners);
  EXPECT_EQ(literalTraversal(literalFidelity(), TreeKind::Bsp), LiteralTraversal::ElseIf);
  EXPECT_EQ(literalTraversal(literalFidelity(), TreeKind::Octree), LiteralTraversal::CellBox);
}

TEST(LiteralOctree, LosesAsManyTrianglesAsTheGoldenFileSays) {  // E6
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const nlohmann::json& item : goldenRows("hdb_query", "cases")) {
    const LiteralOctree literal = buildLiteralOctree(mesh, {.threshold = item.at("threshold").get<Index>()});
    EXPECT_EQ(literal.lost.size(), item.at("octree_triangles_lost_by_printed_2_of_3_rule").get<std::size_t>());
    EXPECT_EQ(literal.partition.triangles.size() + literal.lost.size(), mesh.triangles.size());
  }
}

TEST(LiteralOctree, PutsTrianglesWhereTheGoldenFileSays) {
  for (const nlohmann::json& row : goldenRows("triangle_assignment", "octree")) {
    SCOPED_TRACE(row.at("tri").dump());
    mesh::TriangleMesh mesh;  // with a frame that puts the first planes through the origin
    for (const auto& corner : row.at("tri")) mesh.positions.push_back(palpate::test::vec3(corner));
    mesh.positions.insert(mesh.positions.end(), {{-8, -8, -8}, {8, 8, 8}});
    mesh.triangles = {{0, 1, 2}, {3, 3, 3}, {4, 4, 4}};
    const LiteralOctree literal = buildLiteralOctree(mesh, {.threshold = 2});
    if (row.at("two_of_three").is_null()) {
      EXPECT_EQ(literal.lost, std::vector<Index>{0});
      continue;
    }
    EXPECT_TRUE(literal.lost.empty());
    const Node& root = literal.partition.nodes[0];
    for (Index c = root.first_child; c < root.first_child + root.child_count; ++c) {
      const auto triangles = trianglesOf(literal.partition, literal.partition.nodes[c]);
      const bool here = std::find(triangles.begin(), triangles.end(), 0u) != triangles.end();
      EXPECT_EQ(here, literal.partition.nodes[c].slot == row.at("two_of_three").get<int>());
    }
  }
}

TEST(LiteralOctree, HasTheNodesOfTheMajorityTree) {
  std::vector<zoo::Specimen> meshes = test::buildableZoo();
  meshes.push_back({"golden back", test::goldenBack()});
  for (const zoo::Specimen& specimen : meshes) {
    SCOPED_TRACE(specimen.name);
    const LiteralOctree literal = buildLiteralOctree(specimen.mesh, {.threshold = 4});
    const Partition majority = buildPartition(specimen.mesh, {.threshold = 4});
    EXPECT_EQ(literal.partition.tree_node_count, majority.tree_node_count);
    EXPECT_EQ(literal.partition.leaves.size(), majority.leaves.size());
  }
}

TEST(LiteralOctree, HandlesEveryMesh) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    SCOPED_TRACE(specimen.name);
    const LiteralOctree literal = buildLiteralOctree(specimen.mesh, {.threshold = 1});
    EXPECT_EQ(literal.partition.triangles.size() + literal.lost.size(), specimen.mesh.triangles.size());
    LeafHits hits;
    findLeaves(literal.partition, test::computeBox(specimen.mesh), hits);
    EXPECT_EQ(entriesIn(literal.partition, hits.leaves), literal.partition.triangles.size());
  }
}

}  // namespace palpate::hdb
