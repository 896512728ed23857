#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "support/counted.h"

namespace palpate::servo {
namespace {

/// The small torso, pressed beside the spine, dragged over it, circled.
std::shared_ptr<const scene::World> torso(const std::string& more) {
  return scene::build(scene::parse("[body]\nkind = \"torso\"\ntriangles = 8163\n" + more + R"(
[[finger]]
name = "index"
at_mm = [20, 20]
script = [{ do = "press", depth_mm = 6 }, { do = "drag", by_mm = [-40, -50], seconds = 2 },
          { do = "circle", radius_mm = 15 }, { do = "lift" }]
[[finger]]
name = "middle"
at_mm = [-60, -30]
script = [{ do = "press", depth_mm = 4 }, { do = "drag", by_mm = [50, 60], seconds = 0.5 }, { do = "lift" }]
)",
                                   "torso.toml"));
}

const std::string kHdb = "[contact]\nsource = \"hdb\"\n";

/// What the world's fingers feel through this source; null: through the default one.
std::vector<contact::FingerOutput> felt(const scene::World& world,
                                        const std::shared_ptr<const hdb::HdbSurface>& source) {
  const device::FingerPaths paths = device::pathsOf(world);
  Rig rig = scriptedRig(world, paths);
  FingerSolvers solvers = makeSolvers(world.surface, source, rig.fingers.size());
  for (std::size_t i = 0; i < solvers.size(); ++i) rig.fingers[i].solver = std::move(solvers[i]);
  std::vector<contact::FingerOutput> outputs;
  runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) outputs.push_back(sample.contact);
  });
  return outputs;
}

TEST(HdbRig, FeelsTheTorsoAsTheDefaultSourceDoes) {
  const auto world = torso(kHdb);
  const auto reference = felt(*world, nullptr);
  for (const auto query : {hdb::HdbQuery::leaves, hdb::HdbQuery::coherent, hdb::HdbQuery::linked}) {
    hdb::HdbSettings settings = world->hdb->settings;
    settings.query = query;
    const auto found = felt(*world, hdb::makeHdbSurface(world->surface, world->hdb->partition, settings));
    ASSERT_EQ(found.size(), reference.size());
    std::size_t touching = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].force, reference[i].force) << i;
      ASSERT_EQ(found[i].proxy, reference[i].proxy) << i;
      touching += found[i].depth_mm > 0.0 ? 1 : 0;
    }
    EXPECT_GT(touching, 5000u);
  }
}

TEST(HdbRig, GivesTheSameBitsTwice) {
  const auto world = torso(kHdb + "[partition]\ntree = \"bsp\"\nthreshold = 200\n");
  const auto once = felt(*world, world->hdb);
  const auto twice = felt(*world, world->hdb);
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(once[i].force, twice[i].force) << i;
}

/// Other settings for the same body, ready for a running rig.
FingerSolvers rebuilt(const scene::World& world, const hdb::BuildSettings& settings, std::size_t fingers) {
  auto partition = std::make_shared<const hdb::Partition>(hdb::buildPartition(world.body->skin, settings));
  return makeSolvers(world.surface, hdb::makeHdbSurface(world.surface, std::move(partition), world.hdb->settings),
                     fingers);
}

// Between two ticks of a finger that presses and slides, the partition is replaced again and again: other trees, other
// assignments, other thresholds. The forces are those of a run in which nothing is replaced.
TEST(HdbRig, ARebuiltPartitionChangesNoForceAndAllocatesNothingInTheTick) {
  const auto world = torso(kHdb);
  const device::FingerPaths paths = device::pathsOf(*world);
  const auto reference = felt(*world, world->hdb);
  Rig rig = scriptedRig(*world, paths);
  TickSamples samples(rig.fingers.size());
  FingerSolvers next;
  std::optional<std::uint64_t> allocations = 0;  // empty for good once they could not be counted
  std::size_t replaced = 0;
  for (std::uint64_t tick = 0; tick < paths.ticks; ++tick) {
    if (tick % 400 == 0) {
      hdb::BuildSettings settings;
      settings.tree = tick % 800 == 0 ? hdb::TreeKind::Bsp : hdb::TreeKind::Octree;
      settings.assignment = static_cast<hdb::Assignment>(tick / 400 % 3);
      settings.threshold = 64;
      next = rebuilt(*world, settings, rig.fingers.size());
      ++replaced;
    }
    const lab::ThreadCounts before = lab::countsOfThisThread();
    for (std::size_t i = 0; i < next.size() && tick % 400 == 0; ++i) {
      exchange(rig.fingers[i].solver, next[i], rig.fingers[i].contact);
    }
    runTick(rig, tick, LoopEvent::none, samples);
    const auto asked = lab::countsSince(before).allocations;
    allocations = allocations && asked ? std::optional(*allocations + *asked) : std::nullopt;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      ASSERT_NEAR((samples[i].contact.force - reference[tick * samples.size() + i].force).norm(), 0.0, 1e-3) << tick;
    }
  }
  support::expectNone(allocations);
  EXPECT_GE(replaced, 8u);
}

