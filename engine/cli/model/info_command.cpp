// `palpate body info MESH`: the contents of a mesh file and its faults.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/model/triangle_shape.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "palpate/trace/forces_table.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

// --- a recorded table of forces, or an unfinished file ---

/// As a replay reads it, so the report holds for the replay.
std::vector<trace::RecordedFinger> readRecordedFingers(const fs::path& file) {
  if (trace::isForcesTable(file)) return trace::readForcesTable(file);
  if (!fs::exists(file)) throw Error::inFile(file.string(), "no such file");
  throw Error::inFile(file.string(), fmt::format("is an unfinished copy of {}, which is unchanged; delete the copy",
                                                 file.stem().string()));
}

double peakForceN(const trace::RecordedFinger& finger) {
  double peak = 0.0;
  for (const Vec3& force : finger.force) peak = std::max(peak, force.norm());
  return peak;
}

/// Judges by the name: a table, or an unfinished file.
bool isTableOrUnfinished(const fs::path& file) { return trace::isForcesTable(file) || trace::isUnfinished(file); }

/// As text or as JSON. Throws Error for a table that cannot be read.
std::string tableInfo(const fs::path& file) {
  const std::vector<trace::RecordedFinger> fingers = readRecordedFingers(file);
  std::string text = "table       of forces, recorded by palpate\n";
  if (trace::isUnfinished(file)) {
    text +=
        "unfinished  the recording could not be completed (a full disk, a killed program): a torn last row is left "
        "out\n";
  }
  for (const trace::RecordedFinger& finger : fingers) {
    text += fmt::format("finger      {}: {} rows, {:.3f} to {:.3f} s, peak {:.2f} N\n", finger.name,
                        finger.time_s.size(), finger.time_s.front(), finger.time_s.back(), peakForceN(finger));
  }
  return text + fmt::format("to see it   palpate run --replay {}\n", file.string());
}

Json tableInfoJson(const fs::path& file) {
  Json json = {{"file", file.string()}, {"kind", "forces"}, {"complete", !trace::isUnfinished(file)}};
  json["fingers"] = Json::array();
  for (const trace::RecordedFinger& finger : readRecordedFingers(file)) {
    json["fingers"].push_back({{"name", finger.name},
                               {"rows", finger.time_s.size()},
                               {"from_s", finger.time_s.front()},
                               {"to_s", finger.time_s.back()},
                               {"peak_force_n", peakForceN(finger)}});
  }
  return json;
}

// --- the report, for a person and for a script ---

using mesh::ValidationReport;

/// Memory of the surface itself; trees and deformation come on top (docs/reference/mesh.md).
std::size_t memoryBytes(const ValidationReport& report) {
  return report.vertices * sizeof(Vec3) + report.triangles * sizeof(Triangle);
}

std::string words(const Vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x(), v.y(), v.z()); }

std::string boxLine(const ValidationReport& report) {
  if (report.box.isEmpty()) return "none";
  return fmt::format("{} mm, from {} to {}", words(report.box.sizes()), words(report.box.min()),
                     words(report.box.max()));
}

std::string surfaceLine(const ValidationReport& report) {
  std::string text(mesh::wordsFor(report.closure));
  if (report.closed) text += fmt::format(", {:.6g} mm^3", report.volume_mm3);
  if (report.closed && report.non_manifold_edges.count > 0) text += ", sheets meet in edges";
  if (report.one_sided) text += ", one-sided";
  return text + fmt::format(", {:.6g} mm^2, {} component{}", report.area_mm2, report.components,
                            report.components == 1 ? "" : "s");
}

// --- probable errors of the unit ---

struct Unit {
  double factor;
  const char* name;
  const char* word;  ///< value of --unit
};
/// Common units of meshes, the likeliest first.
constexpr std::array<Unit, 5> kUnits = {{{1000.0, "metres", "m"},
                                         {10.0, "centimetres", "cm"},
                                         {100.0, "decimetres", "dm"},
                                         {25.4, "inches", "in"},
                                         {0.001, "micrometres", "0.001"}}};

/// Empty when the size is one of a body or a part of one.
std::string sizeWarning(const ValidationReport& report) {
  if (!mesh::hasDoubtfulSize(report.box)) return "";
  const std::string text = fmt::format("{} mm is {} for a body: is the unit right? ", words(report.box.sizes()),
                                       report.box.diagonal().norm() < mesh::kShortestBodyMm ? "small" : "large");
  for (const Unit& unit : kUnits) {
    const Eigen::AlignedBox3d box(unit.factor * report.box.min(), unit.factor * report.box.max());
    if (mesh::hasDoubtfulSize(box)) continue;
    return text + fmt::format("If these are {}, use --unit {}", unit.name, unit.word);
  }
  return text + "set the unit of the file with --unit";
}

