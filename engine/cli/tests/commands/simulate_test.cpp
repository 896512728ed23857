// `palpate simulate` from the outside: what it prints, writes and refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "pictures/read_png.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

class Simulate : public ::testing::Test {
 protected:
  void SetUp() override {
    writeDome(folder_ / "dome.obj");
    write("path.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,30\n0.5,0,0,15\n1.0,20,0,14\n1.2,20,0,30\n");
  }

  /// A dome 200 mm wide and 20 mm high.
  static void writeDome(const std::filesystem::path& file) {
    mesh::save(file, zoo::dome({-100.0, -100.0}, 10.0, 20.0));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  /// Without pictures: they take longer than all the rest.
  CommandResult simulate(const std::string& arguments) const {
    return runPalpate("simulate --no-pictures " + arguments, folder_.path());
  }
  nlohmann::json report(const std::string& out = "results") const {
    return nlohmann::json::parse(contentOf(folder_ / (out + "/report.json")));
  }
  /// The error of a run that must end with exit code 2 and exactly one line.
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = simulate(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    EXPECT_EQ(result.out, "") << arguments;
    // A slow machine says how far it is before it gets there.
    const std::string error = result.err.substr(std::min(result.err.size(), result.err.find("palpate:")));
    EXPECT_TRUE(!error.empty() && error.find('\n') == error.size() - 1) << "one line: " << result.err;
    return error;
  }

  support::TemporaryFolder folder_;
};

TEST_F(Simulate, PalpatesAMeshAlongATrajectory) {
  if (!support::hasProgramOf("recording plot")) GTEST_SKIP() << "not built";
  const CommandResult result = simulate("--mesh dome.obj --trajectory path.csv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("dome.obj"), std::string::npos);
  EXPECT_NE(result.out.find("results in results: forces.csv surface_deepest.ply forces.png report.json"),
            std::string::npos);
  const auto finger = report()["fingers"][0];
  EXPECT_NEAR(finger["depth_mm"]["peak"], 5.6, 0.2);
  EXPECT_NEAR(finger["force_n"]["peak"], 0.5 * double(finger["depth_mm"]["peak"]), 0.3);
  EXPECT_GT(finger["triangles_touched"], 2);
  const std::string forces = contentOf(folder_ / "results/forces.csv");
  EXPECT_EQ(std::count(forces.begin(), forces.end(), '\n'), 1 + 1201);
}

TEST_F(Simulate, LeavesPicturesOfWhatItDid) {
  if (!support::hasProgramOf("recording plot")) GTEST_SKIP() << "not built";
  const CommandResult result = runPalpate("simulate --mesh dome.obj --trajectory path.csv", folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("results in results: forces.csv surface_deepest.ply forces.png pictures.png report.json"),
            std::string::npos);
  const view::Image sheet = support::readPng(folder_ / "results/pictures.png");
  EXPECT_EQ(sheet.width, 3 * 480);
  EXPECT_EQ(sheet.height, 2 * 360);
  EXPECT_GT(report()["pictures_s"], 0.0);
}

TEST_F(Simulate, LeavesAPlotOfWhatWasFeltUnlessToldNotTo) {
  if (!support::hasProgramOf("recording plot")) GTEST_SKIP() << "not built";
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory path.csv").exit_code, 0);
  const view::Image plot = support::readPng(folder_ / "results/forces.png");
  EXPECT_GT(plot.width, 1000);
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory path.csv --no-plot --out bare").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bare/forces.png"));
}

TEST_F(Simulate, GoesOnWherePicturesCannotBeDrawn) {
  const CommandResult result = support::runProgram(
      "/usr/bin/env",
      "MESA_GL_VERSION_OVERRIDE=2.1 " + support::builtProgram() + " simulate --mesh dome.obj --trajectory path.csv",
      folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("pictures.png was not written: cannot draw: needs OpenGL 3.3, found "), std::string::npos)
      << result.out;
}

TEST_F(Simulate, FindsItsOwnWayOverAnyMeshAndSavesIt) {
  const CommandResult result = simulate("--mesh dome.obj --out own");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(report("own")["fingers"][0]["touching_share"], 0.8);
  // The saved path can be used again and gives the same contact to the nanometre it is written with.
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory own/trajectory_automatic.csv --out again").exit_code, 0);
  EXPECT_NEAR(report("again")["fingers"][0]["force_n"]["peak"], report("own")["fingers"][0]["force_n"]["peak"], 1e-4);
}

