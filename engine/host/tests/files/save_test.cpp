#include "palpate/mesh/files/save.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/mesh/files/load.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {

TEST(Save, ObjAndPlyKeepEveryBit) {
  const support::TemporaryFolder folder;
  const TriangleMesh mesh = zoo::torus();
  for (const char* name : {"torus.obj", "torus.ply"}) {
    save(folder / name, mesh);
    const TriangleMesh back = load(folder / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
  }
}

TEST(Save, StlKeepsFloatsAndIsWeldedAgain) {
  const support::TemporaryFolder folder;
  const TriangleMesh mesh = zoo::sphere();
  save(folder / "sphere.stl", mesh);
  const TriangleMesh back = load(folder / "sphere.stl");
  ASSERT_EQ(back.positions.size(), mesh.positions.size());
  ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& expected = mesh.positions[mesh.triangles[t][corner]];
      EXPECT_EQ(back.positions[back.triangles[t][corner]], expected.cast<float>().cast<double>());
    }
  }
}

TEST(Save, PlyNamesItsChannels) {
  const support::TemporaryFolder folder;
  save(folder / "t.ply", zoo::oneTriangle(),
       {{{"strain", {0.5f, -1.0f, 2.0f}}}, {{255, 0, 0}, {0, 255, 0}, {0, 0, 9}}});
  std::ifstream stream(folder / "t.ply", std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_NE(text.str().find("property float strain\nproperty uchar red\n"), std::string::npos);
  EXPECT_EQ(load(folder / "t.ply").positions, zoo::oneTriangle().positions);
}

TEST(Save, RefusesWhatTheFormatCannotHold) {
  const support::TemporaryFolder folder;
  const VertexChannels channels{{{"depth", {1, 2, 3}}}, {}};
  EXPECT_THROW(save(folder / "t.obj", zoo::oneTriangle(), channels), Error);
  EXPECT_THROW(save(folder / "t.xyz", zoo::oneTriangle()), Error);
  TriangleMesh far = zoo::oneTriangle();
  for (Vec3& position : far.positions) position.x() += 4e8;
  EXPECT_EQ(support::thrownMessage([&] { save(folder / "t.stl", far); }),
            (folder / "t.stl").string() +
                ": vertices are too far from the origin for the precision of STL; write .ply or .obj");
  EXPECT_THROW(save(folder / "t.ply", zoo::cube(), channels), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Save, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const support::TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  EXPECT_NE(support::thrownMessage([&] { save(folder / "full.ply", zoo::sphere()); }).find("No space left"),
            std::string::npos);
}

TEST(Save, AFailedWriteLeavesTheOldFile) {
  const support::TemporaryFolder folder;
  save(folder / "mesh.obj", zoo::cube());
  EXPECT_THROW(save(folder / "mesh.obj", zoo::cube(), {{{"x y", {}}}, {}}), Error);
  EXPECT_EQ(load(folder / "mesh.obj").triangles.size(), 12u);
  EXPECT_THROW(save(folder / "mesh.obj/mesh.obj", zoo::cube()), Error);
}

}  // namespace palpate::mesh
