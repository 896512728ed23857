// STL, binary and text: a soup of triangles, welded while it is read.
//
// A file is binary when its length is what its own count promises (84 + 50 per triangle), even if it starts with
// "solid" as many binary files do; otherwise it is text when it starts with "solid"; otherwise it is binary and broken.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "palpate/mesh/files/detail/byte_reader.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"
#include "palpate/mesh/weld.h"

namespace palpate::mesh {

namespace {

constexpr std::size_t kCountOffset = 80;
constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes of attributes
constexpr std::size_t kCornersOffset = 12;  // the normal is not read: the winding says it better
constexpr std::size_t kTrianglesPerReport = std::size_t{1} << 17;
/// Shortest text of a triangle: "facet normal 0 0 0 outer loop" and so on, well below what any writer makes.
constexpr std::size_t kMinTextBytes = 80;

bool startsWithSolid(std::string_view bytes) {
  const auto start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes.substr(start, 5) == "solid";
}

/// More than 32 bits hold, when the count is a lie.
std::uint64_t promisedBytes(std::string_view bytes) {
  return kHeaderBytes + kTriangleBytes * std::uint64_t{numberFromBytes<std::uint32_t>(bytes.data() + kCountOffset)};
}

bool isBinary(std::string_view bytes) {
  return !startsWithSolid(bytes) || (bytes.size() >= kHeaderBytes && bytes.size() == promisedBytes(bytes));
}

/// Joins equal corners while they come in, or just numbers them.
class Corners {
 public:
  Corners(std::size_t expected_triangles, bool weld) : weld_(weld), welder_(weld ? expected_triangles / 2 : 0) {}
  Index add(const Vec3& position) {
    if (weld_) return welder_.add(position);
    loose_.push_back(position);
    return static_cast<Index>(loose_.size() - 1);
  }
  void prepare(const Vec3& position) const {
    if (weld_) welder_.prepare(position);
  }
  std::vector<Vec3> takePositions() { return weld_ ? welder_.takePositions() : std::move(loose_); }

 private:
  bool weld_;
  ExactWelder welder_;
  std::vector<Vec3> loose_;
};

Vec3 cornerAt(const char* bytes) {
  return {numberFromBytes<float>(bytes), numberFromBytes<float>(bytes + 4), numberFromBytes<float>(bytes + 8)};
}

void checkBinarySize(const MeshFile& file) {
  if (file.bytes.size() < kHeaderBytes) {
    throw Error::atByte(file.name, file.bytes.size(), "the file ends within the 84 bytes of an STL header");
  }
  const std::uint64_t promised = promisedBytes(file.bytes);
  if (promised == file.bytes.size()) return;
  const auto count = (promised - kHeaderBytes) / kTriangleBytes;
  throw Error::atByte(file.name, kCountOffset,
                      fmt::format("not an STL file, or damaged: {} triangles need {} bytes, the file has {}", count,
                                  promised, file.bytes.size()));
}

TriangleMesh readBinary(const MeshFile& file) {
  checkBinarySize(file);
  const std::size_t count = (file.bytes.size() - kHeaderBytes) / kTriangleBytes;
  checkTriangleCount(count, file.name);
  TriangleMesh mesh;
  mesh.triangles.reserve(count);
  Corners corners(count, file.options.weld.value_or(true));
  const char* bytes = file.bytes.data() + kHeaderBytes + kCornersOffset;
  constexpr std::size_t kAhead = ExactWelder::kAhead / 2;  // triangles
  for (std::size_t t = 0; t < count; ++t, bytes += kTriangleBytes) {
    for (const std::size_t corner : {0, 12, 24}) {
      if (t + kAhead < count) corners.prepare(cornerAt(bytes + kAhead * kTriangleBytes + corner));
    }
    const Index a = corners.add(cornerAt(bytes));
    const Index b = corners.add(cornerAt(bytes + 12));
    const Index c = corners.add(cornerAt(bytes + 24));
    mesh.triangles.push_back({a, b, c});
    if (t % kTrianglesPerReport == 0) report(file.progress, "reading", static_cast<double>(t) / count);
  }
  mesh.positions = corners.takePositions();
  return mesh;
}

/// Keywords of text STL come in either case.
bool sameWord(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void expect(TextReader& text, std::string_view keyword) {
  const auto word = text.wordAnywhere();
  if (word.empty()) text.fail(fmt::format("the file ends where '{}' is expected", keyword));
  if (!sameWord(word, keyword)) text.fail(fmt::format("'{}' is expected, not '{}'", keyword, shown(word)));
}

Vec3 readThree(TextReader& text, std::string_view what) {
  Vec3 result;
  for (double& value : result) value = text.number(text.wordAnywhere(), what);
  return result;
}

/// The words after "facet" up to "endfacet".
Triangle readFacet(TextReader& text, Corners& corners) {
  expect(text, "normal");
  readThree(text, "a normal");
  expect(text, "outer");
  expect(text, "loop");
  Triangle triangle;
  for (Index& corner : triangle) {
    expect(text, "vertex");
    corner = corners.add(readThree(text, "a coordinate"));
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  return triangle;
}

/// Facets up to "endsolid"; the name after "solid" and "endsolid" is free text to the end of the line.
void readSolid(TextReader& text, Corners& corners, TriangleMesh& mesh, std::string_view name) {
  text.nextLine();
  while (true) {
    const auto word = text.wordAnywhere();
    if (word.empty()) text.fail("the file ends before 'endsolid'");
    if (sameWord(word, "endsolid")) break;
    if (!sameWord(word, "facet")) text.fail(fmt::format("'facet' is expected, not '{}'", shown(word)));
    checkTriangleCount(mesh.triangles.size(), name);
    mesh.triangles.push_back(readFacet(text, corners));
  }
  text.nextLine();
}

TriangleMesh readText(const MeshFile& file) {
  TriangleMesh mesh;
  const std::size_t most = file.bytes.size() / kMinTextBytes;
  mesh.triangles.reserve(most);
  Corners corners(most, file.options.weld.value_or(true));
  TextReader text(file.bytes, file.name, file.progress);
  for (auto word = text.wordAnywhere(); !word.empty(); word = text.wordAnywhere()) {
    if (!sameWord(word, "solid")) text.fail(fmt::format("'solid' is expected, not '{}'", shown(word)));
    readSolid(text, corners, mesh, file.name);
  }
  mesh.positions = corners.takePositions();
  return mesh;
}

}  // namespace

TriangleMesh readStl(const MeshFile& file) { return isBinary(file.bytes) ? readBinary(file) : readText(file); }

}  // namespace palpate::mesh
