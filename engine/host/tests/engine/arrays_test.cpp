#include "palpate/engine/arrays.h"

#include <gtest/gtest.h>

#include <limits>

#include "palpate/base/random.h"
#include "palpate/engine/simulator.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"

namespace palpate::engine {
namespace {

struct Arrays {
  std::vector<float> coordinates;
  std::vector<std::int32_t> corners;
};

Arrays arraysOf(const mesh::TriangleMesh& mesh) {
  Arrays arrays;
  for (const Vec3& p : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) arrays.coordinates.push_back(static_cast<float>(p[axis]));
  }
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) arrays.corners.push_back(static_cast<std::int32_t>(v));
  }
  return arrays;
}

mesh::TriangleMesh toMesh(const Arrays& arrays) {
  return meshFromArrays(std::span<const float>(arrays.coordinates), std::span<const std::int32_t>(arrays.corners));
}

/// In a random order, with every vertex given once for each triangle, as a file of separate triangles holds it.
mesh::TriangleMesh shuffledSoup(const mesh::TriangleMesh& mesh) {
  Random random(3);
  mesh::TriangleMesh soup;
  std::vector<Triangle> triangles = mesh.triangles;
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
  for (const Triangle& t : triangles) {
    const auto first = static_cast<Index>(soup.positions.size());
    for (const Index v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Every built vertex lies where its source was given, every built triangle has the corners of its source.
void expectTrueMaps(const mesh::TriangleMesh& given, const WorldFromArrays& built, std::size_t middles = 0) {
  std::size_t moved = 0;
  const mesh::TriangleMesh& skin = built.world->body->skin;
  ASSERT_EQ(built.source_vertex.size(), skin.positions.size());
  ASSERT_EQ(built.source_triangle.size(), skin.triangles.size());
  ASSERT_EQ(built.built_vertex.size(), given.positions.size());
  ASSERT_EQ(built.built_triangle.size(), given.triangles.size());
  for (Index v = 0; v < skin.positions.size(); ++v) {
    moved += skin.positions[v] == given.positions[built.source_vertex[v]] ? 0 : 1;
  }
  EXPECT_EQ(moved, middles) << "vertices in the middle of an edge";
  for (Index v = 0; v < given.positions.size(); ++v) {
    if (built.built_vertex[v] == kNoIndex) continue;
    ASSERT_EQ(skin.positions[built.built_vertex[v]], given.positions[v]) << v;
  }
  const auto centre = [](const mesh::TriangleMesh& mesh, Index t) { return centreOf(mesh, mesh.triangles[t]); };
  for (Index t = 0; t < skin.triangles.size(); ++t) {
    if (built.source_triangle[t] == kNoIndex) continue;
    ASSERT_LT((centre(skin, t) - centre(given, built.source_triangle[t])).norm(), 1e-9) << t;
  }
  for (Index t = 0; t < given.triangles.size(); ++t) {
    if (built.built_triangle[t] == kNoIndex) continue;
    ASSERT_LT((centre(skin, built.built_triangle[t]) - centre(given, t)).norm(), 1e-9) << t;
  }
}

std::size_t unknownIn(const std::vector<Index>& map) {
  return static_cast<std::size_t>(std::count(map.begin(), map.end(), kNoIndex));
}

TEST(Arrays, BecomeAWorldThatIsFelt) {
  const mesh::TriangleMesh mesh = toMesh(arraysOf(zoo::grid(20, 200.0)));
  const WorldFromArrays built = worldFromMesh(mesh, std::vector<double>(mesh.positions.size(), 2.0));
  expectTrueMaps(mesh, built);
  Simulator simulator(built.world);
  simulator.feel(0, Vec3(103, 101, 1));
  EXPECT_NEAR(simulator.feel(0, Vec3(103, 101, -3)).force.z(), 6.0, 1e-9);
}

TEST(Arrays, SayWhereEveryVertexAndTriangleWent) {
  const mesh::TriangleMesh soup = shuffledSoup(zoo::sphere(40.0, 3));
  const WorldFromArrays built = worldFromMesh(soup);
  EXPECT_EQ(built.world->body->skin.triangles.size(), soup.triangles.size());
  EXPECT_LT(built.world->body->skin.positions.size(), soup.positions.size()) << "corners are welded";
  expectTrueMaps(soup, built);
  EXPECT_EQ(unknownIn(built.source_triangle), 0u);
  EXPECT_EQ(unknownIn(built.built_triangle), 0u);
  EXPECT_EQ(unknownIn(built.built_vertex), 0u);
}

TEST(Arrays, KeepTrueMapsThroughMending) {
  for (const mesh::TriangleMesh& faulty : {zoo::cubeWithFin(), zoo::cubeWithCap(), zoo::cubeWithDuplicates(),
                                           zoo::cubesSharingAVertex(), zoo::cubesSharingAnEdge()}) {
    const WorldFromArrays built = worldFromMesh(faulty);
    const bool shares_an_edge = faulty.triangles == zoo::cubesSharingAnEdge().triangles;
    expectTrueMaps(faulty, built, shares_an_edge ? 1 : 0);
    EXPECT_LT(unknownIn(built.source_triangle), built.source_triangle.size());
  }
}

TEST(Arrays, StiffnessGoesWithItsVertexAndStaysWhenTheWorldIsRebuilt) {
  const mesh::TriangleMesh soup = shuffledSoup(zoo::sphere(40.0, 3));
  std::vector<double> stiffness;
  for (const Vec3& p : soup.positions) stiffness.push_back(1.0 + 0.01 * p.z());
  const WorldFromArrays built = worldFromMesh(soup, stiffness);
  scene::Scene other = built.world->scene;
  other.contact.finger.mu_static = 0.9;
  for (const auto& world : {built.world, scene::rebuilt(*built.world, other)}) {
    for (Index v = 0; v < world->body->skin.positions.size(); ++v) {
      ASSERT_EQ((*world->surface.stiffness_n_per_mm)[v], 1.0 + 0.01 * world->body->skin.positions[v].z()) << v;
    }
  }
}

TEST(Arrays, WithoutStiffnessTheSceneSays) {
  scene::Scene scene;
  scene.stiffness.constant_n_per_mm = 0.7;
  EXPECT_EQ(worldFromMesh(zoo::sphere(40.0, 2), {}, scene).world->surface.stiffness_n_per_mm->at(0), 0.7);
}

TEST(Arrays, NameWhatIsWrongWithThem) {
  using support::thrownMessage;
  Arrays arrays = arraysOf(zoo::cube());
  arrays.corners[7] = -1;
  EXPECT_EQ(thrownMessage([&] { toMesh(arrays); }),
            "arrays: corner 1 of triangle 2 is vertex -1, but there are only 8 vertices");
  arrays.corners[7] = 8;
  EXPECT_EQ(thrownMessage([&] { toMesh(arrays); }),
            "arrays: corner 1 of triangle 2 is vertex 8, but there are only 8 vertices");
  arrays = arraysOf(zoo::cube());
  arrays.coordinates[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(thrownMessage([&] { toMesh(arrays); }), "arrays: z of vertex 1 is not finite");
  arrays = arraysOf(zoo::cube());
  arrays.coordinates.pop_back();
  EXPECT_EQ(thrownMessage([&] { toMesh(arrays); }), "arrays: 23 coordinates; expected three per vertex");
  arrays = arraysOf(zoo::cube());
  arrays.corners.push_back(0);
  EXPECT_EQ(thrownMessage([&] { toMesh(arrays); }), "arrays: 37 corners; expected three per triangle");
  const std::vector<std::uint64_t> huge = {0, 1, std::uint64_t{1} << 40};
  EXPECT_NE(thrownMessage([&] {
              meshFromArrays(std::span<const float>(arrays.coordinates), std::span<const std::uint64_t>(huge));
            }).find("is vertex 1099511627776"),
            std::string::npos);
  const auto cube = zoo::cube();
  EXPECT_EQ(thrownMessage([&] { worldFromMesh(cube, std::vector<double>(7, 1.0)); }),
            "arrays: 7 stiffness values for 8 vertices; expected one per vertex");
  std::vector<double> stiffness(8, 1.0);
  stiffness[3] = -2.0;
  EXPECT_EQ(thrownMessage([&] { worldFromMesh(cube, stiffness); }),
            "arrays: the stiffness of vertex 3 is -2; expected a number of at least 0");
}

}  // namespace
}  // namespace palpate::engine
