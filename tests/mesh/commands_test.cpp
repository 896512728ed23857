// `palpate info` and `palpate repair` as a user calls them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/validate.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {

struct CommandEnd {
  int code = -1;
  std::string out;
  std::string err;
};

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class MeshCommands : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kCommand)) GTEST_SKIP() << "the command is not built";
  }

  CommandEnd palpate(const std::string& arguments) const {
    const std::string line = std::string("cd '") + folder.path().string() + "' && '" + kCommand + "' " + arguments +
                             " >out.txt 2>err.txt </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "out.txt"), contentOf(folder / "err.txt")};
  }

  static constexpr const char* kCommand = PALPATE_BINARY_DIR "/palpate";
  support::TemporaryFolder folder;
};

TEST_F(MeshCommands, InfoCountsTraits) {
  save(folder / "fin.obj", zoo::cubeWithFin());
  const auto text = palpate("info fin.obj");
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("2 triangles doubled from the other side"), std::string::npos) << text.out;
  const auto json = nlohmann::json::parse(palpate("info fin.obj --json").out);
  EXPECT_EQ(json["triangles"], 16);
  EXPECT_EQ(json["fit"], false);
  EXPECT_EQ(json["traits"]["opposite_triangles"]["first"], (std::vector<int>{13, 15}));
}

TEST_F(MeshCommands, InfoNamesWrongIndicesInsteadOfRefusingThem) {
  std::ofstream(folder / "bad.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n";
  const auto end = palpate("info bad.obj");
  EXPECT_EQ(end.code, 0);
  EXPECT_NE(end.out.find("1 triangle with out-of-range indices (first: 1)"), std::string::npos) << end.out;
}

TEST_F(MeshCommands, RepairWritesAFitMeshAndSaysWhatItDid) {
  save(folder / "fin.obj", zoo::cubeWithFin());
  const auto json = nlohmann::json::parse(palpate("repair fin.obj -o fit.ply --json").out);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["actions"][0]["count"], 2);
  EXPECT_TRUE(validate(load(folder / "fit.ply")).fit());
}

TEST_F(MeshCommands, BadInputIsOneLineAndExitCodeTwo) {
  std::ofstream(folder / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
  std::ofstream(folder / "bad.obj") << "v 0 0 zero\n";
  for (const auto& [arguments, message] :
       {std::pair("info gone.stl", "palpate: gone.stl: no such file\n"),
        std::pair("info bad.obj", "palpate: bad.obj:1: a coordinate is not a number: 'zero'\n"),
        std::pair("repair flat.obj -o fit.obj", "palpate: flat.obj: the mesh has no triangle that can be felt\n")}) {
    const auto end = palpate(arguments);
    EXPECT_EQ(end.code, 2) << arguments;
    EXPECT_EQ(end.err, message);
    EXPECT_EQ(end.out, "");
  }
}

}  // namespace palpate::mesh
