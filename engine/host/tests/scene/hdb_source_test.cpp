#include "palpate/scene/hdb_source.h"

#include <gtest/gtest.h>

#include "palpate/mesh/repair.h"
#include "palpate/scene/scene_file.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"

namespace palpate::scene {
namespace {

/// A plate of 100 mm with its surface.
class HdbSource : public ::testing::Test {
 protected:
  std::shared_ptr<const hdb::HdbSurface> buildSource(const Scene& scene) const {
    return buildHdbSource(scene, plate_, surface_);
  }
  std::string thrownMessage(const Scene& scene) const {
    return support::thrownMessage([&] { buildSource(scene); });
  }

  const mesh::TriangleMesh plate_ = mesh::repair(zoo::grid(20, 100.0)).mesh;
  const contact::Surface surface_ = contact::buildSurface(plate_, std::vector<double>(plate_.positions.size(), 0.5));
};

TEST_F(HdbSource, TheBoxIsACubeOfAQuarterOfTheLongestEdge) {
  Scene scene;
  EXPECT_TRUE(buildSource(scene)->settings.edges_mm.isApprox(Vec3(25, 25, 25)));
  scene.partition.hdb_fraction = 0.5;
  EXPECT_TRUE(buildSource(scene)->settings.edges_mm.isApprox(Vec3(50, 50, 50)));
  scene.partition.hdb_edge_mm = 30.0;
  EXPECT_TRUE(buildSource(scene)->settings.edges_mm.isApprox(Vec3(30, 30, 30)));
  scene.partition.hdb_edge_mm = 0.5;
  EXPECT_TRUE(buildSource(scene)->settings.edges_mm.isApprox(Vec3(0.5, 0.5, 0.5)));
}

TEST_F(HdbSource, ErrataOfChapterThreeAreSwitchedByTheirNumbers) {
  Scene scene;
  scene.partition.build.tree = hdb::TreeKind::Bsp;
  EXPECT_FALSE(buildSource(scene)->settings.literal.has_value());
  scene.fidelity.setLiteral(Erratum::E4_else_if);
  EXPECT_EQ(buildSource(scene)->settings.literal, hdb::LiteralTraversal::ElseIf);
  scene.fidelity = {};
  scene.fidelity.setLiteral(Erratum::E10_half_spaces);
  EXPECT_EQ(buildSource(scene)->settings.literal, hdb::LiteralTraversal::HalfSpace);
  scene.fidelity = {};
  scene.fidelity.setLiteral(Erratum::E5_cell_box);
  EXPECT_EQ(buildSource(scene)->settings.literal, hdb::LiteralTraversal::CellBox);
  scene.partition.query = hdb::HdbQuery::coherent;
  EXPECT_FALSE(buildSource(scene)->settings.literal.has_value()) << "the text knows leaves only";
}

TEST_F(HdbSource, TheOctreeAsPrintedLosesTriangles) {
  Scene scene;
  scene.partition.build.threshold = 16;
  const auto listed = [&] { return buildSource(scene)->partition->triangles.size(); };
  EXPECT_EQ(listed(), plate_.triangles.size());
  scene.fidelity.setLiteral(Erratum::E6_three_octants);
  EXPECT_LE(listed(), plate_.triangles.size());
}

TEST_F(HdbSource, ANamedTraversalNeedsItsTree) {
  Scene scene;
  scene.partition.traversal = hdb::LiteralTraversal::ElseIf;
  EXPECT_EQ(thrownMessage(scene), "hdb source: this traversal needs the planes of a BSP tree");
  scene.partition.build.tree = hdb::TreeKind::Bsp;
  EXPECT_EQ(thrownMessage(scene), "no error");
}

TEST_F(HdbSource, RefusesFingersThatItCannotServe) {
  Scene scene =
      parse("[contact]\nsource = \"hdb\"\n[[finger]]\nname = \"thumb\"\nradius_mm = 8\nscript = [{ do = \"press\" }]\n",
            "s.toml");
  EXPECT_EQ(thrownMessage(scene),
            "contact source \"hdb\" supports point fingers only: finger 'thumb' must have radius_mm = 0, not 8");
  scene.fingers[0].radius_mm = 0.0;
  EXPECT_EQ(thrownMessage(scene), "no error");
  scene.contact.finger.force_shading = true;
  EXPECT_EQ(thrownMessage(scene), "contact source \"hdb\" does not support force_shading; set it to false");
}

TEST_F(HdbSource, ARefreshIsAWholeNumberOfTicks) {
  Scene scene;
  EXPECT_EQ(buildSource(scene)->settings.ticks_per_refresh, 1u);
  scene.partition.refresh_s = 0.033;
  EXPECT_EQ(buildSource(scene)->settings.ticks_per_refresh, 33u);
}

}  // namespace
}  // namespace palpate::scene