/// A skin that becomes five times as stiff under a finger, or as soft again: the force follows within the bound on
/// steps.
TEST(FingerSolver, AnExchangedStiffnessIsFeltWithoutAStep) {
  const auto world = torso(kHdb);
  contact::Surface stiff = world->surface;
  std::vector<double> stiffness_n_per_mm = *world->surface.stiffness_n_per_mm;
  for (double& k : stiffness_n_per_mm) k *= 5.0;
  stiff.stiffness_n_per_mm = std::make_shared<const std::vector<double>>(std::move(stiffness_n_per_mm));
  FingerSolvers at_work = makeSolvers(world->surface, nullptr, 1);
  const Vec3 above = device::pathsOf(*world).tips[0]->front();
  contact::FingerSettings settings;
  contact::FingerState state;
  Vec3 tip = above;
  contact::FingerOutput felt = touch(at_work[0], settings, state, tip);
  while (felt.depth_mm < 15.0) felt = touch(at_work[0], settings, state, tip -= Vec3(0.0, 0.0, 0.25));
  for (const contact::Surface* surface : {&std::as_const(stiff), &world->surface}) {
    const double before = felt.force.norm();
    FingerSolvers next = makeSolvers(*surface, nullptr, 1);
    exchange(at_work[0], next[0], state);
    contact::FingerState fresh = state;
    const double wanted = contact::step(*surface, settings, fresh, tip).force.norm();
    ASSERT_GT(std::max(before / wanted, wanted / before), 4.0);
    int ticks = 0;
    for (double change = 1.0; change > 0.0 && ticks < 5000; ++ticks) {
      const Vec3 last = felt.force;
      felt = touch(at_work[0], settings, state, tip);
      change = (felt.force - last).norm();
      const double bound = settings.catch_up_mm_per_s * settings.tick_s * wanted / felt.depth_mm;
      ASSERT_LE(change, 1.001 * bound) << ticks;
    }
    EXPECT_NEAR(felt.force.norm(), wanted, 1e-9);
    EXPECT_GT(ticks, 10);
    EXPECT_EQ(felt.status & contact::kCatchingUp, 0u);
  }
}

TEST(FingerSolver, AnExchangeKeepsTheTouchUnlessTheFingerLooksForTheSkinInAnotherWay) {
  const auto world = torso(kHdb);
  FingerSolvers at_work = makeSolvers(world->surface, nullptr, 1);
  FingerSolvers walk = makeSolvers(world->surface, nullptr, 1);
  FingerSolvers box = makeSolvers(world->surface, world->hdb, 1);
  const Vec3 above = device::pathsOf(*world).tips[0]->front();
  const Vec3 below = above - Vec3(0.0, 0.0, 60.0);
  contact::FingerState state;
  touch(at_work[0], {}, state, above);
  ASSERT_GT(touch(at_work[0], {}, state, below).depth_mm, 0.0);

  exchange(at_work[0], walk[0], state);
  EXPECT_TRUE(state.touching);

  exchange(at_work[0], box[0], state);
  EXPECT_FALSE(state.touching);
  EXPECT_FALSE(state.knows_tip);
  EXPECT_FALSE(box[0].source.box.has_value()) << "the one that was at work is given back";
  touch(at_work[0], {}, state, above);
  EXPECT_GT(touch(at_work[0], {}, state, below).depth_mm, 0.0) << "felt through the box";
}

}  // namespace
}  // namespace palpate::servo
