// `palpate body fit` as a user calls it, and what is done with the scene that it writes.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "palpate/body/places.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/repair.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

/// The back of a built-in trunk as a scan in metres, turned about z by 140 degrees; truth in the same.
class FitBody : public testing::Test {
 protected:
  static const body::Trunk& trunk() {
    static const body::Trunk made = [] {
      body::TrunkShape shape;
      shape.stature_mm = 1680;
      shape.body_mass_index = 26;
      return body::makeTrunk({.triangles = 22000, .bone_triangles = 6000, .shape = shape});
    }();
    return made;
  }
  static Vec3 inFile(const Vec3& p) {
    return 1e-3 * (Eigen::AngleAxisd(140 * kRadPerDeg, Vec3::UnitZ()) * p + Vec3(300, 20, 900));
  }
  static Vec3 truth(const std::string& spoken) {
    for (const body::SkinLandmark& landmark : trunk().landmarks) {
      if (body::spokenName(landmark.name) == spoken) return inFile(landmark.position);
    }
    ADD_FAILURE() << spoken;
    return {};
  }
  /// Made once a test program.
  static const mesh::TriangleMesh& scanOfTheBack() {
    static const mesh::TriangleMesh made = [] {
      mesh::TriangleMesh scan = trunk().skin;
      std::erase_if(scan.triangles, [&](const Triangle& t) {
        const Vec3 p = centreOf(scan, t);
        return std::abs(p.x()) > 170 || p.y() < -320 || p.y() > 190 || p.z() < 0;
      });
      scan = mesh::repair(std::move(scan), {.find_self_intersections = false}).mesh;
      for (Vec3& p : scan.positions) p = inFile(p);
      return scan;
    }();
    return made;
  }
  void SetUp() override { mesh::save(folder / "scan.ply", scanOfTheBack()); }
  support::CommandResult palpate(const std::string& arguments) const {
    return support::runPalpate(arguments, folder.path());
  }
  /// A landmark shown where it is, or where another one is.
  static std::string at(const std::string& name, const std::string& where = "") {
    const Vec3 p = truth(where.empty() ? name : where);
    return " --at '" + name + "=" + std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z()) +
           "'";
  }

  support::TemporaryFolder folder;
};

TEST_F(FitBody, AScanInMetresThatLiesOnItsSideBecomesASceneWithNamesAndBones) {
  const auto fitted = palpate("body fit scan.ply --json -o back.toml" + at("T1") + at("T6") + at("L4") +
                              at("left PSIS") + at("right PSIS"));
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  const auto json = nlohmann::json::parse(fitted.out);
  EXPECT_TRUE(json["sure_enough"]);
  EXPECT_NEAR(json["turned_deg"], 140, 5);
  EXPECT_NE(json["notes"].dump().find("metres"), std::string::npos);
  std::size_t spines = 0;
  for (const auto& landmark : json["landmarks"]) {
    const std::string spoken = landmark["spoken"];
    if (!landmark["name"].get<std::string>().starts_with("spinous_T")) continue;
    ++spines;
    const Vec3 found(landmark["scan_mm"][0], landmark["scan_mm"][1], landmark["scan_mm"][2]);
    EXPECT_LT((found - 1000 * truth(spoken)).norm(), 6) << spoken;
  }
  EXPECT_EQ(spines, 12u);

  writeFile(folder / "press.toml", support::contentOf(folder / "back.toml") +
                                       "\n[[finger]]\nname = \"beside\"\nat = \"T9 right 30 mm\"\n"
                                       "script = [ { do = \"press\", depth_mm = 3, seconds = 0.5 } ]\n");
  const auto felt = palpate("simulate press.toml --no-pictures --no-plot --json --out run");
  EXPECT_EQ(felt.exit_code, 0) << felt.err;
  EXPECT_GT(std::filesystem::file_size(folder / "run/forces.csv"), 1000u);

  writeFile(folder / "nowhere.toml", support::contentOf(folder / "press.toml") + "\n[[dysfunction]]\nat = \"T66\"\n");
  EXPECT_NE(palpate("simulate nowhere.toml --out run2").err.find("unknown place"), std::string::npos);
}

class FitBodyByShapeAlone : public FitBody {};

TEST_F(FitBodyByShapeAlone, IsEnoughForThisScanAndAnotherScanIsNotTakenForIt) {
  const auto fitted = palpate("body fit scan.ply -o back.toml");
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_NE(fitted.out.find("certainty"), std::string::npos);
  EXPECT_NE(fitted.out.find("back.aligned.ply"), std::string::npos);
  writeFile(folder / "other.toml",
            "[body]\nkind = \"mesh\"\nfile = \"scan.ply\"\nunit = \"m\"\nfit = \"back.fit.json\"\n"
            "[[finger]]\nname = \"a\"\nat = \"T6\"\nscript = [ { do = \"press\" } ]\n");
  const auto other = palpate("simulate other.toml --out run");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("back.fit.json: the fit does not match this scan"), std::string::npos) << other.err;
}

TEST_F(FitBody, WhatIsNoBackIsRefusedAndNothingIsWritten) {
  mesh::save(folder / "cube.obj", zoo::cube(500));
  const auto refused = palpate("body fit cube.obj -o cube.toml");
  EXPECT_EQ(refused.exit_code, 1) << refused.err;
  EXPECT_NE(refused.err.find("not sure enough"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--at"), std::string::npos) << "what would help";
  EXPECT_FALSE(std::filesystem::exists(folder / "cube.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder / "cube.fit.json"));
}

TEST_F(FitBody, WrongInputIsSaidInOneLine) {
  writeFile(folder / "points.csv", "name,x,y,z\nT6,1,2,3\nT9,1,2\n");
  for (const auto& [arguments, words] : std::vector<std::pair<std::string, std::string>>{
           {"body fit missing.ply -o a.toml", "missing.ply"},
           {"body fit scan.ply -o a.json", ".toml"},
           {"body fit scan.ply -o a.toml --at T6", "NAME=X,Y,Z"},
           {"body fit scan.ply -o a.toml --at T6=1,2", "three numbers"},
           {"body fit scan.ply -o a.toml --points points.csv", "points.csv:3"},
           {"body fit scan.ply -o a.toml --points none.csv", "none.csv"},
           {"body fit scan.ply -o a.toml" + at("T6", "L3"), "'T6' differs from the shape"}}) {
    const auto end = palpate(arguments);
    EXPECT_EQ(end.exit_code, 2) << arguments;
    EXPECT_NE(end.err.find(words), std::string::npos) << arguments << ": " << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.toml")) << arguments;
  }
}

}  // namespace
}  // namespace palpate
