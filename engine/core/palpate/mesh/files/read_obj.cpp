// OBJ: `v`, `f`, `g` and `o` are read, `vt` on request; normals and materials are passed over; lines, points, free-form
// curves and surfaces and unknown words too, which is reported.
//
// An OBJ face names vertices and places in the picture apart. Where the texture is requested, each corner of a face
// becomes a vertex of its own, with both.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/polygons.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"

namespace palpate::mesh {

namespace {

/// Keywords that carry nothing for a triangle surface.
constexpr auto kNoSurface = std::to_array<std::string_view>(
    {"vt",    "vn",     "vp",  "s",    "usemtl", "mtllib",     "usemap",    "maplib",  "l",
     "p",     "cstype", "deg", "curv", "curv2",  "parm",       "trim",      "hole",    "scrv",
     "sp",    "end",    "con", "bmat", "step",   "bevel",      "c_interp",  "lod",     "mg",
     "ctech", "stech",  "csh", "cdc",  "res",    "shadow_obj", "trace_obj", "d_interp"});
/// Keywords that carry a surface which is not read.
constexpr auto kOtherSurfaces = std::to_array<std::string_view>({"surf", "bzp", "bsp", "cdp", "call"});

/// Keywords that are not read although they are shape.
struct Shape {
  std::string_view keyword;
  std::string_view what;
};
constexpr auto kShapes =
    std::to_array<Shape>({{"l", "lines"}, {"p", "points"}, {"curv", "free-form curves"}, {"cdc", "free-form curves"}});

class ObjReader {
 public:
  ObjReader(const MeshFile& file, TexturePlaces* places)
      : file_(file), text_(file.bytes, file.name, file.progress, {'#', true}), places_(places) {}

  TriangleMesh read() {
    do {
      readLine();
    } while (text_.nextLine());
    if (!file_.options.group.empty() && !group_found_) failForGroup();
    if (polygons_.empty()) failForNoFace();
    if (places_ != nullptr) spreadCorners();
    polygons_.cut(mesh_, {file_.name, FilePlace::line, 1}, file_.options.keep_wrong_indices, file_.passed_over);
    return std::move(mesh_);
  }

 private:
  void readLine() {
    const auto keyword = text_.word();
    if (keyword.empty()) return;
    const auto is = [keyword](std::string_view word) { return isWord(keyword, word); };
    if (is("v")) {
      readVertex();
    } else if (is("f") || is("fo")) {
      readFace();
    } else if (is("g")) {
      in_group_ = readGroupLine();
    } else if (is("o")) {
      in_object_ = readGroupLine();
    } else if (is("vt") && places_ != nullptr) {
      readTexturePlace();
    } else if (std::any_of(kOtherSurfaces.begin(), kOtherSurfaces.end(), is)) {
      passOver(fmt::format("'{}' defines a surface, which is not supported; only faces are read", shown(keyword)));
    } else if (std::none_of(kNoSurface.begin(), kNoSurface.end(), is)) {
      if (first_unknown_.empty()) first_unknown_ = keyword;
      if (unknown_line_ == 0) unknown_line_ = text_.line();
      passOver(fmt::format("'{}' is not an OBJ keyword; the line is skipped", shown(keyword)));
    } else {
      reportShape(keyword);
    }
  }

  void reportShape(std::string_view keyword) {
    for (const Shape& shape : kShapes) {
      if (isWord(keyword, shape.keyword)) file_.passed_over.leaveOut(shape.what);
    }
  }

  void passOver(std::string_view what) { file_.passed_over.add(what, text_.line()); }

  void readVertex() {
    Vec3 position;
    for (double& value : position) value = text_.number(text_.word(), "a coordinate");
    mesh_.positions.push_back(position);
    if (mesh_.positions.size() >= kNoIndex) text_.fail("too many vertices for 32-bit indices");
    std::size_t more = 0;
    bool are_numbers = true;
    for (auto word = text_.word(); !word.empty(); word = text_.word(), ++more) {
      are_numbers &= word.find_first_not_of("0123456789+-.eEnaifNAIF") == std::string_view::npos;
    }
    // A weight, a colour, or both.
    if (!are_numbers || more == 2 || more > 4) passOver("values after a vertex's coordinates are skipped");
  }

  /// `vt u [v [w]]`. Where it is not a number, the place is not finite.
  void readTexturePlace() {
    const auto u = static_cast<float>(numberOrNone(text_.word()));
    const std::string_view v = text_.word();
    texture_.emplace_back(u, v.empty() ? 0.0f : static_cast<float>(numberOrNone(v)));
  }

