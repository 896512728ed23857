// What a PLY brings for its vertices, on the skin that was made of it.
#include "palpate/scene/skin_channels.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "host/tests/scene/dome_scene.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::scene {
namespace {

class ChannelsOf : public DomeScene {
 protected:
  /// The dome with its height as a number of each vertex, in an order that is not that of space.
  Scene dome(const std::string& more = "") const {
    writeDome("plain.obj");
    mesh::TriangleMesh mesh = mesh::load(folder_ / "plain.obj");
    mesh::VertexChannels channels;
    channels.scalars = {{"height", {}}, {"gap", {}}};
    for (const Vec3& p : mesh.positions) {
      channels.scalars[0].values.push_back(static_cast<float>(p.z()));
      channels.scalars[1].values.push_back(p.x() < 0.0 ? std::numeric_limits<float>::quiet_NaN() : 2.0f);
    }
    mesh::save(folder_ / "dome.ply", mesh, channels);
    return parse("[body]\nkind = \"mesh\"\nfile = \"dome.ply\"\n" + more +
                     "[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n",
                 (folder_ / "scene.toml").string());
  }
};

TEST_F(ChannelsOf, AMeshFollowItsVerticesIntoTheOrderedSkin) {
  const auto world = build(dome());
  const mesh::TriangleMesh file = mesh::load(folder_ / "dome.ply");
  ASSERT_TRUE(world->body->channels);
  const SkinScalar* height = scalarNamed(world->body->channels.get(), "height");
  ASSERT_NE(height, nullptr);
  bool reordered = false;
  for (std::size_t v = 0; v < world->body->skin.positions.size(); ++v) {
    EXPECT_EQ(height->values[v], static_cast<float>(world->body->skin.positions[v].z()));
    EXPECT_EQ(file.positions[world->body->channels->source_vertex[v]], world->body->skin.positions[v]);
    reordered = reordered || world->body->channels->source_vertex[v] != v;
  }
  EXPECT_TRUE(reordered);
  EXPECT_DOUBLE_EQ(height->least, 0.0);
  EXPECT_DOUBLE_EQ(height->greatest, 20.0);
  EXPECT_EQ(rebuilt(*world, world->scene)->body->channels, world->body->channels);
}

TEST_F(ChannelsOf, AMeshAreCountedWhereTheyAreNumbers) {
  const auto world = build(dome());
  const SkinScalar* gap = scalarNamed(world->body->channels.get(), "gap");
  ASSERT_NE(gap, nullptr);
  EXPECT_EQ(gap->least, 2.0);
  EXPECT_EQ(gap->greatest, 2.0);
  EXPECT_EQ(gap->histogram[0], 11u * 21u) << "the half that has a value";
  const SkinScalar* height = scalarNamed(world->body->channels.get(), "");
  EXPECT_EQ(height->name, "height") << "an empty name means the first";
  EXPECT_EQ(std::accumulate(height->histogram.begin(), height->histogram.end(), std::size_t{0}), 441u);
  EXPECT_EQ(scalarNamed(world->body->channels.get(), "depth"), nullptr);
  EXPECT_EQ(scalarNames(world->body->channels.get()), "height, gap");
}

TEST_F(ChannelsOf, AMeshThatLacksTheOneAskedForSaysSo) {
  const auto world = build(dome("[view]\ncolours = \"scalar\"\nscalar = \"depth\"\n"));
  EXPECT_EQ(world->notes.back(), "[view] scalar \"depth\": the mesh file has no such vertex value; it has height, gap");
}

}  // namespace
}  // namespace palpate::scene
