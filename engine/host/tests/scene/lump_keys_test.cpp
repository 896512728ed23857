// The table [[lump]], and what becomes of it in a body: every key, every message, and the world that has no lumps.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/tests/scene/dome_scene.h"
#include "host/tests/scene/scene_text.h"
#include "palpate/contact/finger.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_table.h"
#include "support/error_message.h"
#include "support/lump_field.h"

namespace palpate::scene {
namespace {

std::string lump(const std::string& keys) { return "[[lump]]\n" + keys; }

LumpSettings parseLump(const std::string& keys) { return parse(lump(keys), "s.toml").lumps.at(0); }

TEST(LumpKeys, AreReadWithTheirDefaults) {
  const LumpSettings plain = parseLump("x_mm = 3\n");
  EXPECT_EQ(plain.name, "");
  EXPECT_EQ(plain.depth_mm, 8.0);
  EXPECT_EQ(plain.halfAxes(), Vec3(5, 5, 5));
  EXPECT_EQ(plain.stiffness_ratio, 5.0);
  EXPECT_EQ(plain.young_kpa, 0.0);
  EXPECT_EQ(plain.mobility_mm_per_n, 0.0);
  const LumpSettings full = parseLump(
      "name = \"node\"\nat = \"T9 right 30 mm\"\ndepth_mm = 6\nhalf_axes_mm = [6, 6, 3]\nyoung_kpa = 60\nedge = 0.5\n"
      "mobility_mm_per_n = 2\nmobility_limit_mm = 4\n");
  EXPECT_EQ(full.at, "T9 right 30 mm");
  EXPECT_EQ(full.halfAxes(), Vec3(6, 6, 3));
  EXPECT_EQ(full.young_kpa, 60.0);
  EXPECT_EQ(full.edge, 0.5);
  EXPECT_EQ(full.mobility_limit_mm, 4.0);
}

TEST(LumpKeys, AreWrittenAndReadBack) {
  for (const std::string keys :
       {"x_mm = 3.0\n", "at = \"T9 right 30 mm\"\nyoung_kpa = 60.0\n", "name = \"a\"\nhalf_axes_mm = [6, 6, 3]\n",
        "diameter_mm = 12.0\nstiffness_ratio = 0.3\nmobility_mm_per_n = 5.0\n"}) {
    const Scene scene = parse(lump(keys), "s.toml");
    const Scene again = parse(sceneAsToml(scene, {}), "again.toml");
    ASSERT_EQ(again.lumps.size(), 1u) << sceneAsToml(scene, {});
    EXPECT_EQ(again.lumps[0].halfAxes(), scene.lumps[0].halfAxes());
    EXPECT_EQ(again.lumps[0].young_kpa, scene.lumps[0].young_kpa);
    EXPECT_EQ(again.lumps[0].stiffness_ratio, scene.lumps[0].stiffness_ratio);
    EXPECT_EQ(again.lumps[0].mobility_mm_per_n, scene.lumps[0].mobility_mm_per_n);
    EXPECT_EQ(again.lumps[0].at, scene.lumps[0].at);
  }
  const Scene pad = parse(kFinger + "pad = 8\npad_mm = 20\n[tissue]\nlumps = \"solved\"\n", "s.toml");
  const Scene again = parse(sceneAsToml(pad, {}), "again.toml");
  EXPECT_EQ(again.fingers[0].pad, 8u);
  EXPECT_EQ(again.fingers[0].pad_mm, 20.0);
  EXPECT_EQ(again.tissue.lumps, LumpForce::solved);
}

TEST(LumpKeys, AreRefusedWithFileAndLine) {
  EXPECT_EQ(messageFor(lump("stiffness_ratio = 5\nyoung_kpa = 60\n")),
            "s.toml:3: [[lump]] takes stiffness_ratio or young_kpa, not both");
  EXPECT_EQ(messageFor(lump("half_axes_mm = [6, 6, 3]\ndiameter_mm = 5\n")),
            "s.toml:3: [[lump]] takes diameter_mm or half_axes_mm, not both");
  EXPECT_EQ(messageFor(lump("diameter_mm = 1\n")), "s.toml:2: [[lump]] diameter_mm = 1 is out of range: 2 to 40");
  EXPECT_EQ(messageFor(lump("stiffness_ratio = 0.1\n")),
            "s.toml:2: [[lump]] stiffness_ratio = 0.1 is out of range: 0.2 to 1,000");
  EXPECT_EQ(messageFor(lump("mobility_mm_per_n = 0.01\n")),
            "s.toml:2: [[lump]] mobility_mm_per_n = 0.01 is out of range: 0.1 to 100, or 0");
  EXPECT_EQ(messageFor(lump("half_axes_mm = [6, 5, 3]\n")),
            "s.toml:2: [[lump]] half_axes_mm must begin with two equal numbers (a lump is round seen from above)");
  EXPECT_EQ(messageFor(lump("name = \"a\"\n") + lump("name = \"a\"\n")),
            "s.toml:3: a [[lump]] named 'a' already exists; names must be unique");
  EXPECT_EQ(messageFor(lump("diametre_mm = 4\n")),
            "s.toml:2: unknown key 'diametre_mm' in [[lump]]; did you mean 'diameter_mm'?");
  EXPECT_EQ(messageFor(kFinger + "pad = 1\n"), "s.toml:4: [[finger]] pad = 1 is out of range: 2 to 16, or 0");
}

TEST(LumpGround, OfTheLibraryHasTheFatOfTheScene) {
  HealthyTissue healthy;
  healthy.tissue.layered = std::make_shared<const tissue::LayeredTissue>(tissue::libraryNodes(8.0));
  Scene lean, stout;
  lean.tissue.fat_mm = 8.0;
  stout.tissue.fat_mm = 20.0;
  const LumpGround under_lean(lean, healthy, true, "lumps"), under_stout(stout, healthy, true, "lumps");
  EXPECT_NEAR(under_lean.stackAt(40.0).layers[1].thickness_mm, 8.0, 1e-9);
  EXPECT_NEAR(under_stout.stackAt(40.0).layers[1].thickness_mm, 20.0, 1e-9);
  EXPECT_NE(under_lean.numbers(), under_stout.numbers()) << "lumps in them do not share a table";
  EXPECT_EQ(under_lean.secantAt(40.0), healthy.tissue.layered->secantAt(40.0, tissue::kReferenceDepthMm));
}

/// A dome of one stack whose field is known.
class LumpsInADome : public DomeScene {
 protected:
  void SetUp() override {
    writeDome("dome.obj");
    tissue::LayeredTable table = test::inventedTable();
    tissue::writeLayeredTable(folder_ / "back.json", table);
    table.field.reset();
    tissue::writeLayeredTable(folder_ / "bare.json", table);
  }
  /// The lumps' first line is the sixth.
  std::shared_ptr<const World> buildLumpWorld(const std::string& lumps, const std::string& table = "back.json") const {
    return build(meshScene("[tissue]\nlayer_table = \"" + table + "\"\n" + lumps));
  }
  std::string messageOfBuild(const std::string& lumps, const std::string& table = "back.json") const {
    std::string message = support::thrownMessage([&] { buildLumpWorld(lumps, table); });
    const std::string folder = folder_.path().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
      message.erase(at, folder.size());
    }
    return message;
  }
};

TEST_F(LumpsInADome, ALumpIsPlacedUnderTheSkinAndTold) {
  const auto world = buildLumpWorld("[[lump]]\nname = \"a\"\nx_mm = 5\ny_mm = 5\ndepth_mm = 5\nyoung_kpa = 60\n");
  ASSERT_EQ(world->lumps.size(), 1u);
  ASSERT_EQ(world->surface.lumps->all.size(), 1u);
  const PlacedLump& placed = *world->lumps[0];
  EXPECT_NEAR(placed.lump.foot.z(), 19.9, 0.1);
  EXPECT_GT(placed.lump.axis.z(), 0.99);
  EXPECT_EQ(placed.young_kpa, 60.0);
  EXPECT_EQ(placed.layer_kpa, 10.0);
  EXPECT_GT(placed.share[0], 0.0);
  EXPECT_NE(placed.note.find("60 kPa in tissue of 10 kPa"), std::string::npos) << placed.note;
  ASSERT_NE(world->pressure, nullptr);
  const contact::FingerSettings settings = contactSettings(world->scene, world->scene.fingers[0]);
  contact::FingerState state;
  contact::step(world->surface, settings, state, {5, 5, 21});
  const contact::FingerOutput felt = contact::step(world->surface, settings, state, {5, 5, 15});
  EXPECT_GT(felt.lump_share, 0.0);
}

TEST_F(LumpsInADome, ThoseThatCannotBeThereAreRefusedWithFileAndLine) {
  EXPECT_EQ(messageOfBuild("[[lump]]\nx_mm = 5\ndepth_mm = 2\n"),
            "s.toml:8: depth_mm = 2 in [[lump]] is out of range: the top must be at least 0.5 mm below the skin layer, "
            "here 2.5 to 29.0 mm");
  EXPECT_EQ(messageOfBuild("[[lump]]\nname = \"a\"\ndepth_mm = 31\n"),
            "s.toml:6: lump 'a' reaches the bone: its bottom is at 41.0 mm, the bone at 40.0 mm");
  EXPECT_EQ(messageOfBuild("[[lump]]\nname = \"a\"\n[[lump]]\nname = \"b\"\nx_mm = 7\n"),
            "s.toml:8: lumps 'a' and 'b' overlap by 3.2 mm");
  EXPECT_EQ(messageOfBuild("[[lump]]\nx_mm = 500\n"),
            "s.toml:6: lump 'lump1' has no skin over it at x_mm = 500, y_mm = 0");
  EXPECT_EQ(
      messageOfBuild("[[lump]]\n", "bare.json"),
      "s.toml:6: bare.json has no press field, which lumps require; make the table with palpate tissue solve --field");
  EXPECT_EQ(support::thrownMessage([&] { build(meshScene("[[lump]]\n")); }),
            (folder_ / "s.toml").string() + ":4: lumps require layered tissue; set [tissue] layer_table");
  std::string many;
  for (int i = 0; i <= 64; ++i) many += "[[lump]]\n";
  EXPECT_EQ(messageOfBuild(many), "s.toml:70: more than 64 [[lump]]");
  EXPECT_EQ(messageOfBuild("[[lump]]\nat = \"T99\"\n").substr(0, 10), "s.toml:6: ");
  EXPECT_NE(messageOfBuild("lumps = \"solved\"\n[[lump]]\n").find("lumps = \"solved\" run `palpate lump solve`"),
            std::string::npos);
}

TEST_F(LumpsInADome, NeighboursThatPassTheLoadOnAreNoted) {
  const auto near = buildLumpWorld("[[lump]]\n[[lump]]\nx_mm = 13\n");
  EXPECT_TRUE(std::ranges::any_of(near->notes, [](const std::string& note) {
    return note.find("'lump1' and 'lump2' are 2.") != std::string::npos;
  }));
  const auto far = buildLumpWorld("[[lump]]\n[[lump]]\nx_mm = 16\n");
  EXPECT_TRUE(std::ranges::none_of(far->notes,
                                   [](const std::string& note) { return note.find("apart") != std::string::npos; }));
}

TEST_F(LumpsInADome, TheForceFollowsTheStiffnessOfThePlace) {
  const std::string one = "[[lump]]\nx_mm = 0\n";
  const auto soft = buildLumpWorld(one + "[stiffness]\nconstant_n_per_mm = 0.3\n");
  const auto stiff = buildLumpWorld(one + "[stiffness]\nconstant_n_per_mm = 0.6\n");
  const auto energy = [](const World& world) { return world.lumps[0]->lump.energy.at(3.0, 4.0).energy_n_mm; };
  EXPECT_NEAR(energy(*stiff), 2.0 * energy(*soft), 1e-12);
  EXPECT_NEAR(stiff->lumps[0]->share[1], soft->lumps[0]->share[1], 1e-12);
}

TEST_F(LumpsInADome, NoPlaceIsSteeperThanALoopHolds) {
  std::size_t bounded = 0;
  for (const double stiffness : {0.3, 0.8, 1.3, 1.8}) {
    for (const std::string size : {"diameter_mm = 10\n", "half_axes_mm = [12, 12, 8]\n"}) {
      const auto world = buildLumpWorld("[[lump]]\nx_mm = 5\ndepth_mm = 3\nyoung_kpa = 1000\n" + size +
                                        "[stiffness]\nconstant_n_per_mm = " + std::to_string(stiffness) + "\n");
      const PlacedLump& placed = *world->lumps[0];
      const tissue::PressedPlace fingertip{placed.thickness_mm, tissue::kFingertipMm};
      for (double depth = 0.25; depth <= placed.lump.energy.deepestMm(); depth += 0.25) {
        const double plain = tissue::tangentStiffness(world->surface.force_law, stiffness, depth, fingertip);
        const double more =
            (placed.lump.energy.at(0.0, depth).d_depth - placed.lump.energy.at(0.0, depth - 0.25).d_depth) / 0.25;
        EXPECT_LE(more, std::max(tissue::kStiffestTissue - plain, 0.25 * plain) + 1e-9) << stiffness << ' ' << depth;
      }
      bounded += std::ranges::count_if(world->notes,
                                       [](const std::string& note) { return note.starts_with("lumps push with "); });
    }
  }
  EXPECT_GT(bounded, 0u) << "some of these would be steeper";
  EXPECT_LT(bounded, 8u) << "and some are not";
}

TEST_F(LumpsInADome, AnotherMapTakesTheTablesOver) {
  const auto world = buildLumpWorld("[[lump]]\nx_mm = 5\n");
  Scene scene = world->scene;
  scene.dysfunctions.push_back({.x_mm = 5, .y_mm = 0, .radius_mm = 15, .change_percent = 50});
  const auto next = rebuilt(*world, scene);
  EXPECT_NEAR(next->lumps[0]->lump.energy.at(0.0, 4.0).d_depth, 1.5 * world->lumps[0]->lump.energy.at(0.0, 4.0).d_depth,
              0.05 * next->lumps[0]->lump.energy.at(0, 4).d_depth);
}

TEST_F(LumpsInADome, ASwellingIsSeenAndFeltAtRestAndGoesWithItsLump) {
  const auto world = buildLumpWorld("[[lump]]\nraise_mm = 3\n");  // over a vertex
  EXPECT_NEAR(world->lumps[0]->lump.foot.z(), 20.0 + 3.0, 0.1);
  EXPECT_NEAR(world->body->box.max().z(), 23.0, 0.1);
  Scene flat = world->scene;
  flat.lumps.clear();
  EXPECT_NEAR(rebuilt(*world, flat)->body->box.max().z(), 20.0, 0.1);
  Scene softer = world->scene;
  softer.lumps[0].stiffness_ratio = 2;
  EXPECT_EQ(rebuilt(*world, softer)->body, world->body) << "the same skin";
}

TEST_F(LumpsInADome, AWorldWithoutLumpsIsAsItWas) {
  const auto world = buildLumpWorld("");
  EXPECT_EQ(world->surface.lumps, nullptr);
  EXPECT_EQ(world->pressure, nullptr);
  EXPECT_TRUE(world->lumps.empty());
  EXPECT_NE(pressureGround(*world), nullptr) << "made when it is asked for";
}

}  // namespace
}  // namespace palpate::scene
