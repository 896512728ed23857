// `palpate body make trunk|back|torso|bones|hand`: writes a part of the built-in human to a mesh file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/own/commands.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/body/back.h"
#include "palpate/body/bones.h"
#include "palpate/body/hand.h"
#include "palpate/body/places.h"
#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/words.h"

namespace palpate::app {

namespace {

struct ModelOptions {
  std::string output;
  std::string skin_output;
  std::string bones_output;
  std::size_t triangles = 0;
  std::size_t bone_triangles = 0;
  body::SkinSettings shape;
  body::TrunkShape build;
  std::string posture{wordFor(body::Posture::standing)};
  double hand_length_mm = body::HandSettings{}.length_mm;
  std::string side{wordFor(body::HandSettings{}.side)};
  bool json = false;
};

/// One surface, and the values per vertex that PLY can hold. Empty channels are left out.
struct Model {
  mesh::TriangleMesh mesh;
  std::vector<Vec3> normals;
  std::vector<float> depth_mm;  ///< to the nearest bone; 0 on a bone
  std::vector<float> part;      ///< 0 skin, 1.. the bones in the order of the summary
  std::vector<float> bone;      ///< on the skin: the part number of the nearest bone; on a bone its own
};

mesh::VertexChannels buildChannels(const Model& model) {
  mesh::VertexChannels channels;
  for (int axis = 0; axis < 3 && !model.normals.empty(); ++axis) {
    mesh::VertexScalar column{std::string("n") + "xyz" [axis], {}};
    for (const Vec3& normal : model.normals) column.values.push_back(static_cast<float>(normal[axis]));
    channels.scalars.push_back(std::move(column));
  }
  if (!model.depth_mm.empty()) channels.scalars.push_back({"depth_mm", model.depth_mm});
  if (!model.part.empty()) channels.scalars.push_back({"part", model.part});
  if (!model.bone.empty()) channels.scalars.push_back({"bone", model.bone});
  return channels;
}

void write(const std::string& file, const Model& model) {
  const bool carries_values = pathOf(file).extension() == ".ply";
  mesh::save(pathOf(file), model.mesh, carries_values ? buildChannels(model) : mesh::VertexChannels{});
}

/// For a torso or a trunk.
template <class Body>
Model skinModel(const mesh::TriangleMesh& skin, const std::vector<Vec3>& normals, const Body& body) {
  Model model{skin, normals, {}, {}, {}};
  model.depth_mm.assign(body.depth_mm.begin(), body.depth_mm.end());
  model.part.assign(body.depth_mm.size(), 0);
  for (const Index bone : body.nearest_bone) model.bone.push_back(static_cast<float>(bone + 1));
  return model;
}

/// Appends the bones; values are kept only if the model has them already or is empty.
void appendBones(const std::vector<body::Bone>& bones, Model& model) {
  model.normals.clear();
  for (std::size_t i = 0; i < bones.size(); ++i) {
    append(bones[i].mesh, model.mesh);
    model.part.resize(model.mesh.positions.size(), static_cast<float>(i + 1));
    model.bone.resize(model.mesh.positions.size(), static_cast<float>(i + 1));
  }
  if (!model.depth_mm.empty()) model.depth_mm.resize(model.mesh.positions.size(), 0);
}

Json partsJson(const std::vector<body::Bone>& bones) {
  Json parts = Json::array();
  for (std::size_t i = 0; i < bones.size(); ++i) {
    parts.push_back({{"name", bones[i].name}, {"part", i + 1}, {"triangles", bones[i].mesh.triangles.size()}});
  }
  return parts;
}

Json landmarksOf(const std::vector<body::SkinLandmark>& points) {
  Json landmarks = Json::array();
  for (const body::SkinLandmark& point : points) {
    landmarks.push_back({{"bone", point.bone},
                         {"bone_mm", vectorJson(point.bone_position)},
                         {"name", point.name},
                         {"normal", vectorJson(point.normal)},
                         {"skin_mm", vectorJson(point.position)},
                         {"spoken", body::spokenName(point.name)}});
  }
  return landmarks;
}

/// A measure of the shape of the triangles: near 60 is regular, near 0 a sliver.
double smallestAngleDeg(const mesh::TriangleMesh& mesh) {
  double largest_cosine = -1;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& corner = mesh.positions[t[i]];
      const Vec3 u = mesh.positions[t[(i + 1) % 3]] - corner;
      const Vec3 v = mesh.positions[t[(i + 2) % 3]] - corner;
      largest_cosine = std::max(largest_cosine, u.dot(v) / std::sqrt(u.squaredNorm() * v.squaredNorm()));
    }
  }
  return std::acos(std::min(1.0, largest_cosine)) * 180 / std::numbers::pi;
}

