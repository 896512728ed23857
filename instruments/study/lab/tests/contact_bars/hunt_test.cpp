// The hunt as a bar: half a minute of random bodies and paths in every run, ten million ticks in the long one, and
// every fault that was ever kept.
//
// The kept cases of tests/data/hunt were faults of earlier versions. PALPATE_HUNT_MESHES=FOLDER adds the meshes of a
// folder.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "lab/hunt/hunt.h"
#include "lab/hunt/kept_case.h"
#include "lab/tests/contact_bars/bars.h"
#include "lab/workloads/hunted_bodies.h"
#include "palpate/mesh/files/load.h"
#include "support/places.h"

namespace palpate::bars {
namespace {

namespace fs = std::filesystem;

/// Half a minute of one core, and the number that the long form promises.
constexpr std::size_t kShortTicks = 3000000, kLongTicks = 10000000;

std::string textOf(const lab::FailingPath& path) {
  return fmt::format("{} on {}, seed {}, radius {} mm, tick {}: {} {} (bound {})", lab::nameOf(path.fault), path.body,
                     path.seed, path.radius_mm, path.finding.first_tick, path.finding.what, path.finding.measured,
                     path.finding.bound);
}

void expectNothingIn(const lab::HuntResult& result) {
  for (const lab::FailingPath& path : result.failing) ADD_FAILURE() << textOf(path);
  for (std::size_t f = 0; f < lab::kFaults; ++f)
    testing::Test::RecordProperty(lab::nameOf(static_cast<lab::Fault>(f)), static_cast<int>(result.fault_ticks[f]));
}

TEST(Hunt, FindsNothing) {
  lab::HuntPlan plan;
  plan.ticks = heavy() ? kLongTicks : kShortTicks;
  plan.seed = 1;
  const lab::HuntResult result = lab::hunt(plan);
  EXPECT_EQ(result.ticks, plan.ticks);
  EXPECT_GT(result.touching_ticks, plan.ticks / 2);
  EXPECT_GE(result.bodies, 40u);
  expectNothingIn(result);
}

/// The open kinds, of which every hunt mixes in a few bodies.
TEST(Hunt, FindsNothingOnOpenBodies) {
  lab::HuntPlan plan;
  plan.ticks = heavy() ? 3000000 : 300000;
  plan.seed = 1;
  plan.kinds = {"far_hole", "far_hole_of_parts", "inside_out_open", "open_sheet", "ridge"};
  const lab::HuntResult result = lab::hunt(plan);
  EXPECT_GT(result.open_ticks, plan.ticks / 2);
  expectNothingIn(result);
}

TEST(Hunt, FindsNothingAtOtherScales) {
  for (const double scale : {0.001, 1000.0}) {
    lab::HuntPlan plan;
    plan.ticks = heavy() ? 1000000 : 100000;
    plan.scale = scale;
    plan.seed = 2;
    expectNothingIn(lab::hunt(plan));
  }
}

TEST(Hunt, FindsNothingOnMeshesOfAFolder) {
  const char* folder = std::getenv("PALPATE_HUNT_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "PALPATE_HUNT_MESHES names no folder";
  lab::HuntPlan plan;
  plan.generated = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    lab::NamedBody body{entry.path().filename().string(), mesh::load(entry.path(), {.keep_wrong_indices = true})};
    const double diagonal = mesh::boundingBox(body.mesh).diagonal().norm();
    for (Vec3& p : body.mesh.positions) p *= 400.0 / diagonal;
    plan.meshes.push_back(std::move(body));
  }
  std::sort(plan.meshes.begin(), plan.meshes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  plan.ticks = (heavy() ? 300000 : 30000) * plan.meshes.size();
  expectNothingIn(lab::hunt(plan));
}

TEST(KeptCases, StayMended) {
  std::size_t cases = 0;
  for (const auto& entry : fs::directory_iterator(support::testData() / "hunt")) {
    if (!entry.is_directory()) continue;
    ++cases;
    const lab::KeptCase kept = lab::readCase(entry.path());
    const lab::HuntReport report = lab::replay(kept);
    EXPECT_EQ(report.ticks, kept.tips.size()) << entry.path();
    EXPECT_TRUE(report.clean()) << entry.path();
  }
  EXPECT_GE(cases, 15u);
}

TEST(KeptCases, OfAFolderOfScenesStayMended) {
  const char* folder = std::getenv("PALPATE_HUNT_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "PALPATE_HUNT_SCENES names no folder";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / "scene.toml")) continue;
    const lab::HuntReport report = lab::replay(lab::readCase(entry.path()));
    EXPECT_TRUE(report.clean()) << entry.path();
  }
}

}  // namespace
}  // namespace palpate::bars
