// OFF, text: one vertex a line, one polygon a line. Colours, normals and texture behind the numbers are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/mesh/files/detail/polygons.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"

namespace palpate::mesh {

namespace {

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// Shortest line of a vertex and of a face: "0 0 0", "0" and their line ends.
constexpr std::size_t kMinVertexBytes = 6;
constexpr std::size_t kMinFaceBytes = 2;

void readKeyword(TextReader& text) {
  constexpr std::array<std::string_view, 5> kKnown = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"};
  const auto word = text.word();
  if (std::find(kKnown.begin(), kKnown.end(), word) == kKnown.end()) {
    text.fail(fmt::format("'OFF' is expected, not '{}'", shown(word)));
  }
}

void toNextRow(TextReader& text, std::string_view what, std::size_t promised) {
  if (!text.nextFilledLine('#')) text.fail(fmt::format("the file ends before all its {} {} are there", promised, what));
}

/// The counts stand behind the keyword or in the next line that says something.
Counts readCounts(TextReader& text) {
  const auto rest = text.restOfLine();
  if (rest == "BINARY") text.fail("binary OFF cannot be read");
  if (rest.empty() || rest.front() == '#') toNextRow(text, "counts", 2);
  const auto most = static_cast<long long>(text.bytesLeft());
  return {.vertices = static_cast<std::size_t>(
              text.whole(text.word(), "the number of vertices", 0, most / static_cast<long long>(kMinVertexBytes))),
          .faces = static_cast<std::size_t>(
              text.whole(text.word(), "the number of faces", 0, most / static_cast<long long>(kMinFaceBytes)))};
}

void readPolygon(TextReader& text, PolygonList& polygons) {
  const auto corners = text.whole(text.word(), "the number of corners", 0, static_cast<long long>(text.bytesLeft()));
  for (long long i = 0; i < corners; ++i) {
    polygons.addCorner(static_cast<Index>(text.whole(text.word(), "a vertex index", -1, kNoIndex)));
  }
  polygons.close(text.line());
}

}  // namespace

TriangleMesh readOff(const MeshFile& file) {
  TextReader text(file.bytes, file.name, file.progress);
  readKeyword(text);
  const Counts counts = readCounts(text);
  TriangleMesh mesh;
  mesh.positions.resize(counts.vertices);
  for (Vec3& position : mesh.positions) {
    toNextRow(text, "vertices", counts.vertices);
    for (double& value : position) value = text.number(text.word(), "a coordinate");
  }
  PolygonList polygons;
  for (std::size_t face = 0; face < counts.faces; ++face) {
    toNextRow(text, "faces", counts.faces);
    readPolygon(text, polygons);
  }
  polygons.cut(mesh, {file.name, FilePlace::line, 0}, file.options.keep_wrong_indices, file.passed_over);
  return mesh;
}

}  // namespace palpate::mesh