/// Writes the model and prints a summary, as text or as one JSON object, whose members are sorted.
void finish(const char* name, const ModelOptions& options, const Model& model, double seconds, Json extra) {
  write(options.output, model);
  const Vec3 box = mesh::boundingBox(model.mesh).sizes();
  if (!options.json) {
    fmt::print("{}: {} triangles, {} vertices, {:.1f} x {:.1f} x {:.1f} mm, made in {:.2f} s -> {}\n", name,
               model.mesh.triangles.size(), model.mesh.positions.size(), box.x(), box.y(), box.z(), seconds,
               options.output);
    return;
  }
  extra["model"] = name;
  extra["file"] = options.output;
  extra["triangles"] = model.mesh.triangles.size();
  extra["vertices"] = model.mesh.positions.size();
  extra["box_mm"] = vectorJson(box);
  extra["smallest_angle_deg"] = smallestAngleDeg(model.mesh);
  extra["seconds"] = seconds;
  std::map<std::string, Json> sorted;
  for (const auto& [key, value] : extra.items()) sorted.emplace(key, value);
  Json json;
  for (auto& [key, value] : sorted) json[key] = std::move(value);
  fmt::print("{}\n", jsonDump(json, 2));
}

void makeBackModel(const ModelOptions& options) {
  const auto start = Clock::now();
  body::Skin skin = body::makeBackSkin({options.triangles, options.shape});
  finish("back", options, {std::move(skin.mesh), std::move(skin.normals), {}, {}, {}}, secondsSince(start),
         {{"stature_mm", options.shape.stature_mm}});
}

/// A torso or a trunk: all in one file, and on request skin and bones in files of their own.
template <class Body>
void writeWhole(const char* name, const ModelOptions& options, Model whole, const Body& body, double seconds,
                double stature_mm) {
  const std::size_t of_skin = whole.mesh.triangles.size();
  if (!options.skin_output.empty()) write(options.skin_output, whole);
  appendBones(body.bones, whole);
  if (!options.bones_output.empty()) {
    Model bones;
    appendBones(body.bones, bones);
    write(options.bones_output, bones);
  }
  finish(name, options, whole, seconds,
         {{"stature_mm", stature_mm},
          {"skin_triangles", of_skin},
          {"least_cover_mm", *std::min_element(body.depth_mm.begin(), body.depth_mm.end())},
          {"parts", partsJson(body.bones)},
          {"landmarks", landmarksOf(body.landmarks)}});
}

void makeTorsoModel(const ModelOptions& options) {
  const auto start = Clock::now();
  const body::Torso torso = body::makeTorso({options.triangles, options.bone_triangles, options.shape});
  const double seconds = secondsSince(start);
  writeWhole("torso", options, skinModel(torso.skin.mesh, torso.skin.normals, torso), torso, seconds,
             options.shape.stature_mm);
}

void makeTrunkModel(const ModelOptions& options) {
  const auto start = Clock::now();
  body::TrunkSettings settings{options.triangles, options.bone_triangles, options.build};
  settings.shape.posture = *valueNamed<body::Posture>(options.posture);
  settings.shape.stature_mm = options.shape.stature_mm;
  const body::Trunk trunk = body::makeTrunk(settings);
  const double seconds = secondsSince(start);
  writeWhole("trunk", options, skinModel(trunk.skin, mesh::vertexNormals(trunk.skin), trunk), trunk, seconds,
             options.shape.stature_mm);
}

