// The Virtual Haptic Back by name: what the dissertation says of it, seen from a run of the preset.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/contact/finger.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/words.h"
#include "palpate/scene/world.h"
#include "palpate/servo/device_limits.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "support/error_message.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::app {
namespace {

using Ticks = std::vector<std::vector<contact::FingerOutput>>;  // tick by tick, a finger each

Ticks simulateTicks(const scene::World& world) {
  const device::FingerPaths paths = device::pathsOf(world);
  servo::Rig rig = servo::scriptedRig(world, paths);
  Ticks ticks;
  servo::runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    auto& tick = ticks.emplace_back();
    for (const trace::Sample& sample : samples) tick.push_back(sample.contact);
  });
  return ticks;
}

const scene::World& vhb() {
  static const std::shared_ptr<const scene::World> world = scene::build(scene::presetScene("vhb"));
  return *world;
}

const Ticks& vhbTicks() {
  static const Ticks ticks = simulateTicks(vhb());
  return ticks;
}

double stiffnessAt(const scene::World& world, const contact::FingerOutput& finger) {
  const Triangle& t = world.body->skin.triangles[finger.triangle];
  const std::array<Vec3, 3> corners = {world.body->skin.positions[t[0]], world.body->skin.positions[t[1]],
                                       world.body->skin.positions[t[2]]};
  const Vec3 weights = tree::barycentricWeights(corners, finger.proxy);
  double stiffness = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    stiffness += weights[static_cast<Eigen::Index>(i)] * (*world.surface.stiffness_n_per_mm)[t[i]];
  }
  return stiffness;
}

TEST(VirtualHapticBack, IsTheBackOfSection21OverItsSkeleton) {
  EXPECT_EQ(vhb().body->skin.triangles.size(), 2962u);
  EXPECT_EQ(vhb().body->skin.positions.size(), 1544u) << "1588 in the text, whose border has more edges";
  const Vec3 size = mesh::boundingBox(vhb().body->skin).sizes();
  EXPECT_NEAR(size.x(), 350.0, 1.5);
  EXPECT_NEAR(size.y(), 400.0, 1.5);
  EXPECT_NEAR(size.z(), 120.0, 1.5);
  EXPECT_EQ(vhb().body->anatomy.bones.size(), 41u) << "T1 to L3, 24 ribs, two shoulder blades";
  EXPECT_EQ(vhb().scene.view.opacity, 0.35);
  EXPECT_TRUE(vhb().notes.empty()) << vhb().notes.front();
}

TEST(VirtualHapticBack, ComesInTheSizesOfTheText) {
  for (const std::size_t triangles : {20389, 41582}) {
    scene::Scene scene = scene::presetScene("vhb");
    scene.body.triangles = triangles;
    EXPECT_EQ(scene::build(scene)->body->skin.triangles.size(), triangles);
  }
}

TEST(VirtualHapticBack, PushesBackByHookesLawInDepth) {  // (2.1)
  EXPECT_EQ(vhb().tissue.model, scene::TissueModel::gaussian);
  EXPECT_EQ(vhb().tissue.law, tissue::ForceLaw::Kind::linear);
  const contact::FingerSettings settings = scene::contactSettings(vhb().scene, vhb().scene.fingers[0]);
  std::size_t pressed = 0;
  for (Index t = 150; t < vhb().body->skin.triangles.size(); t += 400) {
    const Triangle& corners = vhb().body->skin.triangles[t];
    const Vec3 place = (vhb().body->skin.positions[corners[0]] + vhb().body->skin.positions[corners[1]] +
                        vhb().body->skin.positions[corners[2]]) /
                       3.0;
    const Vec3 normal =
        mesh::areaVector2(vhb().body->skin.positions[corners[0]], vhb().body->skin.positions[corners[1]],
                          vhb().body->skin.positions[corners[2]])
            .normalized();
    contact::FingerState state;
    double stiffness = 0.0;
    for (int step = -10; step <= 100; ++step) {
      const double depth_mm = 0.1 * step;
      const contact::FingerOutput felt = contact::step(vhb().surface, settings, state, place - depth_mm * normal);
      if (felt.depth_mm < 0.5) continue;
      const double ratio = felt.force.norm() / felt.depth_mm;
      if (stiffness == 0.0) stiffness = ratio;
      EXPECT_NEAR(ratio / stiffness, 1.0, 1e-9) << "triangle " << t << ", " << depth_mm << " mm";
      ++pressed;
    }
  }
  EXPECT_GT(pressed, 500u);
}

