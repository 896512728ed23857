#include "palpate/deform/fast_displacement.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/tests/deform/shapes.h"
#include "palpate/mesh/reorder.h"

namespace palpate::deform {

ContactLanes lanesFor(const Contact& contact) { return lanesOf(frameOf(contact, {}), 0.0, Vec3::Zero()); }

// A block taken as whole has every vertex inside, and one left alone none, as the test of single vertices sees it.
TEST(BlockBounds, SayNothingThatTheVerticesDeny) {
  for (mesh::TriangleMesh mesh : {lab::backMesh(200000), test::torso(6)}) {
    mesh::reorderSpatially(mesh);
    const Skin skin = buildSkin(mesh);
    Random random(3);
    Index whole = 0;
    Index facing = 0;
    Index left_alone = 0;
    for (int i = 0; i < 50; ++i) {
      const ContactLanes lanes = lanesFor(test::anyContact(mesh, random));
      for (Index block = 0; block < skin.blocks; ++block) {
        const BlocksInside inside = insideBlocks(lanes, skin.tileBounds(blockOf(block)));
        const std::uint64_t members = skin.vertex_graph.members[block];
        const bool is_level = (inside.level & bitOf(block)) != 0;
        const VerticesInside places = verticesInside(lanes, skin.restBlock(block), {is_level, false});
        const std::uint64_t vertices = places.facing & members;
        if ((inside.whole & bitOf(block)) != 0) {
          ++whole;
          EXPECT_EQ(vertices, members);
        }
        if ((inside.facing & bitOf(block)) != 0) {
          ++facing;
          const VerticesInside unasked = verticesInside(lanes, skin.restBlock(block), {is_level, true});
          EXPECT_EQ(unasked.facing & members, vertices);
          EXPECT_EQ(places.steep & members, 0u);
        }
        if ((inside.touched & bitOf(block)) == 0) {
          ++left_alone;
          EXPECT_EQ((places.facing | places.steep) & members, 0u);
        }
      }
    }
    EXPECT_GT(whole, 100u);
    EXPECT_GT(facing, 10000u);
    EXPECT_GT(left_alone, 10000u);
  }
}

TEST(BlockBounds, LeaveABlockWithoutNumbersToItsVertices) {
  auto mesh = zoo::grid(4, 40.0);
  const Contact contact = test::press(mesh, 15, 8.0);
  mesh.positions[3].x() = std::numeric_limits<double>::quiet_NaN();
  const Skin skin = buildSkin(mesh);
  const BlocksInside inside = insideBlocks(lanesFor(contact), skin.tileBounds(0));
  EXPECT_EQ(inside.whole & 1, 0u);
  EXPECT_EQ(inside.touched & 1, 1u);
}

// The kernel without masks writes what the one with masks writes, bit by bit.
TEST(BlockBounds, WholeRunsAreDisplacedLikeSingleBlocks) {
  mesh::TriangleMesh mesh = lab::backMesh(41582);
  mesh::reorderSpatially(mesh);
  const Skin skin = buildSkin(mesh);
  Contact contact = test::press(mesh, test::triangleNear(mesh, {175, 200, 0}), 8.0);
  contact.normal_region = maps::liftedOntoSurface({1000.0, 1.0}, contact.normal);
  for (const Vec3& along : {Vec3(0, 0, 0), Vec3(6, 0, 0)}) {
    const EllipseContact frame = frameOf(test::drag(contact, along), {});
    const ContactLanes lanes = lanesOf(frame, 8.0, frame.drag_mm);
    const Index blocks = 5;
    FloatStreams single(9, std::size_t{blocks} * kBlockVertices, 0);
    FloatStreams run = single;
    const auto at = [](FloatStreams& streams, Index block) {
      DeformedBlock out{};
      for (std::size_t i = 0; i < 9; ++i) out.values[i] = streams[i] + std::size_t{block} * kBlockVertices;
      return out;
    };
    for (Index block = 0; block < blocks; ++block) {
      const ContactOnBlock on{&lanes, ~std::uint64_t{0}, true};
      displaceBlock({&on, 1}, skin.restBlock(block), at(single, block));
    }
    displaceWholeBlocks(lanes, blocks, skin.restBlock(0), at(run, 0));
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t floats = std::size_t{blocks} * kBlockVertices;
      EXPECT_TRUE(std::equal(single[i], single[i] + floats, run[i])) << "stream " << i;
    }
  }
}

}  // namespace palpate::deform