void makeBonesModel(const ModelOptions& options) {
  const auto start = Clock::now();
  const std::vector<body::Bone> bones =
      body::makeBones({.stature_mm = options.shape.stature_mm, .triangles = options.triangles, .warp = {}});
  Model model;
  appendBones(bones, model);
  finish("bones", options, model, secondsSince(start),
         {{"stature_mm", options.shape.stature_mm}, {"parts", partsJson(bones)}});
}

void makeHandModel(const ModelOptions& options) {
  const auto start = Clock::now();
  body::HandSettings settings;
  settings.side = *valueNamed<body::Side>(options.side);
  settings.triangles = options.triangles;
  settings.length_mm = options.hand_length_mm;
  Model model;
  model.mesh = body::makeHand(settings);
  const Vec3 tip = body::indexTip(settings);
  finish("hand", options, model, secondsSince(start), {{"side", options.side}, {"index_tip_mm", vectorJson(tip)}});
}

/// A model's subcommand. Its options live as long as the command line does.
struct ModelCommand {
  Command* command;
  std::shared_ptr<ModelOptions> options;
};

/// Adds a model's command with the options that all have.
ModelCommand addModel(Command& parent, const char* name, const char* what, std::size_t triangles,
                      const Limits& triangle_limits, const std::function<void(const ModelOptions&)>& make) {
  auto options = std::make_shared<ModelOptions>();
  options->triangles = triangles;
  Command* command = parent.add_subcommand(name, what);
  namesFileToWrite(command->add_option("-o,--out", options->output, "Mesh file to write: .obj, .stl or .ply"))
      ->required();
  addSetting(*command, "--triangles", options->triangles, triangle_limits, "Exact number of triangles");
  command->add_flag("--json", options->json, "Print the summary as one JSON object");
  command->callback([make, options] { make(*options); });
  return {command, options};
}

void addStature(Command& command, ModelOptions& options) {
  addSetting(command, "--stature-mm", options.shape.stature_mm, between(300.0, 3000.0, "mm"),
             "Height of the person; the whole body scales with it");
}

void addShape(Command& command, ModelOptions& options) {
  addStature(command, options);
  body::SkinSettings& shape = options.shape;
  constexpr const char* kGroup = "Shape of the skin";
  const auto add = [&](const char* name, double& value, const char* help) {
    addSetting(command, name, value, between(0.0, 5.0), help)->group(kGroup);
  };
  add("--spine-relief", shape.relief.spine, "Spinous processes: 0 none, 1 a lean man, 2 emaciated");
  add("--rib-relief", shape.relief.ribs, "Ribs: 0 none, 1 a lean man, 2 emaciated");
  add("--scapula-relief", shape.relief.scapulae, "Shoulder blades: 0 none, 1 a lean man, 2 emaciated");
  add("--asymmetry", shape.asymmetry, "Difference between left and right: 0 symmetric, 1 natural");
  const auto add_levels = [&](const char* name, body::LevelWeights& value) {
    addNumber(command, name, value, between(0.0, 5.0), "Weights of the relief at T1-T2, T3-T9, T10-L2, L3-L5")
        ->delimiter(',')
        ->capture_default_str()
        ->group(kGroup);
  };
  add_levels("--spine-levels", shape.relief.spine_level);
  add_levels("--rib-levels", shape.relief.rib_level);
  add_levels("--scapula-levels", shape.relief.scapula_level);
}

void addOutputs(Command& command, ModelOptions& options) {
  addSetting(command, "--bone-triangles", options.bone_triangles, between(0, 2e7),
             "Number of bone triangles among them; 0 is automatic");
  command.add_option("--skin-out", options.skin_output, "Also write the skin alone to this file");
  command.add_option("--bones-out", options.bones_output, "Also write the bones alone to this file");
}

