// Keys of [friction], [tissue] and [stiffness] that say more than one number, or that must go together.
#include <gtest/gtest.h>

#include "host/tests/scene/dome_scene.h"
#include "palpate/scene/scene_edit.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/scene/world.h"
#include "palpate/tissue/published.h"
#include "support/error_message.h"

namespace palpate::scene {
namespace {

std::pair<double, double> grip(const Scene& scene) {
  return {scene.contact.finger.mu_static, scene.contact.finger.mu_dynamic};
}

std::pair<double, double> gripOf(const std::string& friction) {
  return grip(parse("[friction]\n" + friction, "s.toml"));
}

TEST(FrictionSkin, NamesThePublishedPresets) {
  for (const tissue::FrictionPreset& preset : tissue::frictionPresets()) {
    const std::string line = "skin = \"" + std::string(preset.name) + "\"\n";
    EXPECT_EQ(gripOf(line), std::pair(preset.still, preset.slipping)) << preset.name;
  }
  EXPECT_EQ(gripOf("skin = \"dry\"\n"), grip({})) << "what a scene has by itself";
  EXPECT_EQ(gripOf("skin = \"oiled\"\n"), std::pair(0.2, 0.2));
}

TEST(FrictionSkin, YieldsToWrittenCoefficientsInAnyOrder) {
  EXPECT_EQ(gripOf("skin = \"oiled\"\nstatic = 0.25\n"), std::pair(0.25, 0.2));
  EXPECT_EQ(gripOf("static = 0.25\nskin = \"oiled\"\n"), std::pair(0.25, 0.2));
  EXPECT_EQ(gripOf("dynamic = 0.1\nskin = \"oiled\"\n"), std::pair(0.2, 0.1));
  EXPECT_EQ(gripOf("skin = \"oiled\"\nstatic = 0.46\n"), std::pair(0.46, 0.2)) << "written, though it is the default";
}

TEST(FrictionSkin, IsRefusedWhereItIsNoneOrLeavesTheCoefficientsTheWrongWayRound) {
  const auto message = [](const std::string& keys) {
    return support::thrownMessage([&] { parse("[friction]\n" + keys, "s.toml"); });
  };
  EXPECT_NE(message("skin = \"wett\"\n").find("s.toml:2"), std::string::npos) << message("skin = \"wett\"\n");
  EXPECT_NE(message("skin = \"wett\"\n").find("\"oiled\""), std::string::npos) << message("skin = \"wett\"\n");
  EXPECT_NE(message("skin = \"oiled\"\ndynamic = 0.3\n").find("dynamic must not be above static"), std::string::npos);
}

TEST(FrictionSkin, IsWrittenAndReadBackWhateverCameAfterIt) {
  for (const std::string keys :
       {"skin = \"oiled\"\n", "skin = \"dry\"\n", "skin = \"oiled\"\nstatic = 0.46\n",
        "skin = \"oiled\"\nstatic = 0.46\ndynamic = 0.44\n", "static = 0.2\ndynamic = 0.2\n", "static = 0.6\n"}) {
    const Scene scene = parse("[friction]\n" + keys, "s.toml");
    EXPECT_EQ(grip(parse(sceneAsToml(scene, {}), "copy.toml")), grip(scene)) << keys << sceneAsToml(scene, {});
  }
  EXPECT_EQ(sceneAsToml(parse("[friction]\nskin = \"dry\"\n", "s.toml"), {}).find("[friction]"), std::string::npos);
}

TEST(FrictionSkin, IsAChoiceOfTheWindowAndNoneWhereTheCoefficientsAreOnesOwn) {
  Scene scene;
  EXPECT_EQ(keyOf(scene, "friction", "skin")->fallback, "\"dry\"");
  setKey(scene, "friction", "skin", "\"oiled\"");
  EXPECT_EQ(grip(scene), std::pair(0.2, 0.2));
  setKey(scene, "friction", "static", "0.3");
  EXPECT_EQ(grip(scene), std::pair(0.3, 0.2));
  EXPECT_EQ(keyOf(scene, "friction", "skin")->fallback, "");
}

TEST(RelaxationKeys, AreOffByDefaultAndReachEveryFinger) {
  EXPECT_FALSE(contactSettings(Scene(), Finger()).relaxation.on());
  const Scene scene =
      parse("[tissue]\nrelaxation = 0.15\nrelaxation_s = 2\nrelaxation_2 = 0.3\nrelaxation_2_s = 0.4\n", "s.toml");
  for (const Scene& one : {scene, parse(sceneAsToml(scene, {}), "copy.toml")}) {
    const contact::Relaxation relaxation = contactSettings(one, Finger()).relaxation;
    EXPECT_EQ(relaxation.share, 0.15);
    EXPECT_EQ(relaxation.time_s, 2.0);
    EXPECT_EQ(relaxation.share_2, 0.3);
    EXPECT_EQ(relaxation.time_2_s, 0.4);
  }
}

TEST(RelaxationKeys, LeaveSomeForceInTheEnd) {
  const auto message = [](const std::string& keys) {
    return support::thrownMessage([&] { parse("[tissue]\n" + keys, "s.toml"); });
  };
  EXPECT_NE(message("relaxation = 0.95\n").find("s.toml:2"), std::string::npos);
  EXPECT_NE(message("relaxation_s = 0\n").find("s.toml:2"), std::string::npos);
  EXPECT_NE(message("relaxation = 0.5\nrelaxation_2 = 0.5\n").find("together must be at most 0.9"), std::string::npos);
}

class Variation : public DomeScene {};

TEST_F(Variation, MultipliesTheMapOfTheWorldByPlace) {
  writeDome("dome.obj");
  const auto plain = build(meshScene());
  const auto varied = build(meshScene("[stiffness]\nvariation = 0.3\n"));
  const std::vector<double> factors = maps::variationAt(plain->body->skin.positions, varied->scene.stiffness.variation);
  ASSERT_EQ(varied->surface.stiffness_n_per_mm->size(), factors.size());
  double least = 1.0;
  for (std::size_t v = 0; v < factors.size(); ++v) {
    EXPECT_DOUBLE_EQ((*varied->surface.stiffness_n_per_mm)[v], (*plain->surface.stiffness_n_per_mm)[v] * factors[v])
        << v;
    least = std::min(least, factors[v]);
  }
  EXPECT_LT(least, 0.8);
  EXPECT_EQ(*rebuilt(*varied, plain->scene)->surface.stiffness_n_per_mm, *plain->surface.stiffness_n_per_mm)
      << "and is taken back";
}

TEST(VariationKeys, MakeTheSameBodyAgain) {
  const Scene scene = parse("[stiffness]\nvariation = 0.2\nvariation_mm = 25\nvariation_seed = 4000000000\n", "s.toml");
  for (const Scene& one : {scene, parse(sceneAsToml(scene, {}), "copy.toml")}) {
    EXPECT_EQ(one.stiffness.variation.variation, 0.2);
    EXPECT_EQ(one.stiffness.variation.length_mm, 25.0);
    EXPECT_EQ(one.stiffness.variation.seed, 4'000'000'000u);
  }
  EXPECT_EQ(Scene().stiffness.variation.variation, 0.0);
}

}  // namespace
}  // namespace palpate::scene
