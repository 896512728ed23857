// `palpate study hunt` as a user calls it: its numbers, its cases, its exit codes and its errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

class HuntCommand : public testing::Test {
 protected:
  support::CommandResult palpate(const std::string& arguments) const {
    return support::runPalpate(arguments, folder.path());
  }

  support::TemporaryFolder folder;
};

TEST_F(HuntCommand, CountsWhatItFindsAndSaysSoByItsExitCode) {
  const auto end = palpate("study hunt --ticks 20000 --bodies 3 --seed 4 --json");
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json["ticks"], 20000);
  EXPECT_EQ(json["bodies"], 3);
  for (const char* key : {"falls", "missed_contacts", "wrong_forces", "steps_over_bound", "held_in_air",
                          "held_in_air_open", "open_ticks", "held_through_body", "events"})
    EXPECT_TRUE(json[key].is_number_unsigned()) << key;
  EXPECT_EQ(end.exit_code, json["failing_paths"].empty() ? 0 : 1);
  for (const auto& path : json["failing_paths"]) {
    for (const char* key : {"body", "seed", "radius_mm", "tick", "kind", "file"})
      EXPECT_TRUE(path.contains(key)) << key;
  }
  EXPECT_EQ(json["radii_mm"], nlohmann::json({0.0, 0.5, 2.0, 5.0, 8.0}));
}

TEST_F(HuntCommand, IsRepeatableWithAnyNumberOfThreads) {
  const auto found = [&](const std::string& arguments) {
    auto json = nlohmann::json::parse(palpate("study hunt --ticks 20000 --bodies 3 --json " + arguments).out);
    json.erase("seconds");
    json.erase("ticks_per_s");
    return json;
  };
  EXPECT_EQ(found("--seed 4 --threads 1"), found("--seed 4 --threads 3"));
  EXPECT_NE(found("--seed 4"), found("--seed 5"));
}

TEST_F(HuntCommand, SaysWhatOfAMeshIsLeftOut) {
  mesh::save(folder / "cube.obj", zoo::cube());
  std::ofstream(folder / "cube.obj", std::ios::app) << "l 1 2\n";
  const auto end = palpate("study hunt --mesh cube.obj --fit-mm 100 --ticks 1000 --radius-mm 2");
  EXPECT_NE(end.err.find("palpate: cube.obj: left out: lines (1)\n"), std::string::npos) << end.err;
}

TEST_F(HuntCommand, TakesMeshesAloneOrBesideTheGenerated) {
  mesh::save(folder / "cube.obj", zoo::cube());
  const std::string start = "study hunt --mesh cube.obj --fit-mm 100 --ticks 4000 --radius-mm 2 --json";
  const auto alone = nlohmann::json::parse(palpate(start).out);
  EXPECT_EQ(alone["bodies"], 1);
  EXPECT_EQ(alone["ticks"], 4000);
  EXPECT_EQ(nlohmann::json::parse(palpate(start + " --generated --bodies 2").out)["bodies"], 3);
  EXPECT_EQ(nlohmann::json::parse(palpate(start + " --scale 0.001").out)["scale"], 0.001);
  const auto fitted = palpate("study hunt --mesh cube.obj --ticks 2000");
  EXPECT_NE(fitted.err.find("cube.obj: 17.3 mm across"), std::string::npos) << fitted.err;
}

TEST_F(HuntCommand, TakesBodiesOfOneKindAndCountsTicksOnThoseWithABorder) {
  const auto open = nlohmann::json::parse(palpate("study hunt --kind open_sheet --ticks 4000 --bodies 2 --json").out);
  EXPECT_EQ(open["open_ticks"], 4000);
  const auto closed = nlohmann::json::parse(palpate("study hunt --kind torus --ticks 4000 --bodies 1 --json").out);
  EXPECT_EQ(closed["open_ticks"], 0);
  const auto wrong = palpate("study hunt --kind nose --ticks 4000");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("unknown kind of body 'nose'"), std::string::npos) << wrong.err;
}

TEST_F(HuntCommand, EndsByTheClockToo) {
  const auto json = nlohmann::json::parse(palpate("study hunt --seconds 0.5 --json").out);
  EXPECT_GT(json["ticks"], 0);
  EXPECT_LT(json["seconds"], 30.0);
}