/// A body as long as one but thinner than any: one axis has another scale.
constexpr double kThinnestBodyMm = 1.0;

std::string thinWarning(const ValidationReport& report) {
  if (report.box.isEmpty() || mesh::hasDoubtfulSize(report.box)) return "";
  const double thickness = report.box.sizes().minCoeff();
  if (thickness >= kThinnestBodyMm) return "";
  return fmt::format("{:.3g} mm is thin for a body: are all three axes in one unit?", thickness);
}

/// `notes`: passed over or guessed while the file was read.
std::vector<std::string> collectWarnings(const ValidationReport& report, std::vector<std::string> notes = {}) {
  std::vector<std::string> warnings = std::move(notes);
  for (std::string warning : {sizeWarning(report), thinWarning(report)}) {
    if (!warning.empty()) warnings.push_back(std::move(warning));
  }
  return warnings;
}

const char* verdictOn(const ValidationReport& report) {
  if (report.fit() && report.doubtful_parts.count > 0) {
    return "fit for contact as it is; if it is inside out, flip it with `palpate body repair --turn-over doubtful`\n";
  }
  if (report.fit()) {
    return collectWarnings(report).empty() ? "fit for contact as it is\n"
                                           : "fit for contact, if that is its true size\n";
  }
  return report.sound() ? "fit for contact except for small holes, which repair fills (done automatically on use)\n"
                        : "needs repair before contact (done automatically on use)\n";
}

// --- as text, as JSON ---

Json toJson(const mesh::Trait& trait) { return {{"count", trait.count}, {"first", trait.first}}; }

Json traitsJson(const ValidationReport& report) {
  Json traits;
  traits["non_finite_vertices"] = toJson(report.non_finite_vertices);
  traits["out_of_range_triangles"] = toJson(report.wrong_indices);
  traits["zero_area_triangles"] = toJson(report.zero_area_triangles);
  traits["duplicate_triangles"] = toJson(report.duplicate_triangles);
  traits["opposite_triangles"] = toJson(report.opposite_triangles);
  traits["non_manifold_edges"] = toJson(report.non_manifold_edges);
  traits["non_manifold_vertices"] = toJson(report.non_manifold_vertices);
  traits["inconsistent_edges"] = toJson(report.inconsistent_edges);
  traits["inside_out_parts"] = toJson(report.inside_out_parts);
  traits["doubtful_parts"] = toJson(report.doubtful_parts);
  traits["border_edges"] = toJson(report.border_edges);
  traits["self_intersections"] = toJson(report.self_intersections);
  traits["touching_edges"] = toJson(report.touching_edges);
  traits["unused_vertices"] = toJson(report.unused_vertices);
  traits["coincident_vertices"] = toJson(report.coincident_vertices);
  return traits;
}

std::string textOf(const ValidationReport& report, const std::vector<std::string>& notes) {
  std::string text = fmt::format(
      "triangles   {}\nvertices    {}\nbox         {}\nsurface     {}\nmemory      {:.1f} MB\n", report.triangles,
      report.vertices, boxLine(report), surfaceLine(report), 1e-6 * static_cast<double>(memoryBytes(report)));
  for (const std::string& sentence : mesh::describe(report)) text += "found       " + sentence + "\n";
  if (!report.self_intersections_checked) text += "not checked self-intersections\n";
  for (const std::string& warning : collectWarnings(report, notes)) text += "warning     " + warning + "\n";
  return text + verdictOn(report);
}

Json toJson(const ValidationReport& report, const std::vector<std::string>& notes) {
  Json json;
  json["triangles"] = report.triangles;
  json["vertices"] = report.vertices;
  if (!report.box.isEmpty())
    json["box"] = {{"min_mm", vectorJson(report.box.min())}, {"max_mm", vectorJson(report.box.max())}};
  json["area_mm2"] = report.area_mm2;
  json["volume_mm3"] = report.closed ? Json(report.volume_mm3) : Json(nullptr);
  json["closed"] = report.closed;
  json["closure"] = mesh::wordsFor(report.closure);
  json["one_sided"] = report.one_sided;
  json["components"] = report.components;
  json["border_loops"] = report.border_loops;
  json["small_holes"] = report.small_holes;
  json["fillable_holes"] = report.fillable_holes;
  json["fit"] = report.fit();
  json["sound"] = report.sound();
  json["warnings"] = collectWarnings(report, notes);
  json["self_intersections_checked"] = report.self_intersections_checked;
  json["memory_bytes"] = memoryBytes(report);
  json["traits"] = traitsJson(report);
  return json;
}