void addBuild(Command& command, body::TrunkShape& build) {
  constexpr const char* kGroup = "Build";
  const auto add = [&](const char* name, double& value, const Limits& limits, const char* help) {
    addSetting(command, name, value, limits, help)->group(kGroup);
  };
  add("--girth", build.girth, between(0.8, 1.3), "Factor for the width and depth of the frame, including bones");
  add("--body-mass-index", build.body_mass_index, between(16, 45, "kg/m2"),
      "Body mass index, which sets the fat under the skin");
  add("--muscle", build.muscle, between(0, 2), "Muscle mass: 0 wasted, 2 athletic");
  add("--kyphosis-deg", build.kyphosis_deg, between(15, 65), "Curvature of the thoracic spine, T1 to T12");
  add("--lordosis-deg", build.lordosis_deg, between(0, 50), "Curvature of the lumbar spine, L1 to L5");
  add("--spine-relief", build.relief.spine, between(0, 3), "Relief of the spinous processes: 0 none, 1 a lean man");
  add("--rib-relief", build.relief.ribs, between(0, 3), "Relief of the ribs of the back");
  add("--scapula-relief", build.relief.scapulae, between(0, 3), "Relief of the shoulder blades");
  add("--asymmetry", build.asymmetry, between(0, 3), "Difference between left and right: 0 symmetric, 1 natural");
}

void addTrunk(Command& model) {
  const auto [command, options] = addModel(
      model, "trunk", "The whole trunk, closed, from the neck to below the gluteal fold, over 74 bones",
      body::TrunkSettings{}.triangles, between(static_cast<double>(body::kFewestTrunkTriangles), 2e7), makeTrunkModel);
  addSetting(*command, "--stature-mm", options->shape.stature_mm, between(500.0, 2500.0, "mm"),
             "Height of the person; the whole body scales with it");
  restrictTo(wordList<body::Posture>(),
             command->add_option("--posture", options->posture, "Posture of the trunk")->capture_default_str());
  addBuild(*command, options->build);
  addOutputs(*command, *options);
}

void addBack(Command& model) {
  const auto [command, options] = addModel(model, "back", "The back, 350 x 400 x 120 mm",
                                           body::BackSettings{}.triangles, between(500, 4e6), makeBackModel);
  addShape(*command, *options);
}

void addTorso(Command& model) {
  const auto [command, options] = addModel(
      model, "torso", "Skin down to the sacrum over its bones; the dissertation's sizes are 8163, 20389 and 41582",
      body::TorsoSettings{}.triangles, between(5000, 2e7), makeTorsoModel);
  options->shape = body::TorsoSettings{}.shape;
  addShape(*command, *options);
  addOutputs(*command, *options);
}

void addBones(Command& model) {
  const auto [command, options] = addModel(model, "bones", "T1-T12, L1-L5, 24 ribs and two shoulder blades",
                                           body::BonesSettings{}.triangles, between(0, 2e7), makeBonesModel);
  addStature(*command, *options);
}

void addHand(Command& model) {
  const auto [command, options] = addModel(model, "hand", "An open hand with the index finger stretched out",
                                           body::HandSettings{}.triangles, between(200, 4e6), makeHandModel);
  restrictTo(wordList<body::Side>(),
             command->add_option("--side", options->side, "Left or right hand")->capture_default_str());
  addSetting(*command, "--length-mm", options->hand_length_mm, between(20.0, 1000.0, "mm"),
             "Length from the cut at the wrist to the tip of the index finger");
}

}  // namespace

void addModelCommand(Command& body) {
  Command* model = body.add_subcommand("make", "Write a part of the built-in human body to a mesh file (mm)");
  model->require_subcommand(1);
  addTrunk(*model);
  addBack(*model);
  addTorso(*model);
  addBones(*model);
  addHand(*model);
}

}  // namespace palpate::app
