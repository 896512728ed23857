#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "dissertation/errata/errata_study.h"
#include "dissertation/report/report.h"
#include "palpate/base/error.h"
#include "palpate/hdb/literal_traversal.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/words.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::study {
namespace {

/// Two fingers press and drag on a hilly sheet of 400 x 400 mm with two key points, in a second.
ErrataEffects measured() {
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

const ErrataEffects& effects() {
  static const ErrataEffects once = measured();
  return once;
}

const ErratumEffect& effect(Erratum erratum) { return effects().errata.at(static_cast<std::size_t>(erratum) - 1); }

const ErratumEffect& allWith(const std::string& base) {
  for (const ErratumEffect& row : effects().all_literal) {
    if (row.base == base) return row;
  }
  throw Error("no row for " + base);
}

Fidelity without(const std::string& inert) {
  Fidelity fidelity = literalFidelity();
  for (const ErratumEffect& row : effects().errata) {
    if (scene::parseFidelity(inert).literal(row.text.erratum)) fidelity.setLiteral(row.text.erratum, false);
  }
  return fidelity;
}

TEST(Errata, HaveOneRowEachAndAllTogetherOneForEachSourceOfContact) {
  ASSERT_EQ(effects().errata.size(), static_cast<std::size_t>(kErrata));
  for (int number = 1; number <= kErrata; ++number) {
    EXPECT_EQ(effect(erratumOf(number)).text.erratum, erratumOf(number));
  }
  ASSERT_EQ(effects().all_literal.size(), 3u);
  ASSERT_EQ(effects().corrected.size(), 3u);
}

TEST(Errata, SayInEachRowWhatWasActive) {
  EXPECT_EQ(effect(Erratum::E14_location_ratio).active, "contact.source = \"surface\"");
  EXPECT_EQ(effect(Erratum::E4_else_if).active, "contact.source = \"hdb\", partition.tree = \"bsp\", radius_mm = 0");
  EXPECT_EQ(effect(Erratum::E6_three_octants).base, "octree");
  EXPECT_NE(errataText(effects()).find("inert: E4, E5, E6, E7, E10, E11, E12"), std::string::npos);
}

TEST(Errata, SayInEachRowOnWhichBodyAndTissueItWasMeasured) {
  for (const auto* rows : {&effects().errata, &effects().corrected, &effects().all_literal}) {
    for (const ErratumEffect& row : *rows) {
      EXPECT_EQ(row.body.find("sheet.obj") == std::string::npos, !row.isMeasured()) << row.reading << ": " << row.body;
      EXPECT_EQ(row.tissue.empty(), !row.isMeasured()) << row.reading;
    }
  }
  EXPECT_EQ(effect(Erratum::E18_profile_rim).tissue, "half-Gaussian tissue, force F = k d");
  EXPECT_EQ(allWith("surface").tissue, "half-Gaussian tissue as printed, force F = k d");
  EXPECT_NE(errataText(effects()).find("body and tissue"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(errataJson(effects()))["errata"][13]["tissue"],
            "half-Gaussian tissue, force F = k d");
}

TEST(Errata, TogetherTakeTheFingerAwayWhereItTouchesThroughThePrintedSearchOfTheBspTree) {
  EXPECT_EQ(allWith("surface").force_n, 0.0) << "without a partition no printed search is asked";
  EXPECT_GT(allWith("surface").skin_mm, 1.0);
  EXPECT_LT(allWith("bsp").look.touching_percent, 0.5 * effects().corrected[1].look.touching_percent);
  EXPECT_GT(allWith("bsp").force_n, 0.5);
}

TEST(Errata, CalledInertChangeNoSearch) {
  EXPECT_EQ(hdb::literalTraversal(without(allWith("bsp").inert), hdb::TreeKind::Bsp),
            hdb::literalTraversal(literalFidelity(), hdb::TreeKind::Bsp));
  EXPECT_EQ(hdb::literalTraversal(without(allWith("octree").inert), hdb::TreeKind::Octree),
            hdb::literalTraversal(literalFidelity(), hdb::TreeKind::Octree));
  EXPECT_NE(hdb::literalTraversal(without("E4,E5,E10"), hdb::TreeKind::Bsp), hdb::LiteralTraversal::ElseIf);
}

TEST(Errata, OfTheDragSpringLetTheSkinFollowFarther) {
  const double ours = effects().corrected[0].look.drag_mm;
  EXPECT_GT(ours, 1.0);
  EXPECT_NEAR(effect(Erratum::E2_drag_spring).look.drag_mm / ours, 1.0 / 0.23, 0.7);
}

TEST(Errata, ThatCanBeReadOtherwiseAreMeasuredAndTheOthersSayWhyNot) {
  for (const ErratumEffect& row : effects().errata) {
    EXPECT_EQ(row.isMeasured(), row.text.form != scene::LiteralForm::none) << numberOf(row.text.erratum);
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
  EXPECT_EQ(json["errata"][3]["active"], effect(Erratum::E4_else_if).active);
  EXPECT_TRUE(json["all_literal"][0].contains("skin_mm"));
  EXPECT_EQ(json["all_literal"][1]["inert"], allWith("bsp").inert);
  EXPECT_NE(errataText(effects()).find("E29"), std::string::npos);
  const support::TemporaryFolder folder;
  writeErrata(effects(), folder / "out");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/errata.csv"));
}

// A verdict is made of the numbers beside it: another number, another sentence.

std::string findingsFor(const ErrataEffects& changed) {
  return fmt::format("{}", fmt::join(errataFindings(changed), "\n"));
}

TEST(ErrataList, SaysOfEachHowThePrintedFormComesBack) {
  const std::string list = errataList();
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), kErrata + 2) << "a head, its line, a row an erratum";
  for (const scene::ErratumText& erratum : scene::errata()) {
    const std::string row = fmt::format("\n| {} | {} | {} | {} | ", scene::nameOf(erratum.erratum), erratum.printed,
                                        erratum.ours, wordFor(erratum.by_default));
    EXPECT_NE(list.find(row), std::string::npos) << row;
  }
  EXPECT_NE(list.find("| fidelity: the shape of the deformation regions |\n"), std::string::npos) << "E14";
  EXPECT_NE(list.find("| `strain.kind` |\n"), std::string::npos) << "E24";
  EXPECT_NE(list.find("| none: the text does not say |\n"), std::string::npos) << "E9";
}

TEST(ErrataFindings, FollowTheNumbers) {
  ErrataEffects changed = effects();
  EXPECT_NE(findingsFor(changed).find("no force changes"), std::string::npos);
  changed.all_literal[0].force_n = 1.5;
  EXPECT_EQ(findingsFor(changed).find("no force changes"), std::string::npos);
  EXPECT_NE(findingsFor(changed).find("forces change by up to 1.50 N"), std::string::npos);
  changed.all_literal[1].look.touching_percent = 40.0;
  EXPECT_EQ(findingsFor(changed).find("nothing is felt at all"), std::string::npos);
  changed.all_literal[1].look.touching_percent = 0.0;
  EXPECT_NE(findingsFor(changed).find("nothing is felt at all"), std::string::npos);
}

TEST(ErrataFindings, NameTheOneThatChangesMostAndThoseThatChangeNothing) {
  ErrataEffects changed = effects();
  changed.errata[28].skin_mm = 99.0;
  changed.errata[3].lost_ticks = 0;
  EXPECT_NE(findingsFor(changed).find("seen most is that of E29 (99.0"), std::string::npos);
  EXPECT_NE(findingsFor(changed).find("no finger loses contact by it"), std::string::npos);
  for (ErratumEffect& row : changed.errata) {
    row.force_n = row.proxy_mm = row.missed_percent = row.skin_mm = row.strain_percent = 1.0;
  }
  EXPECT_NE(findingsFor(changed).find("each of them changed something"), std::string::npos);
  EXPECT_NE(findingsFor(changed).find("26 of 34 errata"), std::string::npos);
}

}  // namespace
}  // namespace palpate::study
