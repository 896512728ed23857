// `palpate body repair MESH -o OUT`: makes a mesh fit to be felt and reports the changes. Recovers the readable part of
// a recording file (salvageRecording).
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "cli/kit/choice_option.h"
#include "cli/kit/json.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/repair.h"
#include "palpate/trace/recording_repair.h"

namespace palpate::app {

namespace {

// `palpate body repair` on a recording: recovers it and reports the losses.

/// "index: 150 samples, 0.300 to 0.449 s (ticks 300 to 449)"
std::string textOf(const trace::RecordingRepair& repair, const trace::MissingTicks& missing) {
  return fmt::format("{}: {} samples, {:.3f} to {:.3f} s (ticks {} to {})", repair.fingers.at(missing.finger),
                     missing.count, static_cast<double>(missing.first) / repair.ticks_per_s,
                     static_cast<double>(missing.last) / repair.ticks_per_s, missing.first, missing.last);
}

std::string textOf(const std::filesystem::path& out, const trace::RecordingRepair& repair) {
  std::string text =
      fmt::format("{}: {} samples in {} blocks, {} events, {} worlds, {} attachments salvaged\n", out.string(),
                  repair.samples, repair.blocks, repair.events, repair.worlds, repair.attachments);
  if (repair.nothingLost()) text += "  nothing was lost\n";
  if (repair.blocks_lost > 0) {
    text += fmt::format("  lost  {} blocks, {} samples that are known by their time\n", repair.blocks_lost,
                        repair.samplesLost());
  }
  for (const trace::MissingTicks& lost : repair.lost) text += "  lost  " + textOf(repair, lost) + "\n";
  if (repair.bytes_missing > 0) text += fmt::format("  lost  {} bytes at the file's end\n", repair.bytes_missing);
  if (repair.header_lost) text += "  lost  the header: when it began, its rate (taken as 1000 a second), notes\n";
  for (const std::string& other : repair.other) text += "  lost  " + other + "\n";
  for (const std::string& note : repair.notes) text += "  note  " + note + "\n";
  for (const trace::MissingTicks& gap : repair.gaps) text += "  gap   never recorded: " + textOf(repair, gap) + "\n";
  return text;
}

Json toJson(const trace::RecordingRepair& repair, const std::vector<trace::MissingTicks>& missing) {
  Json list = Json::array();
  for (const trace::MissingTicks& one : missing) {
    list.push_back({{"finger", repair.fingers.at(one.finger)},
                    {"first_tick", one.first},
                    {"last_tick", one.last},
                    {"samples", one.count}});
  }
  return list;
}

Json toJson(const std::filesystem::path& out, const trace::RecordingRepair& repair) {
  return {{"file", out.string()},
          {"nothing_lost", repair.nothingLost()},
          {"samples", repair.samples},
          {"blocks", repair.blocks},
          {"events", repair.events},
          {"worlds", repair.worlds},
          {"attachments", repair.attachments},
          {"samples_lost", repair.samplesLost()},
          {"blocks_lost", repair.blocks_lost},
          {"lost", toJson(repair, repair.lost)},
          {"bytes_missing", repair.bytes_missing},
          {"header_lost", repair.header_lost},
          {"other_lost", repair.other},
          {"gaps", toJson(repair, repair.gaps)},
          {"notes", repair.notes}};
}

/// A recording by its first bytes, or, where those are lost, by its name: "run.session", "run.session.2.partial".
bool isOrWasRecording(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return isRecordingFile(file) || name.ends_with(".session") || name.find(".session.") != std::string::npos;
}

void salvageRecording(const std::filesystem::path& file, const std::filesystem::path& out, bool json) {
  ProgressLine progress;
  const trace::RecordingRepair repair = trace::repairRecording(file, out, progress.callback());
  progress.clear();
  printReadable(json ? jsonText(toJson(out, repair)) : textOf(out, repair));
}

struct RepairArguments {
  MeshArguments mesh;
  std::string output;
  double weld_distance_mm = 0.0;
  bool no_weld = false;
  bool keep_orientation = false;
  mesh::TurnOver turn_over = mesh::TurnOver::none;
  bool keep_holes = false;
  bool json = false;
};

/// `channels` gets the file's values for each vertex of the result.
mesh::RepairResult repairFile(const RepairArguments& arguments, mesh::VertexChannels& channels) {
  ProgressLine progress;
  mesh::LoadOptions load_options = arguments.mesh.options;
  load_options.keep_wrong_indices = true;
  mesh::MeshWithChannels loaded =
      mesh::loadWithChannels(pathOf(arguments.mesh.file), load_options, progress.callback());
  try {
    const mesh::RepairOptions options{.weld = !arguments.no_weld,
                                      .weld_distance_mm = arguments.weld_distance_mm,
                                      .orient_outwards = !arguments.keep_orientation,
                                      .turn_over = arguments.turn_over,
                                      .fill_holes = !arguments.keep_holes};
    mesh::RepairResult result = mesh::repair(std::move(loaded.mesh), options, progress.callback());
    channels = mesh::followed(loaded.channels, result.source_vertex);
    result.warnings.insert(result.warnings.begin(), loaded.notes.begin(), loaded.notes.end());
    return result;
  } catch (const Error& error) {
    throw Error::inFile(arguments.mesh.file, error.what());
  }
}

struct TriangleCount {
  std::size_t added = 0;
  std::size_t dropped = 0;
};

TriangleCount trianglesOf(const mesh::RepairResult& result) {
  TriangleCount count;
  for (const auto& action : result.actions) {
    (action.triangles > 0 ? count.added : count.dropped) += static_cast<std::size_t>(std::abs(action.triangles));
  }
  return count;
}

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string textOf(const mesh::SurfaceState& state) {
  return fmt::format("{}; {} in {}, {} of more than two triangles", mesh::wordsFor(state.closure),
                     counted(state.border_edges, "border edge"), counted(state.border_loops, "loop"),
                     counted(state.non_manifold_edges, "edge"));
}

std::string textOf(const mesh::RepairResult& result) {
  std::string text;
  for (const auto& action : result.actions) text += fmt::format("{:>9}  {}\n", action.count, action.what);
  if (result.actions.empty()) text = "nothing to repair\n";
  const TriangleCount triangles = trianglesOf(result);
  text += fmt::format("before     {}\nafter      {}\n", textOf(result.before), textOf(result.after));
  text += fmt::format("triangles  {} - {} dropped + {} added = {}\n", result.before.triangles, triangles.dropped,
                      triangles.added, result.after.triangles);
  for (const std::string& warning : result.warnings) text += "warning    " + warning + "\n";
  return text + fmt::format("{} triangles, {} vertices, {}, {}{}\n", result.mesh.triangles.size(),
                            result.mesh.positions.size(), counted(result.components, "component"),
                            mesh::wordsFor(result.after.closure),
                            result.self_intersecting ? ", intersects itself" : "");
}

Json toJson(const mesh::SurfaceState& state) {
  return {{"triangles", state.triangles},
          {"vertices", state.vertices},
          {"closure", mesh::wordsFor(state.closure)},
          {"border_edges", state.border_edges},
          {"border_loops", state.border_loops},
          {"non_manifold_edges", state.non_manifold_edges}};
}

Json toJson(const mesh::RepairResult& result) {
  Json json;
  json["triangles"] = result.mesh.triangles.size();
  json["vertices"] = result.mesh.positions.size();
  json["components"] = result.components;
  json["closed"] = result.closed;
  json["self_intersecting"] = result.self_intersecting;
  json["before"] = toJson(result.before);
  json["after"] = toJson(result.after);
  const TriangleCount triangles = trianglesOf(result);
  json["triangles_dropped"] = triangles.dropped;
  json["triangles_added"] = triangles.added;
  json["warnings"] = result.warnings;
  json["actions"] = Json::array();
  for (const auto& action : result.actions) {
    json["actions"].push_back({{"what", action.what}, {"count", action.count}, {"triangles", action.triangles}});
  }
  return json;
}

void runRepair(const RepairArguments& arguments) {
  mesh::VertexChannels channels;
  const mesh::RepairResult result = repairFile(arguments, channels);
  const bool has_room = pathOf(arguments.output).extension() == ".ply";  // other formats hold places only
  mesh::save(pathOf(arguments.output), result.mesh, has_room ? channels : mesh::VertexChannels());
  fmt::print("{}", arguments.json ? jsonDump(toJson(result), 2) + "\n" : textOf(result));
}

/// Refuses options that only apply to a mesh.
void refuseMeshOptions(const Command& command) {
  for (const Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "mesh" || name == "--out" || name == "--json" || name == "--help") continue;
    throw Error(fmt::format("repair: {} applies to meshes only, this is a recording", name));
  }
}

}  // namespace

