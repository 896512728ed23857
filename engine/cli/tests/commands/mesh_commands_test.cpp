// `palpate body info` and `palpate body repair` as a user calls them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/validate.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

class MeshCommands : public testing::Test {
 protected:
  support::CommandResult palpate(const std::string& arguments) const {
    return support::runPalpate(arguments, folder.path());
  }

  support::TemporaryFolder folder;
};

TEST_F(MeshCommands, InfoCountsTraits) {
  mesh::save(folder / "fin.obj", zoo::cubeWithFin());
  const auto text = palpate("body info fin.obj");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("2 triangles doubled from the other side"), std::string::npos) << text.out;
  const auto json = nlohmann::json::parse(palpate("body info fin.obj --json").out);
  EXPECT_EQ(json["triangles"], 16);
  EXPECT_EQ(json["fit"], false);
  EXPECT_EQ(json["traits"]["opposite_triangles"]["first"], (std::vector<int>{13, 15}));
}

TEST_F(MeshCommands, InfoTellsTheNumbersOfAPly) {
  writeFile(folder / "foot.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float pressure\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element face 1\nproperty list uchar int vertex_indices\nproperty int label\nproperty float void\n"
            "end_header\n0 0 0 1.5 9 9 9\n100 0 0 nan 9 9 9\n0 100 0 12.25 9 9 9\n3 0 1 2 7 nan\n");
  const auto text = palpate("body info foot.ply");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("number      pressure of each vertex, 1.5 to 12.25\n"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("number      label of each face, 7 to 7\n"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("number      void of each face, never finite\n"), std::string::npos) << text.out;
  const auto numbers = nlohmann::json::parse(palpate("body info foot.ply --json").out)["numbers"];
  EXPECT_EQ(numbers, nlohmann::json::parse(R"([{"name":"pressure","of":"vertex","min":1.5,"max":12.25},
                                               {"name":"label","of":"face","min":7.0,"max":7.0},
                                               {"name":"void","of":"face","min":null,"max":null}])"));
}

TEST_F(MeshCommands, InfoTellsHowEvenTrianglesAreWhenAsked) {
  mesh::save(folder / "cube.obj", zoo::cube(20));
  const auto shape = nlohmann::json::parse(palpate("body info cube.obj --shape --json").out)["shape"];
  EXPECT_NEAR(shape["fold_deg"]["least"], 0, 1e-9) << "the diagonals of its sides";
  EXPECT_NEAR(shape["fold_deg"]["p50"], 90, 1e-9) << "its 12 edges are more than its 6 diagonals";
  EXPECT_NEAR(shape["smallest_angle_deg"]["least"], 45, 1e-9);
  EXPECT_NEAR(shape["smallest_angle_deg"]["most"], 45, 1e-9);
  EXPECT_NEAR(shape["aspect"]["most"], (1 + std::sqrt(2.0)) / 2, 1e-9) << "half a square: R = a / sqrt 2";
  EXPECT_NEAR(shape["area_of_mean"]["p1"], 1, 1e-9);
  EXPECT_NEAR(shape["mean_edge_mm"], 20 * (2 + std::sqrt(2.0)) / 3, 1e-9);

  mesh::TriangleMesh flat = zoo::grid(2, 20);
  flat.positions[1].y() += 5;  // of the first row: two triangles lose area, their neighbours gain none
  mesh::save(folder / "flat.obj", flat);
  const auto uneven = nlohmann::json::parse(palpate("body info flat.obj --shape --json").out)["shape"];
  EXPECT_NEAR(uneven["fold_deg"]["most"], 0, 1e-9);
  EXPECT_GT(uneven["area_deviation"], 0.1);
  EXPECT_LT(uneven["smallest_angle_deg"]["least"], 45 - 1);

  EXPECT_NE(palpate("body info cube.obj --shape").out.find("the sharpest 90"), std::string::npos);
  EXPECT_FALSE(nlohmann::json::parse(palpate("body info cube.obj --json").out).contains("shape"));
}

TEST_F(MeshCommands, InfoNamesWrongIndicesInsteadOfRefusingThem) {
  writeFile(folder / "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n");
  const auto end = palpate("body info bad.obj");
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_NE(end.out.find("1 triangle with out-of-range indices (first: 1)"), std::string::npos) << end.out;
}

TEST_F(MeshCommands, RepairWritesAFitMeshAndSaysWhatItDid) {
  mesh::save(folder / "fin.obj", zoo::cubeWithFin());
  const auto json = nlohmann::json::parse(palpate("body repair fin.obj -o fit.ply --json").out);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["actions"][0]["count"], 2);
  EXPECT_TRUE(mesh::validate(mesh::load(folder / "fit.ply")).fit());
}

