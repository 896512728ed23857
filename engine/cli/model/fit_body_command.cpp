// `palpate body fit SCAN -o OUT.toml`: finds spine, landmarks and bones of a scanned person and writes a scene of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/model/scanned_body.h"
#include "cli/own/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/body/fitting/body_fit.h"
#include "palpate/body/fitting/fitted_body.h"
#include "palpate/body/places.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene_writer.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

struct FitBodyArguments {
  MeshArguments scan;
  std::vector<std::string> at;
  std::string points;
  std::string output;
  bool keep_frame = false;
  bool json = false;
};

/// All results of a fit.
struct FitBodyResult {
  ScannedBody scan;
  body::BodyFit fit;
  body::FittedBody body;
  double turned_deg = 0;  ///< from our frame to the scan's
  std::vector<std::string> written;
  double seconds = 0;
};

std::vector<body::NamedPoint> collectPoints(const FitBodyArguments& arguments, double mm_per_unit) {
  std::vector<body::NamedPoint> points;
  if (!arguments.points.empty()) points = readNamedPoints(pathOf(arguments.points));
  for (const std::string& word : arguments.at) points.push_back(namedPointFrom("--at", word));
  for (body::NamedPoint& point : points) point.position *= mm_per_unit;
  return points;
}

/// The scan in our frame, its origin where the built-in trunk has it; the fit goes along.
void transformToBodyFrame(ScannedBody& scan, body::BodyFit& fit) {
  const Mat3 back = fit.placement.rotation.transpose();
  const Vec3 origin = fit.placement.translation;
  const auto turned = [&](const Vec3& p) { return Vec3(back * (p - origin)); };
  for (Vec3& p : scan.mesh.positions) p = turned(p);
  for (body::Move& move : fit.skin_moves) move = {turned(move.place), back * move.by};
  for (body::NamedPoint& point : fit.points) point.position = turned(point.position);
  fit.placement.rotation.setIdentity();
  fit.placement.translation.setZero();
}

/// A finger to start with: over a spinous process in the middle.
scene::Finger exampleFinger(const body::FittedBody& body) {
  scene::Finger finger;
  finger.name = "index";
  finger.radius_mm = 8;
  finger.at = body::spokenName(body.landmarks.front().name);
  for (const char* level : {"T6", "T9", "T12", "L3", "T3"}) {
    const bool shown = std::any_of(body.landmarks.begin(), body.landmarks.end(),
                                   [&](const auto& l) { return body::spokenName(l.name) == level; });
    if (!shown) continue;
    finger.at = level;
    break;
  }
  finger.steps = {{.move = scene::Move::press, .seconds = 1.5, .depth_mm = 4},
                  {.move = scene::Move::hold, .seconds = 0.5},
                  {.move = scene::Move::lift, .seconds = 0.5}};
  return finger;
}

fs::path besideOutput(const FitBodyArguments& arguments, const char* ending) {
  const fs::path output = pathOf(arguments.output);
  return fs::absolute(output.parent_path() / pathOf(output.stem().string() + ending));
}

void writeScene(const FitBodyArguments& arguments, FitBodyResult& result) {
  scene::Scene scene;
  scene.title = pathOf(arguments.scan.file).filename().string() + ", fitted";
  scene.body.kind = scene::BodyKind::mesh;
  constexpr double kTurnedDeg = 15;  // seen along z it is still the back
  if (result.turned_deg > kTurnedDeg && !arguments.keep_frame) {
    transformToBodyFrame(result.scan, result.fit);
    scene.body.file = besideOutput(arguments, ".aligned.ply");
    mesh::save(scene.body.file, result.scan.mesh, result.scan.channels);
    result.written.push_back(scene.body.file.string());
  } else {
    scene.body.file = fs::absolute(pathOf(arguments.scan.file));
    scene.body.group = arguments.scan.options.group;
    useUnit(result.scan.unit_mm, scene.body);
  }
  scene.body.fit = besideOutput(arguments, ".fit.json");
  writeFile(scene.body.fit, body::fitAsJson(result.fit));
  result.written.push_back(scene.body.fit.string());
  scene.fingers.push_back(exampleFinger(result.body));
  scene::save(scene, fs::absolute(pathOf(arguments.output)));
  result.written.push_back(fs::absolute(pathOf(arguments.output)).string());
}

FitBodyResult fitScan(const FitBodyArguments& arguments) {
  const auto start = Clock::now();
  ProgressLine progress;
  FitBodyResult result;
  result.scan = readScan(pathOf(arguments.scan.file), arguments.scan.options, progress.callback());
  const std::vector<body::NamedPoint> points = collectPoints(arguments, result.scan.mm_per_unit);
  report(progress.callback(), "building the template", 0.0);
  const body::TemplateBody trunk;
  try {
    result.fit = body::fitBody(trunk, result.scan.mesh, points, progress.callback());
    result.turned_deg = Eigen::AngleAxisd(result.fit.placement.rotation).angle() * kDegPerRad;
    if (result.fit.doubt.empty()) {
      report(progress.callback(), "placing the bones", 0.0);
      result.body = body::fittedBody(trunk, result.fit, result.scan.mesh);
      if (result.body.landmarks.empty()) result.fit.doubt = "the scan shows no landmark";
    }
  } catch (const Error& error) {
    throw Error::inFile(arguments.scan.file, error.what());
  }
  result.seconds = secondsSince(start);
  return result;
}