/// What Latin 1 calls an e with an accent is of no letter of UTF-8.
TEST_F(Simulate, NamesOfFilesMayBeAnyBytes) {
  std::filesystem::copy_file(folder_ / "dome.obj", folder_ / "d\xf4me.obj");
  const CommandResult mesh = simulate("--mesh 'd\xf4me.obj' --trajectory path.csv --session --json");
  ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
  EXPECT_EQ(report()["body"]["name"], "d\xef\xbf\xbdme.obj");
  EXPECT_EQ(nlohmann::json::parse(mesh.out), report());
  write("sz\xe9ne.toml",
        "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[[finger]]\nname = \"a\"\nat_mm = [0, 0]\n"
        "script = [{ do = \"press\", depth_mm = 4, seconds = 0.1 }]\n");
  const CommandResult scene = simulate("'sz\xe9ne.toml' --out scene");
  ASSERT_EQ(scene.exit_code, 0) << scene.err;
  EXPECT_GT(report("scene")["ticks"], 0);
}

TEST_F(Simulate, AMeshWhereASceneMayStandIsPalpatedAsItIs) {
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory path.csv --out named").exit_code, 0);
  ASSERT_EQ(simulate("dome.obj --trajectory path.csv --out alone").exit_code, 0);
  EXPECT_EQ(report("alone")["hash"], report("named")["hash"]);
  const CommandResult both = simulate("dome.obj --mesh dome.obj");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.err, "palpate: dome.obj and --mesh dome.obj: only one body can be given\n");
}

TEST_F(Simulate, TouchesThroughTheDetectingBoxAsThroughTheWholeSkin) {
  const std::string finger = "[[finger]]\nname = \"a\"\ntrajectory = \"path.csv\"\n";
  const std::string body = "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n";
  write("whole.toml", body + finger);
  write("hdb.toml", body + "[contact]\nsource = \"hdb\"\n[partition]\ntree = \"bsp\"\nthreshold = 50\n" + finger);
  ASSERT_EQ(simulate("whole.toml --out whole").exit_code, 0);
  ASSERT_EQ(simulate("hdb.toml --out hdb").exit_code, 0);
  ASSERT_EQ(simulate("hdb.toml --out hdb_again").exit_code, 0);
  ASSERT_EQ(simulate("hdb.toml --out hdb_paced --realtime").exit_code, 0);
  EXPECT_NE(report("hdb")["notes"].dump().find("touched through a detecting box of 50 mm: BSP tree of"),
            std::string::npos);
  EXPECT_EQ(report("hdb")["hash"], report("hdb_again")["hash"]);
  for (const char* out : {"hdb", "hdb_paced"}) {
    EXPECT_NEAR(report(out)["fingers"][0]["force_n"]["peak"], report("whole")["fingers"][0]["force_n"]["peak"], 0.02);
  }
}

TEST_F(Simulate, RunsTheDissertationsContactAndRefusesItASphere) {
  const std::string scene = support::sourceFolder().string() + "/examples/scenes/dissertation_contact.toml";
  ASSERT_EQ(simulate(scene).exit_code, 0);
  EXPECT_GT(report()["fingers"][0]["touching_share"], 0.7);
  EXPECT_EQ(
      runForError(scene + " --radius-mm 8"),
      "palpate: contact source \"hdb\" supports point fingers only: finger 'index' must have radius_mm = 0, not 8\n");
}

TEST_F(Simulate, AStiffeningSkinGivesWayToAPressThatIsNotDeep) {
  const std::string rest =
      "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[[finger]]\nname = \"a\"\ntrajectory = \"path.csv\"\n";
  write("linear.toml", rest);
  write("stiffening.toml", "[tissue]\nforce_law = \"stiffening\"\n" + rest);
  write("table.toml", "[tissue]\nforce_law = \"table\"\nforce_table = \"law.csv\"\n" + rest);
  write("law.csv", "depth_mm,force_n\n3,1\n2,4\n");
  ASSERT_EQ(simulate("linear.toml --out linear").exit_code, 0);
  ASSERT_EQ(simulate("stiffening.toml --out stiffening").exit_code, 0);
  const auto peak = [&](const std::string& out) { return double(report(out)["fingers"][0]["force_n"]["peak"]); };
  EXPECT_LT(peak("stiffening"), 0.9 * peak("linear")) << "they agree at 8 mm";
  EXPECT_GT(peak("stiffening"), 0.5 * peak("linear"));
  EXPECT_NE(runForError("table.toml").find("law.csv:3: depth_mm must increase, but 2 follows 3"), std::string::npos);
}