TEST_F(MeshCommands, InfoDoubtsTheSizeAndNamesTheUnitThatWouldFit) {
  mesh::save(folder / "small.obj", zoo::cube(0.3));
  const auto small = palpate("body info small.obj");
  EXPECT_NE(small.out.find("warning     0.3 0.3 0.3 mm is small for a body"), std::string::npos) << small.out;
  EXPECT_NE(small.out.find("If these are metres, use --unit m"), std::string::npos) << small.out;
  const auto in_metres = nlohmann::json::parse(palpate("body info small.obj --unit m --json").out);
  EXPECT_TRUE(in_metres["warnings"].empty());
  EXPECT_NE(small.out.find("fit for contact, if that is its true size"), std::string::npos) << small.out;
  const auto by_number = nlohmann::json::parse(palpate("body info small.obj --unit 1000 --json").out);
  EXPECT_EQ(by_number["box"], in_metres["box"]);
  const auto old_name = palpate("body info small.obj --unit-mm 1000 --json");
  EXPECT_EQ(nlohmann::json::parse(old_name.out)["box"], in_metres["box"]);
  EXPECT_EQ(old_name.err, "palpate: note: --unit-mm is called --unit now; the old name will go\n");
  mesh::TriangleMesh flat = zoo::cube(300);
  for (Vec3& p : flat.positions) p.z() *= 0.001;
  mesh::save(folder / "flat.obj", flat);
  EXPECT_NE(palpate("body info flat.obj").out.find("0.3 mm is thin for a body"), std::string::npos);
  mesh::save(folder / "large.obj", zoo::cube(30000));
  EXPECT_NE(palpate("body info large.obj").out.find("is large for a body"), std::string::npos);
}

TEST_F(MeshCommands, InfoNamesVerticesAtOnePlaceAndNoTriangleTwice) {
  mesh::save(folder / "soup.obj", zoo::soup(zoo::cube()));
  const auto text = palpate("body info soup.obj");
  EXPECT_NE(text.out.find("28 vertices at the place of an earlier one"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("36 border edges, at triangles (first: 0, 1, 2, 3, 4)"), std::string::npos) << text.out;
  const auto json = nlohmann::json::parse(palpate("body info soup.obj --json").out);
  EXPECT_EQ(json["traits"]["coincident_vertices"]["count"], 28);
  EXPECT_EQ(json["closure"], "open");
}

TEST_F(MeshCommands, RepairSaysHowClosedItWasAndIs) {
  mesh::TriangleMesh torn = zoo::sphere(20, 3);
  torn.triangles.pop_back();
  mesh::save(folder / "torn.obj", torn);
  const auto info = palpate("body info torn.obj");
  EXPECT_NE(info.out.find("surface     nearly closed"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("except for small holes"), std::string::npos) << info.out;
  const auto text = palpate("body repair torn.obj -o whole.ply");
  EXPECT_NE(text.out.find("before     nearly closed; 3 border edges in 1 loop,"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("after      closed; 0 border edges"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("triangles  1279 - 0 dropped + 1 added = 1280"), std::string::npos) << text.out;
  const auto kept = nlohmann::json::parse(palpate("body repair torn.obj -o torn.ply --keep-holes --json").out);
  EXPECT_EQ(kept["after"]["closure"], "nearly closed");
  EXPECT_EQ(kept["after"]["border_edges"], 3);
}

TEST_F(MeshCommands, RepairCountsAddUpAndWhatItOpensIsAWarning) {
  mesh::save(folder / "fin.obj", zoo::cubeWithFin());
  const auto fin = nlohmann::json::parse(palpate("body repair fin.obj -o fit.ply --json").out);
  EXPECT_EQ(fin["before"]["triangles"], 16);
  EXPECT_EQ(fin["before"]["closure"], "closed");
  EXPECT_GT(fin["before"]["non_manifold_edges"], 0);
  EXPECT_EQ(fin["triangles_dropped"], 4);
  EXPECT_EQ(fin["after"]["triangles"], 12);
  EXPECT_EQ(fin["actions"][0]["triangles"], -4);
  EXPECT_TRUE(fin["warnings"].empty());
  mesh::save(folder / "sheet.obj", zoo::doubleSidedGrid(4));
  EXPECT_NE(palpate("body repair sheet.obj -o sheet.ply").out.find("warning    the surface was closed and is open now"),
            std::string::npos);
}

TEST_F(MeshCommands, BadInputIsOneLineAndExitCodeTwo) {
  writeFile(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  writeFile(folder / "bad.obj", "v 0 0 zero\n");
  for (const auto& [arguments, message] :
       {std::pair("body info gone.stl", "palpate: gone.stl: no such file\n"),
        std::pair("body info bad.obj", "palpate: bad.obj:1: a coordinate is not a number: 'zero'\n"),
        std::pair("body repair flat.obj -o fit.obj", "palpate: flat.obj: the mesh has no usable triangles\n")}) {
    const auto end = palpate(arguments);
    EXPECT_EQ(end.exit_code, 2) << arguments;
    EXPECT_EQ(end.err, message);
    EXPECT_EQ(end.out, "");
  }
}

}  // namespace
}  // namespace palpate
