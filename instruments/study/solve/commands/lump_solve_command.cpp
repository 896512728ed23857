// `palpate lump solve`: solves the lumps of a scene with `lumps = "solved"` and keeps what comes out, so that programs
// without a solver can build it.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "cli/kit/json.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/solved_lumps.h"
#include "palpate/scene/world.h"
#include "solve/commands/commands.h"

namespace palpate::app {

namespace {

struct LumpSolveArguments {
  std::string scene;
  bool json = false;
};

/// A lump, solved and by its table alone.
struct SolvedLump {
  const scene::PlacedLump& placed;
  tissue::LumpEnergy table;  ///< as it would be without a solve
  std::vector<scene::SolvedPush> pushes;
};

Json solvedJson(const SolvedLump& lump) {
  Json json = {{"name", lump.placed.name},
               {"thickness_mm", lump.placed.thickness_mm},
               {"young_kpa", lump.placed.young_kpa},
               {"presses", Json::array()}};
  for (const scene::SolvedPush& push : lump.pushes) {
    json["presses"].push_back({{"depth_mm", push.depth_mm},
                               {"solved_n", push.extra_n},
                               {"table_n", lump.table.forceAt(0.0, push.depth_mm)},
                               {"used_n", lump.placed.unscaled.forceAt(0.0, push.depth_mm)}});
  }
  return json;
}

std::string solvedText(const SolvedLump& lump) {
  std::string text = fmt::format("{}\n   depth    solved     table\n", lump.placed.note);
  for (const scene::SolvedPush& push : lump.pushes) {
    text += fmt::format("{:5g} mm {:7.4f} N {:7.4f} N\n", push.depth_mm, push.extra_n,
                        lump.table.forceAt(0.0, push.depth_mm));
  }
  return text;
}

void runLumpSolve(const LumpSolveArguments& arguments) {
  scene::Scene scene = scene::load(arguments.scene);
  if (scene.lumps.empty()) throw Error::inFile(arguments.scene, "has no [[lump]] to solve; at least one is needed");
  ProgressLine progress;
  scene.tissue.lumps = scene::LumpForce::table;
  const auto by_table = scene::build(scene, progress.callback());
  scene.tissue.lumps = scene::LumpForce::solved;
  const Progress shown = progress.callback();
  report(shown, "solving lumps", 0.0);
  const auto solved = scene::rebuilt(*by_table, scene, shown);
  progress.clear();
  const scene::LumpGround ground(solved->scene, *solved->healthy, solved->tissue.model == scene::TissueModel::layered,
                                 "lumps");
  Json json = {{"lumps", Json::array()}};
  std::string text;
  for (std::size_t i = 0; i < solved->lumps.size(); ++i) {
    const scene::PlacedLump& placed = *solved->lumps[i];
    const auto pushes = scene::solvedPushes(placed.lump.shape, ground.stackAt(placed.thickness_mm));
    const SolvedLump lump{placed, by_table->lumps[i]->unscaled, pushes.value_or(std::vector<scene::SolvedPush>())};
    json["lumps"].push_back(solvedJson(lump));
    text += solvedText(lump);
  }
  fmt::print("{}", arguments.json ? jsonText(json) : text);
}

}  // namespace

void addLumpSolveCommand(Command& lump) {
  const auto [command, arguments] = addCommand(
      lump, "solve",
      "Solve the lumps of a scene and store the result for [tissue] lumps = \"solved\" (about 10 s per lump)",
      runLumpSolve);
  command.add_option("SCENE", arguments.scene, "Scene file (TOML) with [[lump]]")->required();
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
