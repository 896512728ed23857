#include "lab/workloads/workload_paths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lab/tests/lab/sha256.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/error.h"

namespace palpate::lab {
namespace {

using test::Published;

/// Check sums of the CSV files that an independent generator in NumPy writes, of those that hold no random numbers.
const Published kPublishedPaths[] = {
    {"back_slide", "8a531d99196fee5bf84bb9f9f894745ff55ecdc020c89939e94350df0952adc1"},
    {"eggcrate_0.1mps", "0091acb8d6504d4d522af0275b976f0e392046f66ac9befdcb86fbe9d6d49b47"},
    {"eggcrate_0.5mps", "73e9eaa616219e461e34ace2ba6eba69565b0a2a2fcf388f0892d619542aecf4"},
    {"eggcrate_1.0mps", "8b377d5162d543ee9ad59a6f3e92b91b703cf34a942226d174bc280f5f3b1f7c"},
    {"eggcrate_2.0mps", "2828361a79894ff620fda3fccb18ac97a35d7782831e9b58060c7d8c3a514f44"},
    {"flat_edge", "43effafb60e1bd975b7b9d86a310644ad9bced8b69b7ece0bc6f6368f93c588f"},
    {"flat_fric_20", "77537108f9b1f3f9e73aa585a8a09b399c31a4c8574ed3505c37c1accc71c5c8"},
    {"flat_fric_50", "f2016a3bcc2c0a66e59aa1ebae6ec9424e3e1fd570e2d786528b7d89b135e603"},
    {"flat_fric_100", "d7bc5f23f07c3f9abf792d5de31841d2f35513698f816120ec776bfcd7d1569a"},
    {"flat_fric_200", "167ed163b2ab2a3e4429a8853783ff97ae68a892b7e991dc8d1594ad1c54c50b"},
    {"flat_fric_500", "dd30a638d935277eb381127f2377a789d6a72fe9f1cac1ebaee083bad571e5be"}};

class PublishedPath : public testing::TestWithParam<Published> {};

TEST_P(PublishedPath, IsGeneratedToTheLastDigitOfItsFile) {
  EXPECT_EQ(test::sha256(device::formatTrajectory(lab::workloadPath(GetParam().name))), GetParam().sha256);
}

INSTANTIATE_TEST_SUITE_P(All, PublishedPath, testing::ValuesIn(kPublishedPaths), [](const auto& published) {
  std::string name = published.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST(WorkloadPath, GivesWhatItsFileWouldGive) {
  const device::Trajectory made = lab::workloadPath("back_jump5mm");
  const device::Trajectory read = device::parseTrajectory(device::formatTrajectory(made), "written");
  EXPECT_EQ(made.time_s, read.time_s);
  EXPECT_EQ(made.tip_mm, read.tip_mm);
}

TEST(WorkloadPath, EveryListedNameCanBeMade) {
  for (const lab::PathName& name : lab::workloadPathNames())
    EXPECT_GT(lab::workloadPath(name.path).size(), 500u) << name.path;
}

TEST(WorkloadPath, RefusesUnknownNames) {
  for (const char* name : {"", "back_jumpmm", "back_jump-1mm", "back_jump1", "eggcrate_mps", "flat_fric_", "bunny"}) {
    EXPECT_THROW(lab::workloadPath(name), Error) << name;
  }
}

TEST(BackJumps, StayUnderTheSkinAndKeepTheirStep) {
  const device::Trajectory path = lab::backJumps(5.0, 1);
  for (std::size_t k = 20; k < path.size(); ++k) {
    const Vec3& tip = path.tip_mm[k];
    const double depth = lab::backHeight(tip.x(), tip.y()) - tip.z();
    ASSERT_TRUE(depth > 1.99 && depth < 25.01) << "tick " << k;
  }
}

TEST(LatticePaths, PutTheTipOnPlanesEdgesAndVertices) {
  const mesh::TriangleMesh plate = lab::workloadMesh("lattice100");
  const device::Trajectory path = lab::latticeFlat(500);
  std::size_t on_plane = 0;
  for (const Vec3& tip : path.tip_mm) on_plane += tip.z() == 0.0 ? 1 : 0;
  EXPECT_GT(on_plane, 5000u);
  EXPECT_EQ(plate.positions[1], Vec3(2, 0, 0));  // every second lattice point is a vertex
}

TEST(Orbit, KeepsBelowTheSkinOfASphereLikeBody) {
  mesh::TriangleMesh octahedron;
  for (int axis = 0; axis < 3; ++axis) {
    octahedron.positions.push_back(Vec3::Unit(axis) * 60);
    octahedron.positions.push_back(Vec3::Unit(axis) * -60);
  }
  octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const device::Trajectory path = lab::orbit(octahedron, Vec3::Zero());
  for (std::size_t k = 2000; k < path.size(); ++k) {
    ASSERT_LT(path.tip_mm[k].lpNorm<1>(), 60.0 - 2.0) << "tick " << k;  // |x| + |y| + |z| = 60 mm is the skin
    ASSERT_GT(path.tip_mm[k].lpNorm<1>(), 60.0 - 30.0) << "tick " << k;
  }
}

}  // namespace
}  // namespace palpate::lab