void addRepairCommand(Command& group) {
  auto arguments = std::make_shared<RepairArguments>();
  Command& command =
      *group.add_subcommand("repair", "Repair a mesh (or recover a damaged recording) and report the changes");
  addMeshArguments(command, arguments->mesh);
  namesFileToWrite(command.add_option("-o,--out", arguments->output,
                                      "File to write: obj, stl or ply (mm), where ply keeps the vertex values and "
                                      "colours of a ply; or the recovered recording"))
      ->required();
  command.add_flag("--no-weld", arguments->no_weld, "Keep vertices at the same place separate");
  addSetting(command, "--weld-distance-mm", arguments->weld_distance_mm, between(0.0, 1e9, "mm"),
             "Also weld vertices nearer than this; 0 welds only those at the same place");
  command.add_flag("--keep-orientation", arguments->keep_orientation, "Do not flip closed parts that face inwards");
  addChoice(command, "--turn-over", arguments->turn_over,
            {{"none", mesh::TurnOver::none}, {"doubtful", mesh::TurnOver::doubtful}, {"open", mesh::TurnOver::open}},
            "Open parts to flip: doubtful, those reported as possibly inside out; open, all open parts, e.g. a sheet "
            "with its back outside");
  command.add_flag("--keep-holes", arguments->keep_holes, "Keep the small holes of nearly closed parts open");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments, &command] {
    if (isOrWasRecording(pathOf(arguments->mesh.file))) {
      refuseMeshOptions(command);
      salvageRecording(pathOf(arguments->mesh.file), pathOf(arguments->output), arguments->json);
    } else {
      runRepair(*arguments);
    }
  });
}

}  // namespace palpate::app
