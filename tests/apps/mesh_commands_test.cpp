// `palpate info` and `palpate repair` as a user calls them.
#include <gtest/gtest.h>

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
  const auto text = palpate("info fin.obj");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("2 triangles doubled from the other side"), std::string::npos) << text.out;
  const auto json = nlohmann::json::parse(palpate("info fin.obj --json").out);
  EXPECT_EQ(json["triangles"], 16);
  EXPECT_EQ(json["fit"], false);
  EXPECT_EQ(json["traits"]["opposite_triangles"]["first"], (std::vector<int>{13, 15}));
}

TEST_F(MeshCommands, InfoNamesWrongIndicesInsteadOfRefusingThem) {
  writeFile(folder / "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n");
  const auto end = palpate("info bad.obj");
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_NE(end.out.find("1 triangle with out-of-range indices (first: 1)"), std::string::npos) << end.out;
}

TEST_F(MeshCommands, RepairWritesAFitMeshAndSaysWhatItDid) {
  mesh::save(folder / "fin.obj", zoo::cubeWithFin());
  const auto json = nlohmann::json::parse(palpate("repair fin.obj -o fit.ply --json").out);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["actions"][0]["count"], 2);
  EXPECT_TRUE(mesh::validate(mesh::load(folder / "fit.ply")).fit());
}

TEST_F(MeshCommands, BadInputIsOneLineAndExitCodeTwo) {
  writeFile(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  writeFile(folder / "bad.obj", "v 0 0 zero\n");
  for (const auto& [arguments, message] :
       {std::pair("info gone.stl", "palpate: gone.stl: no such file\n"),
        std::pair("info bad.obj", "palpate: bad.obj:1: a coordinate is not a number: 'zero'\n"),
        std::pair("repair flat.obj -o fit.obj", "palpate: flat.obj: the mesh has no triangle that can be felt\n")}) {
    const auto end = palpate(arguments);
    EXPECT_EQ(end.exit_code, 2) << arguments;
    EXPECT_EQ(end.err, message);
    EXPECT_EQ(end.out, "");
  }
}

}  // namespace
}  // namespace palpate
