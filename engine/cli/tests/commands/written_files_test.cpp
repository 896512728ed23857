// Bodies as other programs write them (tests/data/mesh/written): what `palpate body info` says of each, and a press.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/base/text.h"
#include "palpate/trace/forces_table.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

const std::filesystem::path kWritten = support::testData() / "mesh/written";

struct WrittenFile {
  const char* name;
  const char* told;  ///< what the only warning ends in; empty: there is none
  const char* options = "";
};

constexpr WrittenFile kCubes[] = {
    {"obj_two_corner.obj", "a face with fewer than 3 corners is skipped"},
    {"obj_cont_glued.obj", ""},
    {"obj_cont_vertex_glued.obj", ""},
    {"obj_o_g.obj", "", " --group body"},
    {"obj_g_o.obj", "", " --group body"},
    {"obj_bom.obj", ""},
    {"obj_bom_v.obj", ""},
    {"off_glued.off", ""},
    {"ply_extra_col.ply", "the row has more values than the header declares; they are skipped (6 times)"},
    {"ply_extra_col_v.ply", "the row has more values than the header declares; they are skipped (8 times)"},
    {"stl_tail.stl", "92 bytes after the 12 triangles are skipped"},
    {"stl_solid_tail.stl", "92 bytes after the 12 triangles are skipped"},
    {"stl_upper.stl", ""},
    {"stl_title.stl", ""}};

class WrittenFiles : public testing::Test {
 protected:
  nlohmann::json readBodyInfo(const std::string& name, const std::string& options = "") const {
    const auto result = support::runPalpate("body info --json " + (kWritten / name).string() + options, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    return result.exit_code == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
  }

  /// The greatest force of a press along the rows of a trajectory.
  double greatestForce(const std::string& name, const std::filesystem::path& trajectory) const {
    const auto result = support::runPalpate("simulate --no-pictures --no-plot --mesh " + (kWritten / name).string() +
                                                " --trajectory " + trajectory.string() + " --overwrite -o out",
                                            folder_.path());
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    double greatest = 0.0;
    trace::forEachForcesRow(folder_ / "out/forces.csv",
                            [&](const trace::ForcesRow& row) { greatest = std::max(greatest, row.force.norm()); });
    return greatest;
  }

  std::filesystem::path trajectory(const std::string& rows) const {
    writeFile(folder_ / "path.csv", "t_s,x_mm,y_mm,z_mm\n" + rows);
    return folder_ / "path.csv";
  }

  support::TemporaryFolder folder_;
};

TEST_F(WrittenFiles, AreTheCubeThatTheySay) {
  for (const auto& [name, told, options] : kCubes) {
    const nlohmann::json info = readBodyInfo(name, options);
    EXPECT_EQ(info["triangles"], 12) << name;
    EXPECT_TRUE(info["closed"]) << name;
    EXPECT_NEAR(info["volume_mm3"].get<double>(), 1e6, 1e-3) << name;
    const std::vector<std::string> warnings = info["warnings"];
    ASSERT_EQ(warnings.size(), *told == '\0' ? 0u : 1u) << name;
    if (*told != '\0') {
      EXPECT_TRUE(warnings[0].ends_with(told)) << warnings[0];
    }
  }
}

TEST_F(WrittenFiles, AreFeltAlike) {
  const auto press = trajectory("0,50,50,120\n0.2,50,50,97\n");
  const double force = greatestForce("obj_bom.obj", press);
  EXPECT_GT(force, 0.1);
  for (const WrittenFile& file : kCubes) EXPECT_NEAR(greatestForce(file.name, press), force, 1e-9) << file.name;
}

TEST_F(WrittenFiles, APolygonOf65CornersIsNotFeltInItsHollow) {
  const nlohmann::json info = readBodyInfo("kidney65.obj");
  EXPECT_TRUE(info["closed"]);
  EXPECT_EQ(info["triangles"], 2 * 63 + 2 * 65);
  EXPECT_EQ(info["traits"]["self_intersections"]["count"], 0);
  EXPECT_EQ(greatestForce("kidney65.obj", trajectory("0,0,25,90\n0.5,0,25,30\n")), 0.0);
}

TEST_F(WrittenFiles, ATrajectoryWithLinesThatEndInCrIsFollowed) {
  EXPECT_GT(greatestForce("obj_bom.obj", trajectory("0,50,50,120\n0.2,50,50,97\n")), 0.1);
  EXPECT_EQ(greatestForce("obj_bom.obj", kWritten / "t_cr.csv"),
            greatestForce("obj_bom.obj", trajectory("0,0,0,75\n0.5,0,0,55\n1,10,0,55\n")));
}

}  // namespace
}  // namespace palpate
