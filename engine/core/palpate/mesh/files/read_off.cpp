// OFF, text: one vertex a line, one polygon a line. Colours, normals and texture behind the numbers are passed over.
//
// Based on: the description of Geomview, oogl "OFF Files".
#include <fmt/format.h>

#include <optional>
#include <string>

#include "palpate/base/text.h"
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
/// STCN4nOFF, and no more.
constexpr std::size_t kLongestHead = 9;
/// A file whose comments are longer is known by its extension alone.
constexpr std::size_t kLongestOffBeginning = 4096;

constexpr TextRules kOffRules = {.comment = '#'};

void toNextRow(TextReader& text, std::string_view what, std::size_t promised) {
  if (!text.nextFilledLine()) text.fail(fmt::format("the file ends before all its {} {} are there", promised, what));
}

std::string_view wordOfHead(TextReader& text) {
  const auto word = text.word();
  if (!word.empty()) return word;
  toNextRow(text, "counts", 2);
  return text.word();
}

/// The parsed first word: [ST][C][N][4][n]OFF.
struct OffHead {
  std::string_view count;  ///< the number of vertices, where it is glued to the word or replaces it
  bool has_more = false;   ///< colours, normals or texture behind the places
};

/// Empty where the word is not a head of OFF.
std::optional<OffHead> parseOffHead(std::string_view word) {
  const std::size_t off = inSmallLetters(word.substr(0, kLongestHead)).find("off");
  if (off == std::string::npos) return std::nullopt;
  std::string letters = inSmallLetters(word.substr(0, off));
  for (const std::string_view letter : {"st", "c", "n", "4", "n"}) {
    if (letters.starts_with(letter)) letters.erase(0, letter.size());
  }
  const std::string_view count = word.substr(off + 3);
  if (!letters.empty() || count.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return OffHead{count, off > 0};
}

OffHead readHead(TextReader& text) {
  const auto word = wordOfHead(text);
  const auto head = parseOffHead(word);
  // Geomview's description allows leaving out the word.
  if (!head && word.find_first_not_of("0123456789") == std::string_view::npos) return {word, false};
  if (!head) text.fail(fmt::format("'OFF' is expected, not '{}'", shown(word)));
  const std::string_view letters = word.substr(0, word.size() - head->count.size());
  if (letters.find('4') != std::string_view::npos) text.fail("OFF with a fourth coordinate (4OFF) cannot be read");
  if (letters.ends_with("nOFF")) {  // in small letters it is the space's dimension, in capitals a normal
    const auto dimension = wordOfHead(text);
    if (dimension != "3") text.fail(fmt::format("only OFF in 3 dimensions can be read, not in '{}'", shown(dimension)));
  }
  return *head;
}

/// The counts follow the keyword, glued to it or in the next lines.
Counts readCounts(TextReader& text, std::string_view glued) {
  if (isWord(text.restOfLine(), "binary")) text.fail("binary OFF cannot be read");
  const auto most = static_cast<long long>(text.bytesLeft());
  Counts counts;
  counts.vertices =
      static_cast<std::size_t>(text.whole(glued.empty() ? wordOfHead(text) : glued, "the number of vertices", 0,
                                          most / static_cast<long long>(kMinVertexBytes)));
  counts.faces = static_cast<std::size_t>(
      text.whole(wordOfHead(text), "the number of faces", 0, most / static_cast<long long>(kMinFaceBytes)));
  return counts;
}

std::size_t wordsLeft(TextReader& text) {
  std::size_t words = 0;
  while (!text.word().empty()) ++words;
  return words;
}

void readPolygon(TextReader& text, PolygonList& polygons) {
  const auto corners = text.whole(text.word(), "the number of corners", 0, static_cast<long long>(text.bytesLeft()));
  for (long long i = 0; i < corners; ++i) {
    polygons.addCorner(static_cast<Index>(text.whole(text.word(), "a vertex index", -1, kNoIndex)));
  }
  polygons.close(text.line());
}

}  // namespace

bool beginsAsOff(std::string_view bytes) {
  const Progress none;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return false;
  TextReader text(bytes.substr(0, kLongestOffBeginning), "", none, kOffRules);
  return parseOffHead(text.wordAnywhere()).has_value();
}

TriangleMesh readOff(const MeshFile& file) {
  constexpr std::size_t kColourWords = 4;
  TextReader text(file.bytes, file.name, file.progress, kOffRules);
  const OffHead head = readHead(text);
  const Counts counts = readCounts(text, head.count);
  TriangleMesh mesh;
  mesh.positions.resize(counts.vertices);
  for (Vec3& position : mesh.positions) {
    toNextRow(text, "vertices", counts.vertices);
    for (double& value : position) value = text.number(text.word(), "a coordinate");
    if (!head.has_more && wordsLeft(text) > 0) {
      file.passed_over.add("values after a vertex's coordinates are skipped", text.line());
    }
  }
  PolygonList polygons;
  for (std::size_t face = 0; face < counts.faces; ++face) {
    toNextRow(text, "faces", counts.faces);
    readPolygon(text, polygons);
    if (wordsLeft(text) > kColourWords) {
      file.passed_over.add("the row has values after the corners and the colour of its face; they are skipped",
                           text.line());
    }
  }
  while (text.nextFilledLine()) file.passed_over.add("a line after the last face is skipped", text.line());
  polygons.cut(mesh, {file.name, FilePlace::line, 0}, file.options.keep_wrong_indices, file.passed_over);
  return mesh;
}

}  // namespace palpate::mesh