TEST(VirtualHapticBack, PushesBackByItsMapInEveryTickOfARun) {  // (2.1), k in between the vertices (E3)
  std::size_t touching = 0;
  std::size_t held_back = 0;
  for (const auto& tick : vhbTicks()) {
    for (const contact::FingerOutput& finger : tick) {
      if (finger.touch == contact::Touch::free || finger.depth_mm < 0.5) continue;
      ++touching;
      // The bound on a force's step: over a ridge the proxy leaps and what is felt follows (contact/felt_force.h).
      if ((finger.status & contact::kLettingGo) != 0) {
        ++held_back;
        continue;
      }
      const double normal_n = finger.force.dot(finger.normal);
      EXPECT_NEAR(normal_n / (stiffnessAt(vhb(), finger) * finger.depth_mm), 1.0, 1e-9);
    }
  }
  EXPECT_GT(touching, 15000u);
  EXPECT_LT(held_back, touching / 500);
}

TEST(VirtualHapticBack, SlipsAtTheKineticCoefficient) {  // 2.4
  std::size_t slipping = 0;
  for (const auto& tick : vhbTicks()) {
    for (const contact::FingerOutput& finger : tick) {
      if (finger.touch != contact::Touch::slip || finger.depth_mm < 0.5) continue;
      const double normal_n = finger.force.dot(finger.normal);
      EXPECT_NEAR((finger.force - normal_n * finger.normal).norm() / normal_n, 0.44, 1e-9);
      ++slipping;
    }
  }
  EXPECT_GT(slipping, 1000u);
}

/// How the first finger of a run drags the skin, seen 50 times a second.
struct Drag {
  double finger_mm = 0.0;  ///< the proxy's largest way from the anchor
  double depth_mm = 0.0;   ///< of the finger then
  double skin_mm = 0.0;    ///< the largest way of a vertex along the skin, then
};

Drag farthestDrag(const scene::World& world, const Ticks& ticks) {
  engine::LivingSkin skin(world);
  Drag farthest;
  for (std::size_t i = 0; i < ticks.size(); i += 20) {
    const contact::FingerOutput& finger = ticks[i][0];
    skin.follow(std::span(&finger, 1));
    const double dragged_mm = (finger.proxy - finger.anchor).norm();
    if (finger.touch == contact::Touch::free || dragged_mm <= farthest.finger_mm) continue;
    farthest = {dragged_mm, finger.depth_mm, 0.0};
    for (Index v = 0; v < skin.surface().vertices(); ++v) {
      const Vec3 moved = skin.surface().displacementAt(v).cast<double>();
      farthest.skin_mm = std::max(farthest.skin_mm, (moved - moved.dot(finger.normal) * finger.normal).norm());
    }
  }
  return farthest;
}

TEST(VirtualHapticBack, TheSkinFollowsTwentyMillimetresAtTenMillimetresDepth) {  // (4.16), (4.18)
  const Drag drag = farthestDrag(vhb(), vhbTicks());
  EXPECT_LE(drag.skin_mm, 20.0 + 1e-6);
  EXPECT_GT(drag.skin_mm, 15.0);
  EXPECT_NEAR(drag.finger_mm * 10.0 / drag.depth_mm, 20.0, 1.0) << "of a finger " << drag.depth_mm << " mm deep";
  EXPECT_NEAR(drag.depth_mm, 10.0, 1.0);
}

// "This anchor A works well in our applications" (2.4): the formulae as printed drag the skin as far as the corrected.
TEST(VirtualHapticBack, AsPrintedTheSkinFollowsAsFar) {  // E1
  const std::shared_ptr<const scene::World> printed = scene::build(scene::presetScene("vhb-literal"));
  EXPECT_NEAR(farthestDrag(*printed, simulateTicks(*printed)).skin_mm, farthestDrag(vhb(), vhbTicks()).skin_mm, 1.5);
}

TEST(VirtualHapticBack, FeelsTheSameThroughTheDetectingBoxAsOnTheWholeSkin) {  // chapter 3
  ASSERT_EQ(vhb().scene.contact.source, scene::ContactSource::hdb);
  scene::Scene scene = scene::presetScene("vhb");
  scene.contact.source = scene::ContactSource::surface;
  const Ticks whole = simulateTicks(*scene::rebuilt(vhb(), scene));
  ASSERT_EQ(whole.size(), vhbTicks().size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (std::size_t f = 0; f < whole[i].size(); ++f) {
      ASSERT_EQ(whole[i][f].force, vhbTicks()[i][f].force) << "tick " << i << ", finger " << f;
      ASSERT_EQ(whole[i][f].proxy, vhbTicks()[i][f].proxy) << "tick " << i << ", finger " << f;
    }
  }
}