  /// The line of a group or object: several names, or one with blanks in it. Groups continue through objects, and
  /// objects through groups.
  bool readGroupLine() {
    bool is_named = text_.restOfLine() == file_.options.group;
    for (auto name = text_.nameWord(); !name.empty(); name = text_.nameWord()) {
      is_named |= name == file_.options.group;
      if (groups_.size() < kMaxGroupsShown) groups_.emplace(name, groups_.size());
    }
    group_found_ |= is_named;
    return is_named;
  }

  void readFace() {
    const std::size_t line = text_.line();
    for (auto corner = text_.word(); !corner.empty(); corner = text_.word()) {
      polygons_.addCorner(places_ == nullptr ? readCorner(corner) : newCorner(corner));
    }
    if (file_.options.group.empty() || in_group_ || in_object_) {
      polygons_.close(line);
    } else {
      polygons_.dropOpen();
    }
  }

  /// `vertex`, `vertex/texture`, `vertex//normal` or all three; negative counts back from the last vertex.
  Index readCorner(std::string_view corner) const {
    return fromZero(corner.substr(0, corner.find('/')), "vertex", mesh_.positions.size());
  }

  Index fromZero(std::string_view word, std::string_view what, std::size_t so_far) const {
    const auto index = text_.whole(word, fmt::format("a {} index", what), -kHighest, kHighest);
    if (index == 0) text_.fail(fmt::format("{} indices start at 1", what));
    if (index > 0) return static_cast<Index>(index - 1);
    const auto from_start = static_cast<long long>(so_far) + index;
    return from_start < 0 ? kNoIndex : static_cast<Index>(from_start);
  }

  /// Notes the two numbers of a corner; what they name may still follow. The number of the corner.
  Index newCorner(std::string_view corner) {
    const Index vertex = readCorner(corner);
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    const std::string_view rest = corner.substr(std::min(slash + 1, corner.size()));
    const std::string_view texture = rest.substr(0, rest.find('/'));
    const bool has_texture = texture.find_first_of("123456789") != std::string_view::npos;
    corners_.push_back({vertex, has_texture ? fromZero(texture, "texture", texture_.size()) : kNoIndex});
    if (corners_.size() >= kNoIndex) text_.fail("more corners than 32-bit indices can name");
    return static_cast<Index>(corners_.size() - 1);
  }

  /// Each corner becomes a vertex. One that names a missing vertex or texture gets a place that is not finite.
  void spreadCorners() {
    const std::vector<Vec3> positions = std::exchange(mesh_.positions, {});
    mesh_.positions.reserve(corners_.size());
    places_->reserve(corners_.size());
    for (const Corner& corner : corners_) {
      const bool is_there = corner.vertex < positions.size() && corner.texture < texture_.size();
      mesh_.positions.push_back(is_there ? positions[corner.vertex] : Vec3::Zero());
      places_->push_back(is_there ? texture_[corner.texture] : noTexturePlace());
    }
  }

  [[noreturn]] void failForGroup() const {
    std::string names;
    for (const auto& [name, order] : groups_) names += (names.empty() ? "" : ", ") + shown(name);
    throw Error::inFile(file_.name, fmt::format("no group or object '{}'; {}", file_.options.group,
                                                names.empty() ? "the file has none" : "there are: " + names));
  }

  [[noreturn]] void failForNoFace() const {
    if (!file_.options.group.empty()) {
      throw Error::inFile(file_.name, fmt::format("the group or object '{}' has no faces", file_.options.group));
    }
    if (unknown_line_ == 0) throw Error::inFile(file_.name, "the file has no triangles");
    throw Error::atLine(
        file_.name, unknown_line_,
        fmt::format("'{}' is not an OBJ keyword, and the file has no faces after it", shown(first_unknown_)));
  }

  static constexpr long long kHighest = 0xfffffffe;
  static constexpr std::size_t kMaxGroupsShown = 12;

  struct Corner {
    Index vertex;
    Index texture;
  };

  const MeshFile& file_;
  TextReader text_;
  TexturePlaces* places_;  // null: not requested
  TexturePlaces texture_;  // `vt` so far
  std::vector<Corner> corners_;
  TriangleMesh mesh_;
  PolygonList polygons_;
  std::map<std::string_view, std::size_t> groups_;
  std::string_view first_unknown_;
  std::size_t unknown_line_ = 0;
  bool in_group_ = false;
  bool in_object_ = false;
  bool group_found_ = false;
};

}  // namespace

TriangleMesh readObj(const MeshFile& file, TexturePlaces* places) { return ObjReader(file, places).read(); }

}  // namespace palpate::mesh
