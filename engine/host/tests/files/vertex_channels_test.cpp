// Numbers and colours of a PLY file's vertices: what is read, and that they stay with their vertices.
#include "palpate/mesh/files/vertex_channels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/repair.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {
namespace {

using Colours = std::vector<std::array<std::uint8_t, 3>>;

MeshWithChannels plyOf(const std::string& properties, const std::string& rows, const LoadOptions& options = {}) {
  const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n" + properties +
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + rows + "3 0 1 2\n";
  return loadWithChannelsFromMemory(text, Format::ply, "t.ply", options);
}

/// Every vertex carries its own height as a number.
VertexChannels heightsOf(const TriangleMesh& mesh) {
  VertexChannels channels;
  channels.scalars = {{"height", {}}};
  for (const Vec3& p : mesh.positions) {
    channels.scalars[0].values.push_back(static_cast<float>(p.z()));
    channels.colours.push_back({static_cast<std::uint8_t>(p.z() > 0.0 ? 200 : 20), 1, 2});
  }
  return channels;
}

TEST(VertexChannels, AreReadByTheirNamesWhereverTheyStand) {
  const auto [mesh, channels, notes] = plyOf(
      "property float quality\nproperty float x\nproperty float nx\nproperty float y\nproperty float z\n"
      "property list uchar int ring\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty int "
      "label\n",
      "0.5 0 9 0 0 2 7 7 255 0 10 3\n1.5 1 9 0 0 0 0 255 20 4\nnan 0 9 1 0 1 7 1 2 3 5\n");
  ASSERT_EQ(channels.scalars.size(), 2u);
  EXPECT_EQ(channels.scalars[0].name, "quality");
  EXPECT_EQ(channels.scalars[0].values[1], 1.5f);
  EXPECT_TRUE(std::isnan(channels.scalars[0].values[2]));
  EXPECT_EQ(channels.scalars[1].name, "label");
  EXPECT_EQ(channels.scalars[1].values, (std::vector<float>{3, 4, 5}));
  EXPECT_EQ(channels.colours, (Colours{{255, 0, 10}, {0, 255, 20}, {1, 2, 3}}));
  EXPECT_EQ(mesh.positions[1], Vec3::UnitX());
}

TEST(VertexChannels, TakeColoursInTheOtherWaysTheyAreWritten) {
  const auto [mesh, channels, notes] = plyOf(
      "property float x\nproperty float y\nproperty float z\nproperty float diffuse_red\nproperty float diffuse_green\n"
      "property float diffuse_blue\n",
      "0 0 0 1 0 0.5\n1 0 0 2 -1 0.2\n0 1 0 0 0 0\n");
  EXPECT_EQ(channels.colours, (Colours{{255, 0, 128}, {255, 0, 51}, {0, 0, 0}}));
  EXPECT_TRUE(channels.scalars.empty());
}

TEST(VertexChannels, ComeBackAsTheyWereSaved) {
  const support::TemporaryFolder folder;
  const TriangleMesh torus = zoo::torus();
  const VertexChannels saved = heightsOf(torus);
  save(folder / "torus.ply", torus, saved);
  const auto [mesh, channels, notes] = loadWithChannels(folder / "torus.ply");
  EXPECT_EQ(mesh.positions, torus.positions);
  ASSERT_EQ(channels.scalars.size(), 1u);
  EXPECT_EQ(channels.scalars[0].values, saved.scalars[0].values);
  EXPECT_EQ(channels.colours, saved.colours);
  save(folder / "torus.obj", torus);
  EXPECT_TRUE(loadWithChannels(folder / "torus.obj").channels.empty());
}

TEST(VertexChannels, StayWithTheirVerticesThroughWeldingAndRepair) {
  const support::TemporaryFolder folder;
  TriangleMesh torn = zoo::torus();
  const auto first = static_cast<Index>(torn.positions.size());
  torn.positions.emplace_back(0, 0, 77);  // used by nothing
  for (const Index corner : torn.triangles[5]) torn.positions.push_back(torn.positions[corner]);
  torn.triangles[5] = {first + 1, first + 2, first + 3};  // torn off its neighbours
  save(folder / "torn.ply", torn, heightsOf(torn));
  for (const bool weld : {false, true}) {
    LoadOptions options;
    options.weld = weld;
    auto [mesh, channels, notes] = loadWithChannels(folder / "torn.ply", options);
    ASSERT_EQ(channels.colours.size(), mesh.positions.size());
    const RepairResult repaired = repair(std::move(mesh));
    const VertexChannels after = followed(channels, repaired.source_vertex);
    ASSERT_EQ(repaired.mesh.positions.size(), zoo::torus().positions.size());
    for (std::size_t v = 0; v < repaired.mesh.positions.size(); ++v) {
      EXPECT_EQ(after.scalars[0].values[v], static_cast<float>(repaired.mesh.positions[v].z()));
      EXPECT_EQ(after.colours[v][0], repaired.mesh.positions[v].z() > 0.0 ? 200 : 20);
    }
  }
}

}  // namespace
}  // namespace palpate::mesh