TEST(VirtualHapticBack, IsFeltAtFullForceOnItsOwnDevice) {
  EXPECT_EQ(servo::limiterSettings(vhb()).stiffness_factor, 1.0);
  EXPECT_EQ(servo::limiterSettings(vhb()).force_n, 22.0);
}

TEST(VirtualHapticBack, AsPrintedHasEverySwitchOfFidelity) {
  const scene::Scene scene = scene::presetScene("vhb-literal");
  EXPECT_EQ(scene.fidelity, literalFidelity());
  EXPECT_EQ(scene::build(scene)->tissue.model, scene::TissueModel::literal);
}

TEST(VirtualHapticBack, IsOneWordOfTheCommandAnywhere) {
  const support::TemporaryFolder folder;
  const support::CommandResult run =
      support::runPalpate("simulate --preset vhb --no-pictures --no-plot --json --seconds 0.3", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report["preset"], "vhb");
  EXPECT_EQ(report["tissue"], "gaussian");
  EXPECT_EQ(report["law"], "linear");
  EXPECT_EQ(report["body"]["skin_triangles"], 2962);
  EXPECT_EQ(support::runPalpate("simulate --preset vbh", folder.path()).err,
            "palpate: --preset: 'vbh' is not one of "
            "vhb|trunk|dysfunctions|lumps|anatomy|thin|heavy|prone|sitting|two-fingers|"
            "two-devices|scan|strain|oiled|relaxation|breathing|stereo|detecting-box|fine-mesh|vhb-literal; did you "
            "mean 'vhb'? (see --help)\n");
  EXPECT_EQ(support::runPalpate("simulate a.toml --preset vhb", folder.path()).err,
            "palpate: a.toml and --preset vhb: only one scene can be given\n");
  EXPECT_NE(support::thrownMessage([] { scene::presetScene("back"); }).find("unknown preset 'back'"),
            std::string::npos);
}

TEST(VirtualHapticBack, IsTheFirstOfTheExamples) {
  for (const char* command : {"--help", "run --help"}) {
    const std::string help = support::runPalpate(command).out;
    const std::size_t examples = help.find("Examples:");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_EQ(help.find("palpate run", examples), help.find("palpate run --preset vhb", examples)) << command;
  }
}

TEST(TissueOfAScene, IsNamedInTheReportsOfARunAndOfItsRecording) {
  if (!support::hasProgramOf("recording report")) GTEST_SKIP() << "not built";
  const support::TemporaryFolder folder;
  writeFile(folder / "s.toml",
            "fidelity.E15 = \"literal\"\nseconds = 0.3\n[body]\nkind = \"torso\"\ntriangles = 5000\n"
            "[[finger]]\nname = \"a\"\nat = \"T6\"\nscript = [{ do = \"press\", depth_mm = 4, seconds = 0.3 }]\n");
  const support::CommandResult run =
      support::runPalpate("simulate s.toml --no-pictures --no-plot --session --json --out r", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["preset"], nullptr);
  EXPECT_EQ(json["tissue"], "gaussian");
  EXPECT_EQ(json["law"], "linear");
  const std::string note = "no layers because of fidelity.E15 = \\\"literal\\\"";
  EXPECT_NE(json["notes"].dump().find(note), std::string::npos) << json["notes"];

  // Numbers and page of one run: what they tell of is the same, and finding it takes long.
  const support::CommandResult report =
      support::runPalpate("recording report r/run.session --json -o page.html", folder.path());
  ASSERT_EQ(report.exit_code, 0) << report.err;
  const auto told = nlohmann::json::parse(report.out);
  EXPECT_EQ(told["coverage"]["tissue"], "half-Gaussian tissue, force F = k d");
  EXPECT_NE(told["coverage"]["notes"].dump().find(note), std::string::npos) << told["coverage"]["notes"];
  const std::string page = support::contentOf(folder / "page.html");
  EXPECT_NE(page.find("half-Gaussian tissue, force F = k d"), std::string::npos);
  EXPECT_NE(page.find("no layers because of fidelity.E15"), std::string::npos);
}

}  // namespace
}  // namespace palpate::app
