// STL, binary and text: a soup of triangles, welded while it is read.
//
// A file is binary when its length is what its own count promises (84 + 50 per triangle), even if it starts with
// "solid" as many binary files do; otherwise it is text when it starts with "solid" or "facet", in capitals or not, and
// has no byte that cannot be text where a binary file has its first triangles; otherwise it is binary. Bytes behind the
// promised triangles are passed over, which is reported; fewer than promised are refused.
#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/byte_reader.h"
#include "palpate/mesh/files/detail/polygons.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"
#include "palpate/mesh/weld.h"

namespace palpate::mesh {

namespace {

constexpr std::size_t kCountOffset = 80;
constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes of attributes
constexpr std::size_t kCornersOffset = 12;  // the normal is not read: the winding is more reliable
constexpr std::size_t kTrianglesPerReport = std::size_t{1} << 17;
/// Shortest text of a triangle: "facet normal 0 0 0 outer loop" and so on, well below what any writer makes.
constexpr std::size_t kMinTextBytes = 80;

bool looksLikeText(std::string_view bytes) {
  constexpr std::size_t kLooked = 512;  // a binary file's count and floats have control bytes here
  const std::string_view text = trimmed(withoutByteOrderMark(bytes).substr(0, kLooked));
  const bool begins = isWord(text.substr(0, 5), "solid") || isWord(text.substr(0, 5), "facet");
  return begins && std::none_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < ' ' &&
                  std::string_view("\t\r\n\v\f").find(c) == std::string_view::npos;
         });
}

/// May exceed 32 bits, when the count is false.
std::uint64_t promisedBytes(std::string_view bytes) {
  return kHeaderBytes + kTriangleBytes * std::uint64_t{numberFromBytes<std::uint32_t>(bytes.data() + kCountOffset)};
}

bool isBinary(std::string_view bytes) {
  return !looksLikeText(bytes) || (bytes.size() >= kHeaderBytes && bytes.size() == promisedBytes(bytes));
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
  std::vector<Vec3> extractPositions() { return weld_ ? welder_.extractPositions() : std::move(loose_); }

 private:
  bool weld_;
  ExactWelder welder_;
  std::vector<Vec3> loose_;
};

Vec3 cornerAt(const char* bytes) {
  return {numberFromBytes<float>(bytes), numberFromBytes<float>(bytes + 4), numberFromBytes<float>(bytes + 8)};
}

/// The number of triangles.
std::size_t checkBinarySize(const MeshFile& file) {
  if (file.bytes.size() < kHeaderBytes) {
    throw Error::atByte(file.name, file.bytes.size(), "the file ends within the 84 bytes of an STL header");
  }
  const std::uint64_t promised = promisedBytes(file.bytes);
  const auto count = (promised - kHeaderBytes) / kTriangleBytes;
  if (promised < file.bytes.size()) {
    file.passed_over.add(
        fmt::format("{} bytes after the {} triangles are skipped", file.bytes.size() - promised, count),
        static_cast<std::size_t>(promised), FilePlace::byte);
  }
  if (promised <= file.bytes.size()) return static_cast<std::size_t>(count);
  throw Error::atByte(file.name, kCountOffset,
                      fmt::format("not an STL file, or damaged: {} triangles need {} bytes, the file has {}", count,
                                  promised, file.bytes.size()));
}

TriangleMesh readBinary(const MeshFile& file) {
  const std::size_t count = checkBinarySize(file);
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
  mesh.positions = corners.extractPositions();
  return mesh;
}

class TextStl {
 public:
  explicit TextStl(const MeshFile& file)
      : file_(file),
        text_(file.bytes, file.name, file.progress),
        corners_(file.bytes.size() / kMinTextBytes, file.options.weld.value_or(true)) {}

  /// The name behind "solid" and "endsolid" is free text to the end of the line.
  TriangleMesh read() {
    mesh_.triangles.reserve(file_.bytes.size() / kMinTextBytes);
    bool within = false;
    for (auto word = text_.wordAnywhere(); !word.empty(); word = text_.wordAnywhere()) {
      if (isWord(word, "facet")) {
        within = true;
        readFacet();
        continue;
      }
      const bool ends = isWord(word, "endsolid");
      if (ends || isWord(word, "solid")) {
        within = !ends;
      } else {  // a colour, say
        file_.passed_over.add(fmt::format("'{}' is not an STL keyword; the line is skipped", shown(word)),
                              text_.line());
      }
      text_.nextLine();
    }
    if (within) text_.fail("the file ends before 'endsolid'");
    mesh_.positions = corners_.extractPositions();
    polygons_.cut(mesh_, {file_.name, FilePlace::line, 1}, false, file_.passed_over);
    return std::move(mesh_);
  }

 private:
  void expect(std::string_view keyword) {
    const auto word = text_.wordAnywhere();
    if (word.empty()) text_.fail(fmt::format("the file ends where '{}' is expected", keyword));
    if (!isWord(word, keyword)) text_.fail(fmt::format("'{}' is expected, not '{}'", keyword, shown(word)));
  }

  /// The normal is not used, whatever it is: "nan(ind)" of Windows, or missing.
  void passOverNormal() {
    constexpr int kMaxWords = 4;  // "normal" and three numbers
    for (int words = 0; words <= kMaxWords; ++words) {
      const auto word = text_.wordAnywhere();
      if (isWord(word, "outer")) return;
      if (word.empty() || words == kMaxWords) text_.fail(fmt::format("'outer' is expected, not '{}'", shown(word)));
    }
  }

  /// The words behind "facet" up to "endfacet". The format has triangles only; others are accepted.
  void readFacet() {
    const std::size_t line = text_.line();
    passOverNormal();
    expect("loop");
    loop_.clear();
    for (auto word = text_.wordAnywhere(); !isWord(word, "endloop"); word = text_.wordAnywhere()) {
      if (word.empty()) text_.fail("the file ends where 'endloop' is expected");
      if (!isWord(word, "vertex")) text_.fail(fmt::format("'vertex' is expected, not '{}'", shown(word)));
      Vec3& corner = loop_.emplace_back();
      for (double& value : corner) value = text_.number(text_.wordAnywhere(), "a coordinate");
    }
    expect("endfacet");
    checkTriangleCount(mesh_.triangles.size(), file_.name);
    if (loop_.size() == 3) {
      const Index a = corners_.add(loop_[0]);
      const Index b = corners_.add(loop_[1]);
      const Index c = corners_.add(loop_[2]);
      mesh_.triangles.push_back({a, b, c});
      return;
    }
    for (const Vec3& corner : loop_) polygons_.addCorner(corners_.add(corner));
    polygons_.close(line);
  }

  const MeshFile& file_;
  TextReader text_;
  Corners corners_;
  TriangleMesh mesh_;
  PolygonList polygons_;
  std::vector<Vec3> loop_;
};

}  // namespace

TriangleMesh readStl(const MeshFile& file) { return isBinary(file.bytes) ? readBinary(file) : TextStl(file).read(); }

}  // namespace palpate::mesh
