#include "cli/model/scanned_body.h"

#include <fmt/format.h>

#include <array>

#include "cli/kit/number_option.h"
#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/mesh/repair.h"

namespace palpate::app {

namespace {

constexpr std::uint64_t kLongestPointsFile = 1 << 20;

// From corner to corner: a child's back, and a tall man with his arms out.
constexpr double kSmallestScanMm = 250;
constexpr double kLargestScanMm = 3000;

struct GuessedUnit {
  const char* words;
  double mm;
};
constexpr std::array<GuessedUnit, 3> kGuessedUnits = {{{"metres", 1000}, {"decimetres", 100}, {"centimetres", 10}}};

double boxDiagonal(const mesh::TriangleMesh& mesh) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(mesh);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

bool isBodySized(double diagonal_mm) { return diagonal_mm >= kSmallestScanMm && diagonal_mm <= kLargestScanMm; }

void guessUnit(ScannedBody& scan) {
  const double diagonal = boxDiagonal(scan.mesh);
  if (isBodySized(diagonal)) return;
  for (const GuessedUnit& unit : kGuessedUnits) {
    if (!isBodySized(diagonal * unit.mm)) continue;
    for (Vec3& p : scan.mesh.positions) p *= unit.mm;
    scan.unit_mm = scan.mm_per_unit = unit.mm;
    scan.notes.push_back(
        fmt::format("unit assumed to be {}: the scan measures {:.4g} from corner to corner (set it with --unit)",
                    unit.words, diagonal));
    return;
  }
}

bool isInMetres(const std::filesystem::path& file) {
  const std::string extension = inSmallLetters(file.extension().string());
  return extension == ".gltf" || extension == ".glb";
}

}  // namespace

ScannedBody readScan(const std::filesystem::path& file, mesh::LoadOptions options, const Progress& progress) {
  options.keep_wrong_indices = true;
  mesh::MeshWithChannels loaded = mesh::loadWithChannels(file, options, progress);
  ScannedBody scan;
  scan.notes = std::move(loaded.notes);
  scan.unit_mm = options.unit_mm;
  scan.mm_per_unit = options.unit_mm > 0 ? options.unit_mm : isInMetres(file) ? 1000 : 1;
  try {
    mesh::RepairResult repaired = mesh::repair(std::move(loaded.mesh), {.find_self_intersections = false}, progress);
    scan.mesh = std::move(repaired.mesh);
    scan.channels = mesh::followed(loaded.channels, repaired.source_vertex);
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
  if (options.unit_mm == 0 && scan.mm_per_unit == 1) guessUnit(scan);
  return scan;
}

body::NamedPoint namedPointFrom(const std::string& option, const std::string& word) {
  const std::size_t equals = word.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError(option, fmt::format("'{}' must have the form NAME=X,Y,Z", oneLine(word)));
  }
  const std::vector<double> place = numbersFrom(option, word.substr(equals + 1), {});
  if (place.size() != 3) throw UsageError(option, fmt::format("'{}' must have three numbers", oneLine(word)));
  return {word.substr(0, equals), {place[0], place[1], place[2]}};
}

std::vector<body::NamedPoint> readNamedPoints(const std::filesystem::path& file) {
  const std::string text = readFile(file, kLongestPointsFile);
  const std::string name = file.string();
  std::vector<body::NamedPoint> points;
  bool first = true;
  forEachCsvRow(text, name, [&](const CsvRow& row) {
    const bool header = first && row.fields.size() > 1 && !parseNumber(row.fields[1]);
    first = false;
    if (header) return;
    if (row.fields.size() != 4) throw Error::atLine(row.file, row.line, "expected name,x,y,z");
    points.push_back(
        {std::string(row.fields[0]), {csvNumber(row, 1, "x"), csvNumber(row, 2, "y"), csvNumber(row, 3, "z")}});
  });
  if (points.empty()) throw Error::inFile(name, "has no points");
  return points;
}

}  // namespace palpate::app
