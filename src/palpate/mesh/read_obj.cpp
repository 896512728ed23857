// OBJ: `v`, `f`, `g` and `o` are read; texture, normals, materials, lines, points and free-form surfaces are passed
// over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "palpate/base/error.h"
#include "palpate/mesh/polygons.h"
#include "palpate/mesh/readers.h"
#include "palpate/mesh/text_reader.h"

namespace palpate::mesh {

namespace {

/// Keywords that carry nothing for a triangle surface. A word that is in neither list makes the file no OBJ file.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vt",     "vn",   "vp",   "s",          "usemtl",    "mtllib",   "usemap",   "maplib", "l",    "p",
     "cstype", "deg",  "curv", "curv2",      "surf",      "parm",     "trim",     "hole",   "scrv", "sp",
     "end",    "con",  "bmat", "step",       "bevel",     "c_interp", "d_interp", "lod",    "mg",   "ctech",
     "stech",  "call", "csh",  "shadow_obj", "trace_obj", "bsp",      "bzp",      "cdc",    "cdp",  "res"});

class ObjReader {
 public:
  explicit ObjReader(const MeshFile& file) : file_(file), text_(file.bytes, file.name, file.progress) {}

  TriangleMesh read() {
    do {
      readLine();
    } while (text_.nextLine());
    if (!file_.options.group.empty() && !group_found_) failForGroup();
    polygons_.cut(mesh_, {file_.name, FileCounting::Place::line, 1}, file_.options.keep_wrong_indices);
    return std::move(mesh_);
  }

 private:
  void readLine() {
    const auto keyword = text_.word();
    if (keyword.empty() || keyword.front() == '#') return;
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "f") {
      readFace();
    } else if (keyword == "g" || keyword == "o") {
      readGroup();
    } else if (std::find(kPassedOver.begin(), kPassedOver.end(), keyword) == kPassedOver.end()) {
      text_.fail(fmt::format("'{}' is not an OBJ keyword", shown(keyword)));
    } else {
      passOver();
    }
  }

  /// A line that ends in a backslash goes on in the next one.
  void passOver() {
    while (text_.restOfLine().ends_with('\\') && text_.nextLine()) {
    }
  }

  std::string_view word() {
    auto found = text_.word();
    while (found == "\\" && text_.nextLine()) found = text_.word();
    return found;
  }

  void readVertex() {
    Vec3 position;
    for (double& value : position) value = text_.number(word(), "a coordinate");
    mesh_.positions.push_back(position);
    passOver();  // a weight or a colour may follow
    if (mesh_.positions.size() >= kNoIndex) text_.fail("more vertices than 32-bit indices can name");
  }

  void readGroup() {
    in_group_ = false;
    for (auto name = word(); !name.empty(); name = word()) {
      in_group_ |= name == file_.options.group;
      if (groups_.size() < kMaxGroupsShown) groups_.emplace(name, groups_.size());
    }
    group_found_ |= in_group_;
  }

  void readFace() {
    for (auto corner = word(); !corner.empty() && corner.front() != '#'; corner = word()) {
      polygons_.addCorner(readCorner(corner));
    }
    if (polygons_.openCorners() < 3) text_.fail("a face needs at least 3 corners");
    if (file_.options.group.empty() || in_group_) {
      polygons_.close(text_.line());
    } else {
      polygons_.dropOpen();
    }
  }

  /// `vertex`, `vertex/texture`, `vertex//normal` or all three; negative counts back from the last vertex.
  Index readCorner(std::string_view corner) const {
    const auto index = text_.whole(corner.substr(0, corner.find('/')), "a vertex index", -kHighest, kHighest);
    if (index == 0) text_.fail("vertex indices start at 1");
    if (index > 0) return static_cast<Index>(index - 1);
    const auto from_start = static_cast<long long>(mesh_.positions.size()) + index;
    return from_start < 0 ? kNoIndex : static_cast<Index>(from_start);
  }

  [[noreturn]] void failForGroup() const {
    std::string names;
    for (const auto& [name, order] : groups_) names += (names.empty() ? "" : ", ") + shown(name);
    throw Error::inFile(file_.name, fmt::format("no group or object '{}'; {}", file_.options.group,
                                                names.empty() ? "the file names none" : "there are: " + names));
  }

  static constexpr long long kHighest = 0xfffffffe;
  static constexpr std::size_t kMaxGroupsShown = 12;

  const MeshFile& file_;
  TextReader text_;
  TriangleMesh mesh_;
  PolygonList polygons_;
  std::map<std::string_view, std::size_t> groups_;
  bool in_group_ = false;
  bool group_found_ = false;
};

}  // namespace

TriangleMesh readObj(const MeshFile& file) { return ObjReader(file).read(); }

}  // namespace palpate::mesh
