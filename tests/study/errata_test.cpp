#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene_file.h"
#include "study/errata/errata_report.h"
#include "study/errata/errata_study.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::study {
namespace {

/// Two fingers press and drag on a hilly sheet of 400 x 400 mm with two key points, in a second.
std::vector<ErratumEffect> measured() {
  const support::TemporaryFolder folder;
  mesh::save(folder / "sheet.obj", zoo::wavyGrid(40, 400.0, 12.0));
  std::ofstream(folder / "keys.csv") << "a,170,190,60,1.5,170\nb,300,280,90,1.3,10\n";
  std::ofstream(folder / "s.toml") << R"(
body = { kind = "mesh", file = "sheet.obj" }
ellipses = { key_points = "keys.csv", basic_radius_mm = 50 }
partition = { threshold = 64 }
[[finger]]
name = "index"
at_mm = [180, 200]
script = [{ do = "press", depth_mm = 9, seconds = 0.4 }, { do = "drag", by_mm = [40, 25], seconds = 0.6 }]
[[finger]]
name = "middle"
at_mm = [215, 200]
script = [{ do = "press", depth_mm = 8, seconds = 1 }]
)";
  return studyErrata(scene::load(folder / "s.toml"));
}

const std::vector<ErratumEffect>& effects() {
  static const std::vector<ErratumEffect> once = measured();
  return once;
}

const ErratumEffect& effect(Erratum erratum) { return effects().at(static_cast<std::size_t>(erratum)); }

TEST(Errata, HaveOneRowEachAndOneForAllTogether) {
  ASSERT_EQ(effects().size(), static_cast<std::size_t>(kErrata) + 1);
  for (int number = 0; number <= kErrata; ++number) {
    EXPECT_EQ(effect(static_cast<Erratum>(number)).text.erratum, static_cast<Erratum>(number));
  }
}

TEST(Errata, ThatCanBeReadOtherwiseAreMeasuredAndTheOthersSayWhyNot) {
  for (const ErratumEffect& row : effects()) {
    EXPECT_EQ(row.reading.empty(), row.text.form == scene::LiteralForm::none && row.text.erratum != Erratum::none)
        << numberOf(row.text.erratum);
  }
}

TEST(Errata, OfTheRegionsMoveTheSkinAndLeaveTheForceAlone) {
  for (const Erratum e : {Erratum::E1_anchor, Erratum::E14_location_ratio, Erratum::E15_aspect,
                          Erratum::E18_profile_rim, Erratum::E20_zero_boundary, Erratum::E21_press_region,
                          Erratum::E25_two_fingers, Erratum::E28_effect_radius, Erratum::E29_mean_of_angles}) {
    EXPECT_GT(effect(e).skin_mm, 1e-3) << scene::nameOf(e);
    EXPECT_EQ(effect(e).force_n, 0.0) << scene::nameOf(e);
  }
}

TEST(Errata, OfThePartitionMissTriangles) {
  EXPECT_GT(effect(Erratum::E4_else_if).missed_percent, 50.0);
  EXPECT_GT(effect(Erratum::E4_else_if).lost_ticks, 0u) << "with ELSEIF the finger falls through";
  for (const Erratum e : {Erratum::E5_cell_box, Erratum::E6_three_octants, Erratum::E11_sphere_corners}) {
    EXPECT_GT(effect(e).missed_percent, 1.0) << "E" << static_cast<int>(e);
  }
  EXPECT_EQ(effect(Erratum::E7_leaf_threshold).missed_percent, 0.0)
      << "another leaf rule makes other leaves, not fewer triangles";
}

TEST(Errata, WithoutAPlaceInTheSceneChangeNothing) {
  EXPECT_EQ(effect(Erratum::E31_down_like_up).skin_mm, 0.0) << "the key points are the scene's own";
  EXPECT_LT(effect(Erratum::E24_pure_shear).skin_mm, 1e-4) << "principal strain is seen, not felt";
  EXPECT_GT(effect(Erratum::E24_pure_shear).strain_percent, 0.1);
}

TEST(Errata, AreReportedForPeopleAndForMachines) {
  const auto json = nlohmann::json::parse(errataJson(effects()));
  EXPECT_EQ(json["errata"].size(), static_cast<std::size_t>(kErrata));
  EXPECT_EQ(json["errata"][13]["reading"], "fidelity.E14 = \"literal\"");
  EXPECT_EQ(json["errata"][21]["not_measured"], "nothing to switch");
  EXPECT_TRUE(json["all_literal"].contains("skin_mm"));
  EXPECT_NE(errataText(effects()).find("E29"), std::string::npos);
  const support::TemporaryFolder folder;
  writeErrata(effects(), folder / "out");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/errata.csv"));
}

}  // namespace
}  // namespace palpate::study