// --- further contents of the file: numbers of vertices and faces ---

struct FileNumber {
  std::string name;
  const char* of;  ///< "vertex" or "face"
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

std::vector<FileNumber> numbersOf(const mesh::VertexChannels& channels) {
  std::vector<FileNumber> numbers;
  for (const mesh::VertexScalar& scalar : channels.scalars) {
    FileNumber& number = numbers.emplace_back(FileNumber{scalar.name, "vertex"});
    for (const float value : scalar.values) {
      if (!std::isfinite(value)) continue;
      number.least = std::min<double>(number.least, value);
      number.most = std::max<double>(number.most, value);
    }
  }
  for (const mesh::FaceScalar& scalar : channels.of_faces) {
    numbers.push_back({scalar.name, "face", scalar.least, scalar.most});
  }
  return numbers;
}

std::string textOf(const std::vector<FileNumber>& numbers) {
  std::string text;
  for (const FileNumber& number : numbers) {
    text += fmt::format("number      {} of each {}, ", number.name, number.of);
    text +=
        number.least > number.most ? "never finite\n" : fmt::format("{:.6g} to {:.6g}\n", number.least, number.most);
  }
  return text;
}

Json toJson(const std::vector<FileNumber>& numbers) {
  Json list = Json::array();
  for (const FileNumber& number : numbers) {
    Json one = {{"name", number.name}, {"of", number.of}, {"min", nullptr}, {"max", nullptr}};
    if (number.least <= number.most) one.update({{"min", number.least}, {"max", number.most}});
    list.push_back(std::move(one));
  }
  return list;
}

// --- the command ---

struct InfoArguments {
  MeshArguments mesh;
  bool quick = false;
  bool shape = false;
  bool json = false;
};

struct Inspection {
  ValidationReport report;
  std::optional<TriangleShapes> shapes;
  std::vector<FileNumber> numbers;
  std::vector<std::string> notes;
};

Inspection inspect(const InfoArguments& arguments) {
  ProgressLine progress;
  mesh::LoadOptions options = arguments.mesh.options;
  options.keep_wrong_indices = true;  // to be counted, not refused
  const auto [surface, channels, notes] =
      mesh::loadWithChannels(pathOf(arguments.mesh.file), options, progress.callback());
  Inspection found{mesh::validate(surface, {.self_intersections = !arguments.quick}, progress.callback()),
                   {},
                   numbersOf(channels),
                   notes};
  const bool can_be_measured = found.report.wrong_indices.count == 0 && found.report.non_finite_vertices.count == 0;
  if (arguments.shape && can_be_measured) found.shapes = triangleShapes(surface);
  return found;
}

void runInfo(const InfoArguments& arguments) {
  if (isRecordingFile(pathOf(arguments.mesh.file))) {
    printReadable(arguments.json ? jsonText(recordingInfoJson(pathOf(arguments.mesh.file)))
                                 : recordingInfo(pathOf(arguments.mesh.file)));
    return;
  }
  if (isTableOrUnfinished(pathOf(arguments.mesh.file))) {
    printReadable(arguments.json ? jsonText(tableInfoJson(pathOf(arguments.mesh.file)))
                                 : tableInfo(pathOf(arguments.mesh.file)));
    return;
  }
  const Inspection found = inspect(arguments);
  if (arguments.json) {
    Json json = {{"file", arguments.mesh.file}};
    json.update(toJson(found.report, found.notes));
    json["numbers"] = toJson(found.numbers);
    if (found.shapes) json["shape"] = asJson(*found.shapes);
    fmt::print("{}\n", jsonDump(json, 2));
  } else {
    printReadable((found.shapes ? asText(*found.shapes) : "") + textOf(found.numbers) +
                  textOf(found.report, found.notes));
  }
}

}  // namespace

void addInfoCommand(Command& group) {
  const auto [command, arguments] = addCommand(
      group, "info",
      "Report the contents and defects of a mesh file, or the contents of a table of forces or a recording", runInfo);
  addMeshArguments(command, arguments.mesh);
  command.add_flag("--no-self-intersections", arguments.quick,
                   "Skip the search for self-intersections (the slowest check)");
  command.add_flag("--shape", arguments.shape, "Also report the quality of a mesh's triangles: folds, angles, areas");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