Json toJson(const FitBodyArguments& arguments, const FitBodyResult& result, const std::vector<Vec3>& places) {
  Json json;
  json["scan"] = arguments.scan.file;
  json["sure_enough"] = result.fit.doubt.empty();
  json["doubt"] = result.fit.doubt;
  json["certainty"] = result.fit.certainty;
  json["certainty_word"] = body::certaintyWord(result.fit.certainty);
  json["spine_expected_mm"] = result.fit.spine_expected_mm;
  json["rms_mm"] = result.fit.rms_mm;
  json["matched"] = result.fit.matched;
  json["turned_deg"] = result.turned_deg;
  const body::TrunkShape& shape = result.fit.placement.shape;
  json["build"] = {{"stature_mm", shape.stature_mm},           {"girth", shape.girth},
                   {"body_mass_index", shape.body_mass_index}, {"muscle", shape.muscle},
                   {"kyphosis_deg", shape.kyphosis_deg},       {"lordosis_deg", shape.lordosis_deg}};
  json["points"] = result.fit.points.size();
  json["bones"] = result.body.bones.size();
  json["landmarks"] = Json::array();
  for (std::size_t i = 0; i < result.body.landmarks.size(); ++i) {
    const body::SkinLandmark& landmark = result.body.landmarks[i];
    json["landmarks"].push_back({{"name", landmark.name},
                                 {"spoken", body::spokenName(landmark.name)},
                                 {"scan_mm", vectorJson(places[i])},
                                 {"expected_mm", result.body.expected_mm[i]}});
  }
  json["notes"] = result.scan.notes;
  json["written"] = result.written;
  json["seconds"] = result.seconds;
  return json;
}

std::string textOf(const FitBodyResult& result, const std::vector<Vec3>& places) {
  const body::BodyFit& fit = result.fit;
  std::string text;
  for (const std::string& note : result.scan.notes) text += "note       " + note + "\n";
  const body::TrunkShape& shape = fit.placement.shape;
  text += fmt::format(
      "build      stature about {:.0f} mm, body mass index {:.0f}, kyphosis {:.0f}, lordosis {:.0f} degrees\n",
      shape.stature_mm, shape.body_mass_index, shape.kyphosis_deg, shape.lordosis_deg);
  text += fmt::format("fit        {:.1f} mm RMS from the scan, {:.0f} % of it explained; {}\n", fit.rms_mm,
                      100 * fit.matched,
                      fit.points.empty() ? "by its shape alone" : fmt::format("by {} named points", fit.points.size()));
  text += fmt::format("certainty  {} ({:.0f} %): spinous processes are off by about {:.0f} mm\n",
                      body::certaintyWord(fit.certainty), 100 * fit.certainty, fit.spine_expected_mm);
  if (!fit.doubt.empty()) return text + "doubt      " + fit.doubt + "\n";
  text += fmt::format("\n{:<28} {:>8} {:>8} {:>8}  {:>9}\n", "landmark (mm of the scan)", "x", "y", "z", "likely off");
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += fmt::format("{:<28} {:8.1f} {:8.1f} {:8.1f}  {:9.0f}\n", body::spokenName(result.body.landmarks[i].name),
                        places[i].x(), places[i].y(), places[i].z(), result.body.expected_mm[i]);
  }
  text += fmt::format("\n{} bones, {} landmarks, {:.1f} s\n", result.body.bones.size(), places.size(), result.seconds);
  for (const std::string& file : result.written) text += "-> " + file + "\n";
  if (result.written.size() == 3) {
    text += fmt::format(
        "The scan is turned by {:.0f} degrees from x right, y up, z out of the back; the scene shows a copy that "
        "is not (--keep-frame keeps it).\n",
        result.turned_deg);
  }
  return text;
}

void runFitBody(const FitBodyArguments& arguments) {
  if (pathOf(arguments.output).extension() != ".toml") {
    throw Error::inFile(arguments.output, "the name of a scene file must end in .toml");
  }
  FitBodyResult result = fitScan(arguments);
  std::vector<Vec3> places;
  for (const body::SkinLandmark& landmark : result.body.landmarks) places.push_back(landmark.position);
  if (result.fit.doubt.empty()) writeScene(arguments, result);
  fmt::print("{}", arguments.json ? jsonDump(toJson(arguments, result, places), 2) + "\n" : textOf(result, places));
  if (result.fit.doubt.empty()) return;
  say(fmt::format("{}: not sure enough, nothing was written: {}\n", arguments.scan.file, result.fit.doubt));
  throw ExitWith(1);
}

}  // namespace

void addFitBodyCommand(Command& body) {
  const auto [command, arguments] = addCommand(
      body, "fit", "Find spine, landmarks and bones in a scan of a back or trunk, and write a scene", runFitBody);
  addMeshArguments(command, arguments.scan);
  command
      .add_option("--at", arguments.at,
                  "Landmark and its place x,y,z on the scan, in the file's unit: \"left PSIS=-48,-300,105\"; four or "
                  "more place the body, fewer assist the fit by shape, none uses the shape alone")
      ->type_name("NAME=PLACE");
  command.add_option("--points", arguments.points, "Table name,x,y,z of such landmarks");
  namesFileToWrite(
      command.add_option("-o,--out", arguments.output, "Scene file to write, with NAME.fit.json next to it"))
      ->required();
  command.add_flag("--keep-frame", arguments.keep_frame, "Keep the scan's own orientation; fingers press along its z");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
