// The contact bars on the body that Palpate shows when it is given none: closed, with folds, stumps and rims, in the
// postures and builds that are farthest from the back on which the bars were first made.
//
// Paths are walks at random over the skin, found by the judge's own nearest point; none was tuned. In every run at the
// usual size, short; PALPATE_HEAVY=1 (tools/test-heavy) adds longer paths, all builds, 20,000 and 200,000 triangles of
// skin, and a hunt of ten million ticks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "lab/hunt/hunt.h"
#include "lab/tests/contact_bars/bars.h"
#include "palpate/base/random.h"
#include "palpate/body/trunk/trunk.h"

namespace palpate::bars {
namespace {

constexpr std::size_t kBoneTriangles = 6000;
constexpr std::size_t kUsualOfSkin = 59164;  // what makeTrunk gives it by default

struct TrunkBuild {
  const char* name;
  body::TrunkShape shape;
};

std::vector<TrunkBuild> trunkBuilds() {
  std::vector<TrunkBuild> builds = {{"thin", {.body_mass_index = 17}},
                                    {"heavy prone", {.body_mass_index = 35, .posture = body::Posture::prone}}};
  if (!heavy()) return builds;
  builds.push_back({"standing", {}});
  builds.push_back({"heavy", {.body_mass_index = 35}});
  builds.push_back({"thin prone", {.body_mass_index = 17, .posture = body::Posture::prone}});
  builds.push_back({"sitting", {.body_mass_index = 30, .posture = body::Posture::sitting}});
  return builds;
}

/// Made once a test program.
const mesh::TriangleMesh& trunkSkin(const TrunkBuild& build, std::size_t of_skin) {
  static std::map<std::string, mesh::TriangleMesh> made;
  const std::string key = fmt::format("{} {}", build.name, of_skin);
  if (const auto found = made.find(key); found != made.end()) return found->second;
  const body::TrunkSettings settings{
      .triangles = of_skin + kBoneTriangles, .bone_triangles = kBoneTriangles, .shape = build.shape};
  return made.emplace(key, body::makeTrunk(settings).skin).first->second;
}

/// Where an examiner goes and where the skin turns most: places of the standing body of average build.
struct TrunkRegion {
  const char* name;
  Vec3 middle;
  double reach_mm;
  bool tight = false;  ///< turns within the depth that the finger is pressed: a proxy is held on the far side longer
};
const std::array<TrunkRegion, 12> kTrunkRegions = {{{"back", {0, 39, 98}, 110},
                                                    {"loin", {0, -204, 83}, 70},
                                                    {"deltoid", {228, 110, 20}, 45},
                                                    {"rim of the arm's stump", {240, 15, 0}, 40, true},
                                                    {"thigh's stump", {100, -535, 0}, 80, true},
                                                    {"flank", {140, -220, 0}, 60},
                                                    {"belly", {0, -200, -102}, 80},
                                                    {"gluteal fold", {80, -460, 110}, 45},
                                                    {"neck's stump", {30, 265, 0}, 60, true},
                                                    {"armpit", {165, 0, 10}, 40, true},
                                                    {"gluteal cleft", {0, -420, 107}, 45, true},
                                                    {"between the thighs", {0, -480, 0}, 40, true}}};

/// As back_slide does it on the back: 5 to 10 mm deep at 100 to 500 mm/s, but at random round a place.
device::Trajectory wanderRound(lab::SurfaceSide& skin, const Vec3& near, double reach_mm, std::size_t ticks,
                               std::uint64_t seed) {
  using std::numbers::pi;
  Random random(seed);
  lab::NearestPoint under = skin.nearestTo(near);
  const Vec3 middle = under.point;
  Vec3 tip = under.point + 10.0 * under.pseudo_normal;
  Vec3 heading = random.normal3();
  Vec3 outward = under.pseudo_normal;  // a hand does not follow facets
  device::Trajectory path;
  for (std::size_t k = 0; k < ticks; ++k) {
    path.time_s.push_back(static_cast<double>(k) / 1000.0);
    path.tip_mm.push_back(tip);
    const double t = path.time_s.back();
    const double speed = 0.3 + 0.2 * std::sin(2 * pi * 0.6 * t);  // mm a tick
    heading += 0.05 * random.normal3();
    if ((under.point - middle).norm() > reach_mm) heading += 0.1 * (middle - under.point).normalized();
    heading -= heading.dot(under.pseudo_normal) * under.pseudo_normal;
    heading.normalize();
    under = skin.nearestTo(under.point + speed * heading);
    const double depth = 7.5 - 2.5 * std::cos(2 * pi * 0.7 * t);
    outward = (outward + 0.03 * under.pseudo_normal).normalized();
    const Vec3 move = under.point - depth * outward - tip;
    tip += move * std::min(1.0, speed / std::max(move.norm(), 1e-300));
  }
  return path;
}

// Those of slide_test.cpp, of a point and of a sphere; 0.1 mm more of lag, for the iliac crest is rounder than a back.
// A coarse skin has coarser facets. What a sphere lags at most is what it does on the coarsest back: the furrow beside
// a thin man's spine holds it, and over his ribs a point's force takes a step of 0.46 N where a back's stay below 0.45.
// For the step of a sphere's force there is no bar on the back; this one is ours.
struct TrunkSize {
  std::size_t of_skin;
  double max_lag_mm, max_sphere_lag_mm;
  double force_step_n, sphere_force_step_n;
};
const TrunkSize kTrunkSizes[] = {
    {kUsualOfSkin, 13.0, 15.7, 0.48, 0.6}, {20000, 14.5, 15.7, 0.5, 0.6}, {200000, 13.0, 15.7, 0.48, 0.6}};
constexpr double kTrunkLagP99Mm = 11.1;
constexpr double kTrunkSphereLagP99Mm = 12.9;
constexpr bench::Window kOnceDown{0.2, 1e9};

void expectNeverLost(const bench::ContactFigures& figures, const std::string& what) {
  EXPECT_EQ(figures.falls.ticks, 0u) << what << ", first at tick " << figures.falls.first_tick.value_or(0);
  EXPECT_EQ(figures.falls.first_contact_delay_ticks, 0u) << what;
  EXPECT_EQ(figures.contact_ticks, figures.ticks) << what;
  support::expectNone(figures.counts.allocations, what);
}

void expectSmooth(const bench::ContactFigures& figures, const TrunkSize& bar, bool sphere, const std::string& what) {
  EXPECT_LE(figures.lag_mm.p99, sphere ? kTrunkSphereLagP99Mm : kTrunkLagP99Mm) << what;
  EXPECT_LE(figures.lag_mm.max, sphere ? bar.max_sphere_lag_mm : bar.max_lag_mm) << what;
  EXPECT_LE(figures.max_force_step_n, sphere ? bar.sphere_force_step_n : bar.force_step_n)
      << what << " at tick " << figures.max_force_step_tick;
}

/// No fall, no missed contact, no force that points wrong, no step that the tip's motion does not explain.
void expectClean(lab::HuntWorld& world, const device::Trajectory& path, double radius_mm, const std::string& what) {
  const lab::HuntReport report = lab::huntAlong(world, lab::huntedFinger(radius_mm, 1.0), path.tip_mm);
  for (std::size_t f = 0; f < lab::kFaults; ++f) {
    const lab::Finding& finding = report.findings[f];
    EXPECT_EQ(finding.ticks, 0u) << what << ": " << lab::nameOf(static_cast<lab::Fault>(f)) << ", " << finding.what
                                 << " at tick " << finding.first_tick;
  }
}

class TrunkOfSize : public testing::TestWithParam<TrunkSize> {
  void SetUp() override {
    if (GetParam().of_skin != kUsualOfSkin && !heavy()) GTEST_SKIP() << "only with PALPATE_HEAVY=1";
  }
};

TEST_P(TrunkOfSize, HoldsTheBarsWhereverTheSkinTurns) {
  const std::size_t ticks = heavy() ? 8000 : 1000;
  for (const TrunkBuild& build : trunkBuilds()) {
    const mesh::TriangleMesh& skin = trunkSkin(build, GetParam().of_skin);
    bench::ContactWorld world = bench::buildContactWorld(skin);
    lab::HuntWorld judged = lab::buildHuntWorld(skin);
    for (std::size_t r = 0; r < kTrunkRegions.size(); ++r) {
      const TrunkRegion& region = kTrunkRegions[r];
      const device::Trajectory path = wanderRound(world.side, region.middle, region.reach_mm, ticks, 1 + r);
      for (const double radius_mm : radiiMm()) {
        const std::string what = fmt::format("{}, {}, radius {} mm", build.name, region.name, radius_mm);
        const bench::ContactFigures figures = bench::measureContact(world, path, makeBarFinger(radius_mm), kOnceDown);
        expectNeverLost(figures, what);
        if (!region.tight) expectSmooth(figures, GetParam(), radius_mm > 0, what);
        expectClean(judged, path, radius_mm, what);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trunk, TrunkOfSize, testing::ValuesIn(kTrunkSizes),
                         [](const auto& size) { return fmt::to_string(size.param.of_skin); });

TEST(Trunk, HoldsWhateverRandomPathsDoToItAllOver) {
  lab::HuntPlan plan;
  plan.generated = false;
  plan.seed = 20;
  plan.radii_mm = radiiMm();
  plan.radii_mm.push_back(16);  // the ball of a thumb
  for (const TrunkBuild& build : trunkBuilds()) plan.meshes.push_back({build.name, trunkSkin(build, kUsualOfSkin)});
  plan.ticks = heavy() ? 10000000 : 150000;
  const lab::HuntResult result = lab::hunt(plan);
  EXPECT_EQ(result.ticks, plan.ticks);
  EXPECT_GT(result.touching_ticks, plan.ticks / 2);
  for (const lab::FailingPath& path : result.failing) {
    ADD_FAILURE() << lab::nameOf(path.fault) << " on " << path.body << ", seed " << path.seed << ", radius "
                  << path.radius_mm << " mm, tick " << path.finding.first_tick << ": " << path.finding.what;
  }
}

}  // namespace
}  // namespace palpate::bars