TEST_F(HuntCommand, WritesCasesThatSimulateRunsAndItselfReplays) {
  const auto end = palpate("study hunt --ticks 100000 --bodies 6 --seed 1 --out found --keep 1 --json");
  const auto json = nlohmann::json::parse(end.out);
  for (const auto& path : json["failing_paths"]) {
    if (path["file"].is_null()) continue;
    const std::string file = path["file"];
    for (const char* name : {"body.ply", "path.csv", "scene.toml", "note.txt"})
      EXPECT_TRUE(std::filesystem::exists(folder / file / name)) << name;
    const auto simulated = palpate("simulate " + file + "/scene.toml --overwrite --out simulated");
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    const auto replayed = palpate("study hunt --replay " + file);
    EXPECT_EQ(replayed.exit_code, 1) << replayed.out;
    EXPECT_NE(replayed.out.find(path["kind"]), std::string::npos) << replayed.out;
  }
}

TEST_F(HuntCommand, ReplaysScenesOfOthers) {
  mesh::save(folder / "cube.obj", zoo::cube(100.0));
  writeFile(folder / "path.csv", "0.000,50,50,101\n0.001,50,50,100.2\n0.002,50,50,99.5\n");
  writeFile(folder / "scene.toml",
            "[body]\nkind = \"mesh\"\nfile = \"cube.obj\"\n[[finger]]\nname = \"f\"\ntrajectory = \"path.csv\"\n");
  const auto end = palpate("study hunt --replay .");
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_NE(end.out.find("3 ticks on cube.obj, radius 0 mm: nothing wrong"), std::string::npos) << end.out;
}

TEST_F(HuntCommand, SaysWhatOfTheMeshOfAReplayedCaseIsLeftOut) {
  mesh::save(folder / "cube.obj", zoo::cube(100.0));
  std::ofstream(folder / "cube.obj", std::ios::app) << "l 1 2\n";
  writeFile(folder / "path.csv", "0.000,50,50,101\n0.001,50,50,100.2\n");
  writeFile(folder / "scene.toml",
            "[body]\nkind = \"mesh\"\nfile = \"cube.obj\"\n[[finger]]\nname = \"f\"\ntrajectory = \"path.csv\"\n");
  const auto end = palpate("study hunt --replay .");
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_NE(end.err.find("cube.obj: left out: lines (1)\n"), std::string::npos) << end.err;

  std::filesystem::create_directories(folder / "kept");
  std::filesystem::copy_file(folder / "path.csv", folder / "kept/path.csv");
  writeFile(folder / "kept/note.txt",
            "body: cube\nseed: 1\nradius_mm: 0\nscale: 1\nfault: fall\ntick: 1\nmeasured: 1\nbound: 1\nseen: a\n");
  mesh::save(folder / "kept/body.ply", zoo::cube(100.0));
  std::ofstream(folder / "kept/body.ply", std::ios::app) << "more\n";
  const auto kept = palpate("study hunt --replay kept");
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_NE(kept.err.find("bytes after the last row declared by the header"), std::string::npos) << kept.err;
}

TEST_F(HuntCommand, WrongUsageIsOneLineAndExitCodeTwo) {
  writeFile(folder / "flat.obj", "v 0 0 0\nv 100 0 0\nv 200 0 0\nf 1 2 3\n");
  writeFile(folder / "torn.ply", "ply\nformat ascii 1.0\nelement vertex\n");
  for (const auto& [arguments, message] :
       {std::pair("--mesh gone.stl", "gone.stl: no such file"), std::pair("--mesh torn.ply", "torn.ply"),
        std::pair("--mesh flat.obj", "flat.obj: the mesh has no usable triangles"), std::pair("--ticks 0", "--ticks"),
        std::pair("--radius-mm -1", "--radius-mm"), std::pair("--scale 0", "--scale"),
        std::pair("--ticks 5 --seconds 5", "--seconds"), std::pair("--replay gone", "gone/note.txt")}) {
    const auto end = palpate(std::string("study hunt ") + arguments);
    EXPECT_EQ(end.exit_code, 2) << arguments;
    EXPECT_NE(end.err.find(message), std::string::npos) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_EQ(end.out, "");
  }
}

}  // namespace
}  // namespace palpate