TEST_F(Simulate, WritesSurfacesWithDisplacementAndStrain) {
  write("s.toml",
        "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[output]\nsurfaces_at_s = [0, 1.0, 9]\nforces = false\n"
        "[[finger]]\nname = \"a\"\ntrajectory = \"path.csv\"\n");
  ASSERT_EQ(simulate("s.toml").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results/forces.csv"));
  EXPECT_NE(
      std::string(report()["notes"].dump()).find("surface_9.000s.ply was not written: the run ended before its time"),
      std::string::npos);
  const std::string ply = contentOf(folder_ / "results/surface_1.000s.ply");
  for (const char* property : {"displacement_mm", "strain", "stiffness_n_per_mm", "red"}) {
    EXPECT_NE(ply.substr(0, 1000).find(property), std::string::npos) << property;
  }
  const auto rest = mesh::load(folder_ / "results/surface_0.000s.ply");
  const auto pressed = mesh::load(folder_ / "results/surface_1.000s.ply");
  double lowest = 0.0;
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    lowest = std::min(lowest, pressed.positions[v].z() - rest.positions[v].z());
  }
  EXPECT_LT(lowest, -3.0) << "the skin gives way under the finger";
}

// The same press in several forms: the forces are the same, the skin is not.
TEST_F(Simulate, DeformsInTheFormsOfTheScene) {
  const auto surface_with = [&](const std::string& lines) {
    write("s.toml", lines + "\n[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[output]\nsurfaces_at_s = [1.0]\n" +
                        "[[finger]]\nname = \"a\"\ntrajectory = \"path.csv\"\n");
    std::filesystem::remove_all(folder_ / "results");  // a folder that holds a run is left alone
    const CommandResult result = simulate("s.toml");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return contentOf(folder_ / "results/surface_1.000s.ply");
  };
  write("mine.csv", "q,value\n0,1\n0.3,0.8\n1,0\n");
  std::set<std::string> surfaces{surface_with("")};
  surfaces.insert(surface_with("[deformation]\nprofile = \"sharp\""));
  surfaces.insert(surface_with("[deformation]\nprofile = \"user\"\nprofile_file = \"mine.csv\""));
  surfaces.insert(surface_with("[deformation]\nregion = \"shared\""));
  surfaces.insert(surface_with("[strain]\nkind = \"principal\""));
  surfaces.insert(surface_with("fidelity.E18 = \"literal\""));
  surfaces.insert(surface_with("fidelity = \"literal\""));
  EXPECT_EQ(surfaces.size(), 7u);
}

TEST_F(Simulate, MixesNoTwoRuns) {
  const std::string run = "--mesh dome.obj --trajectory path.csv";
  ASSERT_EQ(simulate(run).exit_code, 0);
  ASSERT_EQ(simulate(run).exit_code, 0) << "without --out a second run gets a name of its own";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "results-2/report.json"));
  const std::string error = runForError(run + " --out results");
  EXPECT_NE(error.find("results: contains another run ("), std::string::npos) << error;
  EXPECT_NE(error.find("replace it with --overwrite, or use --out results-3"), std::string::npos) << error;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "results/surface_deepest.ply"));
  write("air.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,300\n0.1,0,0,290\n");
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory air.csv --out results --overwrite").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results/surface_deepest.ply")) << "of the run that was replaced";
}

TEST_F(Simulate, NamesTheLineOfAFaultyProfile) {
  write("mine.csv", "q,value\n0,1\n0.3,0.8\n0.2,0.7\n1,0\n");
  write("s.toml",
        "[deformation]\nprofile = \"user\"\nprofile_file = \"mine.csv\"\n"
        "[[finger]]\nname = \"a\"\ntrajectory = \"path.csv\"\n");
  EXPECT_NE(runForError("s.toml").find("mine.csv:4: q must ascend: 0.2 after 0.3"), std::string::npos);
}

TEST_F(Simulate, GivesTheSameForcesTwice) {
  ASSERT_EQ(simulate("--mesh dome.obj --out one").exit_code, 0);
  ASSERT_EQ(simulate("--mesh dome.obj --out two").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "one/forces.csv"), contentOf(folder_ / "two/forces.csv"));
  EXPECT_EQ(report("one")["hash"], report("two")["hash"]);
}

