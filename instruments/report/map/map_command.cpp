// `palpate body map ellipses|contours|stiffness|depth`: the maps over a skin, or those of a scene, as numbers, coloured
// surface and picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/words.h"
#include "report/commands.h"
#include "report/map/map_output.h"
#include "report/map/map_sources.h"

namespace palpate::app {

namespace {

/// (5.7) or a form of (5.16); nothing is GRI.
using Weights = std::optional<maps::LiteralWeights>;

struct MapArguments {
  MapSource source;
  MapOutput output;
  MeshArguments mesh;
  std::string scene;  ///< a scene file in place of a skin and of everything a map is made from
  std::string body = "torso";
  std::size_t triangles = 0;
  std::string fidelity = scene::wordsOf({});
  std::string interpolation;
  std::string directions;
  std::vector<double> range;
  std::vector<std::string> files;
  bool json = false;
};

MapSkin makeMapSkin(const MapArguments& arguments) {
  if (!arguments.mesh.file.empty()) return skinOfFile(arguments.mesh);
  if (arguments.body == "back") return builtInBack(arguments.triangles > 0 ? arguments.triangles : 15815);
  return builtInTorso(arguments.triangles > 0 ? arguments.triangles : 20389);
}

/// The options' values as settings. CLI11 has checked them.
MapSource makeMapSource(const MapArguments& arguments) {
  MapSource source = arguments.source;
  source.fidelity = scene::parseFidelity(arguments.fidelity);
  if (const auto stiffness = choiceNamed<maps::StiffnessInterpolation>(arguments.interpolation)) {
    source.stiffness.interpolation = *stiffness;
  }
  source.interpolate_depth = !arguments.interpolation.empty();
  if (const auto weights = choiceNamed<Weights>(arguments.interpolation)) source.weights = *weights;
  source.directions = choiceNamed<maps::DirectionBlend>(arguments.directions);
  return source;
}

Json mapSummary(const MapArguments& arguments, const MapSkin& skin, const SkinMap& map) {
  const std::pair<double, double> range = shownRange(map);
  Json summary = map.summary;
  for (const std::string& note : skin.notes) summary["notes"].push_back(note);
  summary["skin"] = skin.name;
  summary["vertices"] = skin.mesh.positions.size();
  summary["quantity"] = map.shown.column;
  summary["range"] = {range.first, range.second};
  if (!arguments.interpolation.empty()) summary["interpolation"] = arguments.interpolation;
  if (arguments.scene.empty()) summary["fidelity"] = arguments.fidelity;
  summary["files"] = arguments.files;
  return summary;
}

void print(const MapArguments& arguments, const Json& summary) {
  if (arguments.json) return fmt::print("{}\n", jsonDump(summary, 2));
  fmt::print("{} over {}: {} {:.4g} to {:.4g}", summary["map"].get<std::string>(), summary["skin"].get<std::string>(),
             summary["quantity"].get<std::string>(), summary["range"][0].get<double>(),
             summary["range"][1].get<double>());
  for (const char* key : {"fit_error", "fit_error_n_per_mm"}) {
    if (summary.contains(key)) fmt::print("; {} at the key points {}", key, jsonDump(summary[key]));
  }
  fmt::print(" -> {}\n", fmt::join(arguments.files, ", "));
  for (const auto& note : summary.value("notes", Json::array())) {
    fmt::print("  note: {}\n", note.get<std::string>());
  }
}

/// Makers of a kind of map: over a bare skin, and from a scene.
struct Maker {
  SkinMap (*over_skin)(const MapSkin&, const MapSource&);
  SkinMap (*of_scene)(const MapSkin&, const scene::World&, const MapSource&);
};

std::shared_ptr<const scene::World> loadWorld(const std::string& file) {
  ProgressLine progress;
  return scene::build(scene::load(file), progress.callback());
}

void run(const MapArguments& arguments, const Maker& make) {
  for (const std::string& file : arguments.files) requireMapFile(file);
  if (!arguments.range.empty() && !(arguments.range[0] < arguments.range[1])) {
    throw Error("map: --range must be LOW,HIGH with LOW below HIGH");
  }
  const MapSource source = makeMapSource(arguments);
  const auto world = arguments.scene.empty() ? nullptr : loadWorld(arguments.scene);
  const MapSkin skin = world ? skinOfScene(*world) : makeMapSkin(arguments);
  SkinMap map = world ? make.of_scene(skin, *world, source) : make.over_skin(skin, source);
  if (!arguments.range.empty()) map.shown.range = {arguments.range[0], arguments.range[1]};
  for (const std::string& file : arguments.files) writeMap(file, skin, map, arguments.output);
  print(arguments, mapSummary(arguments, skin, map));
}

void addFileOptions(Command& command, MapArguments& a) {
  namesFileToWrite(
      command.add_option("-o,--out", a.files, "File to write by its extension, repeatable: .csv .ply .png .svg"))
      ->required()
      ->allow_extra_args(false);
  addNumber(command, "--range", a.range, between(-1e9, 1e9),
            "Range of the colours, LOW,HIGH (default: the range of the data)")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  addSetting(command, "--grid-mm", a.output.grid_mm, between(0.0, 1e6, "mm"),
             "CSV: distance between rows in the map plane; 0: one row per vertex");
  addSetting(command, "--png-scale", a.output.png_scale, between(0.2, 8.0),
             "PNG: pixels per CSS pixel; 2 suits screens and paper");
  command.add_flag("--json", a.json, "Print the summary as one JSON object, with fit errors at the key points");
}

void addSkinOptions(Command& command, MapArguments& a) {
  addMeshArguments(command, a.mesh);
  command.get_option("mesh")->required(false);
  restrictTo({"torso", "back"},
             command.add_option("--body", a.body, "Built-in skin, used without a mesh")->capture_default_str());
  addSetting(command, "--triangles", a.triangles, between(0, 2e7),
             "Triangles of the built-in skin; 0: 20389 (torso, with bones), 15815 (back)");
}

void addKeyOption(Command& command, MapArguments& a) {
  command.add_option("--keys", a.source.key_file,
                     "Table of key points (docs/reference/maps.md) (default: the dissertation's)");
}

/// Call it last: it excludes every option added before, except those in `beside`, since the scene sets them itself.
void addSceneOption(Command& command, MapArguments& a, std::vector<std::string> beside) {
  beside.insert(beside.end(), {"--help", "--out", "--range", "--grid-mm", "--png-scale", "--json"});
  const std::vector<Option*> others = command.get_options();
  Option* scene = command.add_option("--scene", a.scene,
                                     "Write the map of this scene (TOML): its body, key points and dysfunctions");
  for (Option* other : others) {
    if (std::find(beside.begin(), beside.end(), other->get_name()) == beside.end()) scene->excludes(other);
  }
}

void addBoundaryOptions(Command& command, MapArguments& a) {
  addChoice(command, "--data", a.source.measured.force, "Built-in key points: the skin was dragged up or down");
  addChoice(command, "--averaging", a.source.measured.averaging,
            "Built-in key points: means as printed, or of the ellipses");
  addSetting(command, "--effect-radius-mm", a.source.ellipses.effect_radius_mm, above(0.0, kFarthestMm, "mm"),
             "Reach of a key point");
  addSetting(command, "--basic-radius-mm", a.source.ellipses.basic_radius_mm, above(0.0, kFarthestMm, "mm"),
             "Radius of the circle where no key point reaches");
}

void addEllipses(Command& parent) {
  constexpr Maker kMaker{[](const MapSkin& skin, const MapSource& source) { return ellipsesOver(skin, source); },
                         [](const MapSkin& skin, const scene::World& world, const MapSource& source) {
                           return ellipsesOfScene(skin, world, source.quantity);
                         }};
  const auto [command, a] = addCommand<MapArguments>(parent, "ellipses", "The deformation ellipse of every place",
                                                     [kMaker](const MapArguments& given) { run(given, kMaker); });
  addFileOptions(command, a);
  addSkinOptions(command, a);
  addKeyOption(command, a);
  addBoundaryOptions(command, a);
  restrictTo({"half-major", "aspect", "direction"},
             command.add_option("--quantity", a.source.quantity, "Quantity to colour by")->capture_default_str());
  restrictTo(choiceNames<Weights>(),
             command.add_option("--interpolation", a.interpolation,
                                "Interpolation: gri, or a form of the dissertation: (5.16) with E26, (5.16) as "
                                "printed, (5.7) (default: as --fidelity says)"));
  restrictTo(choiceNames<maps::DirectionBlend>(),
             command.add_option("--directions", a.directions, "Blending of directions (default: as --fidelity says)"));
  command.add_option("--fidelity", a.fidelity, "Errata taken literally: corrected, literal, or a list such as E28,E29")
      ->capture_default_str();
  addSceneOption(command, a, {"--quantity"});
}

void addContours(Command& parent) {
  constexpr Maker kMaker{makeContourMap, [](const MapSkin& skin, const scene::World& world, const MapSource&) {
                           return contoursOfScene(skin, world);
                         }};
  const auto [command, arguments] = addCommand<MapArguments>(
      parent, "contours",
      "Irregular boundaries: n radii a key point, from a table or the built-in ellipses; or a scene's",
      [kMaker](const MapArguments& given) { run(given, kMaker); });
  addFileOptions(command, arguments);
  addSkinOptions(command, arguments);
  addKeyOption(command, arguments);
  addBoundaryOptions(command, arguments);
  addSetting(command, "--radii", arguments.source.contour_radii,
             between(maps::kMinContourRadii, maps::kMaxContourRadii), "Built-in ellipses: radii per contour");
  addSceneOption(command, arguments, {});
}

void addStiffness(Command& parent) {
  constexpr Maker kMaker{
      [](const MapSkin& skin, const MapSource& source) { return makeStiffnessMap(skin, source); },
      [](const MapSkin& skin, const scene::World& world, const MapSource&) { return stiffnessOfScene(skin, world); }};
  const auto [command, arguments] = addCommand<MapArguments>(
      parent, "stiffness",
      "How hard the body pushes back: from key points with a stiffness, else from the torso's bones",
      [kMaker](const MapArguments& given) { run(given, kMaker); });
  maps::MeasuredStiffness& s = arguments.source.stiffness;
  addFileOptions(command, arguments);
  addSkinOptions(command, arguments);
  addKeyOption(command, arguments);
  restrictTo(choiceNames<maps::StiffnessInterpolation>(),
             command.add_option("--interpolation", arguments.interpolation,
                                "Interpolation between key points: gri (default), thin-plate or polynomial. Without "
                                "--keys: the torso measured at the seven places"));
  addSetting(command, "--degree", s.polynomial_degree, between(0, maps::kMaxPolynomialDegree),
             "Degree of the polynomial");
  addSetting(command, "--effect-radius-mm", s.effect_radius_mm, above(0.0, kFarthestMm, "mm"),
             "gri: how far a key point reaches");
  addSetting(command, "--basic-n-per-mm", s.basic_n_per_mm, above(0.0, 100.0, "N/mm"),
             "gri: stiffness where none reaches");
  addSceneOption(command, arguments, {});
}

void addDepth(Command& parent) {
  constexpr Maker kMaker{
      [](const MapSkin& skin, const MapSource&) { return depthOver(skin); },
      [](const MapSkin& skin, const scene::World& world, const MapSource&) { return depthOfScene(skin, world); }};
  const auto [command, arguments] =
      addCommand<MapArguments>(parent, "depth", "Write the depth of the torso's bones under the skin",
                               [kMaker](const MapArguments& given) { run(given, kMaker); });
  addFileOptions(command, arguments);
  addSetting(command, "--triangles", arguments.triangles, between(0, 2e7),
             "Triangles of the built-in torso; 0: 20389, with bones");
  addSceneOption(command, arguments, {});
}

}  // namespace

void addMapCommand(Command& body) {
  Command& map = *body.add_subcommand("map", "Write the ellipse, contour, stiffness or depth map of a skin or a scene");
  map.require_subcommand(1);
  addEllipses(map);
  addContours(map);
  addStiffness(map);
  addDepth(map);
}

}  // namespace palpate::app