TEST_F(Simulate, RunsTheDefaultSceneFromAnyFolder) {
  const CommandResult result = simulate("--json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json, report());
  EXPECT_EQ(json["ticks"], 10000);
  EXPECT_EQ(json["body"]["bones"], 74);
  EXPECT_GT(json["bone_cover"]["least_mm"], 1.0);
  EXPECT_LT(json["bone_cover"]["least_mm"], 8.0);
  EXPECT_EQ(json["bone_cover"]["bone"], "T6") << "a spinous process, under the index";
  ASSERT_EQ(json["fingers"].size(), 2u);
  for (const auto& finger : json["fingers"]) {
    EXPECT_GT(finger["touching_share"], 0.8);
    EXPECT_GT(finger["stick_share"], 0.1);
    EXPECT_GT(finger["slip_share"], 0.1);
  }
}

TEST_F(Simulate, RunsInRealTimeBesideTheDeformation) {
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory path.csv --realtime").exit_code, 0);
  const auto json = report();
  EXPECT_EQ(json["mode"], "realtime");
  EXPECT_GE(json["wall_s"], 1.2);
  EXPECT_EQ(int(json["ticks"]) + int(json["overruns"]), 1201);
  EXPECT_GT(json["realtime"]["display"]["frames"], 20);
  EXPECT_GE(json["realtime"]["lateness_us"]["max"], json["realtime"]["lateness_us"]["p50"]);
  EXPECT_NEAR(json["fingers"][0]["depth_mm"]["peak"], 5.6, 0.5);
}

TEST_F(Simulate, SaysInWordsWhereEachFingerPressedDeepest) {
  write("torso.toml",
        "[body]\nkind = \"torso\"\ntriangles = 8163\n\n[[finger]]\nname = \"index\"\nat = \"T6 right 20 mm\"\n"
        "script = [{ do = \"press\", depth_mm = 5, seconds = 0.2 }]\n");
  const CommandResult result = simulate("torso.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string where = report()["fingers"][0]["where"];
  EXPECT_EQ(where.substr(0, 7), "T6, 20 ") << where;
  EXPECT_NE(result.out.find("index pressed deepest at " + where), std::string::npos) << result.out;
  ASSERT_EQ(simulate("--mesh dome.obj --trajectory path.csv").exit_code, 0);
  EXPECT_FALSE(report("results-2")["fingers"][0].contains("where")) << "a mesh has no names";
}

TEST_F(Simulate, RunsAsLongAsItIsTold) {
  ASSERT_EQ(simulate("--mesh dome.obj --seconds 0.25").exit_code, 0);
  EXPECT_EQ(report()["ticks"], 250);
}

TEST_F(Simulate, SaysWhenNothingWasTouched) {
  write("away.csv", "0,500,500,500\n0.1,500,500,501\n");
  const CommandResult result = simulate("--mesh dome.obj --trajectory away.csv");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("no finger touched the body, which extends from (-100.0, -100.0,"), std::string::npos);
}

TEST_F(Simulate, RefusesWrongInputInOneLineWithExitCodeTwo) {
  EXPECT_EQ(runForError("nowhere.toml"), "palpate: nowhere.toml: no such file\n");
  EXPECT_EQ(runForError("--mesh nowhere.obj"), "palpate: nowhere.obj: no such file\n");
  EXPECT_EQ(runForError("--mesh dome.obj --trajectory nowhere.csv"), "palpate: nowhere.csv: no such file\n");
  write("bad.csv", "t_s,x_mm,y_mm,z_mm\n0,1,2,3\n0.1,1,two,3\n");
  EXPECT_EQ(runForError("--mesh dome.obj --trajectory bad.csv"), "palpate: bad.csv:3: y_mm is not a number: 'two'\n");
  write("nan.csv", "0,1,2,nan\n");
  EXPECT_EQ(runForError("--mesh dome.obj --trajectory nan.csv"), "palpate: nan.csv:1: z_mm must be finite, got nan\n");
  write("empty.csv", "");
  EXPECT_EQ(runForError("--mesh dome.obj --trajectory empty.csv"), "palpate: empty.csv: the trajectory has no rows\n");
  write("bad.toml", "[friction]\nstatik = 1\n");
  EXPECT_EQ(runForError("bad.toml"),
            "palpate: bad.toml:2: unknown key 'statik' in [friction]; did you mean 'static'?\n");
  write("garbage.toml", std::string("\0\1\2\xff", 4));
  EXPECT_NE(runForError("garbage.toml").find("palpate: garbage.toml:1: "), std::string::npos);
  write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  EXPECT_NE(runForError("--mesh line.obj").find("palpate: line.obj: "), std::string::npos);
  EXPECT_NE(runForError("--mesh path.csv").find("palpate: path.csv: "), std::string::npos);
  write("file", "");
  EXPECT_EQ(runForError("--mesh dome.obj --out file"),
            "palpate: file: cannot be created as a results folder: Not a directory\n");
  EXPECT_EQ(runForError("--mesh dome.obj --unit furlong"),
            "palpate: --unit: 'furlong' is not a unit; expected one of auto, mm, cm, dm, m, in, or a number of "
            "millimetres (see --help)\n");
}

TEST_F(Simulate, RefusesUnknownOptionsWithExitCodeTwo) {
  EXPECT_EQ(simulate("--speed 3").exit_code, 2);
  EXPECT_EQ(simulate("--seconds -1").exit_code, 2);
  EXPECT_EQ(simulate("--help").exit_code, 0);
}

TEST_F(Simulate, PrintsTheKeysOfSceneFiles) {
  const CommandResult result = simulate("--keys");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("| `radius_mm` |"), std::string::npos);
}

}  // namespace
}  // namespace palpate
