// OBJ: `v`, `f`, `g` and `o` are read, `vt` when it is asked for; normals and materials are passed over; lines, points
// and free-form surfaces are left out and told.
//
// An OBJ face names vertices and places in the picture apart. Where the texture is asked for, each corner of a face
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

/// Keywords that carry nothing for a triangle surface. A word that is in neither list makes the file no OBJ file.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vt",     "vn",   "vp",   "s",          "usemtl",    "mtllib",   "usemap",   "maplib", "l",    "p",
     "cstype", "deg",  "curv", "curv2",      "surf",      "parm",     "trim",     "hole",   "scrv", "sp",
     "end",    "con",  "bmat", "step",       "bevel",     "c_interp", "d_interp", "lod",    "mg",   "ctech",
     "stech",  "call", "csh",  "shadow_obj", "trace_obj", "bsp",      "bzp",      "cdc",    "cdp",  "res"});

struct LeftOutWord {
  std::string_view keyword;
  std::string_view what;
};
/// Of the words above, those that are shape. Free-form curves and surfaces have a newer and an older spelling.
constexpr auto kLeftOut = std::to_array<LeftOutWord>({{"l", "lines"},
                                                      {"p", "points"},
                                                      {"curv", "free-form curves"},
                                                      {"surf", "free-form surfaces"},
                                                      {"cdc", "free-form curves"},
                                                      {"cdp", "free-form surfaces"},
                                                      {"bzp", "free-form surfaces"},
                                                      {"bsp", "free-form surfaces"}});

class ObjReader {
 public:
  ObjReader(const MeshFile& file, TexturePlaces* places)
      : file_(file), text_(file.bytes, file.name, file.progress), places_(places) {}

  TriangleMesh read() {
    do {
      readLine();
    } while (text_.nextLine());
    if (!file_.options.group.empty() && !group_found_) failForGroup();
    if (places_ != nullptr) spreadCorners();
    polygons_.cut(mesh_, {file_.name, FilePlace::line, 1}, file_.options.keep_wrong_indices, file_.passed_over);
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
    } else if (keyword == "vt" && places_ != nullptr) {
      readTexturePlace();
    } else if (std::find(kPassedOver.begin(), kPassedOver.end(), keyword) == kPassedOver.end()) {
      text_.fail(fmt::format("'{}' is not an OBJ keyword", shown(keyword)));
    } else {
      tellOf(keyword);
      passOver();
    }
  }

  void tellOf(std::string_view keyword) const {
    for (const LeftOutWord& word : kLeftOut) {
      if (word.keyword == keyword) file_.passed_over.leaveOut(word.what);
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

  /// `vt u [v [w]]`
  void readTexturePlace() {
    const auto u = static_cast<float>(text_.number(word(), "a texture coordinate"));
    const std::string_view v = word();
    texture_.emplace_back(
        u, v.empty() || v.front() == '#' ? 0.0f : static_cast<float>(text_.number(v, "a texture coordinate")));
    passOver();
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
      polygons_.addCorner(places_ == nullptr ? readCorner(corner) : newCorner(corner));
    }
    if (file_.options.group.empty() || in_group_) {
      polygons_.close(text_.line());
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
    corners_.push_back({vertex, texture.empty() ? kNoIndex : fromZero(texture, "texture", texture_.size())});
    if (corners_.size() >= kNoIndex) text_.fail("more corners than 32-bit indices can name");
    return static_cast<Index>(corners_.size() - 1);
  }

  /// Each corner becomes a vertex. One that names a vertex or a texture that is not there gets a place that is no
  /// number.
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
                                                names.empty() ? "the file names none" : "there are: " + names));
  }

  static constexpr long long kHighest = 0xfffffffe;
  static constexpr std::size_t kMaxGroupsShown = 12;

  struct Corner {
    Index vertex;
    Index texture;
  };

  const MeshFile& file_;
  TextReader text_;
  TexturePlaces* places_;  // null: not asked for
  TexturePlaces texture_;  // `vt` so far
  std::vector<Corner> corners_;
  TriangleMesh mesh_;
  PolygonList polygons_;
  std::map<std::string_view, std::size_t> groups_;
  bool in_group_ = false;
  bool group_found_ = false;
};

}  // namespace

TriangleMesh readObj(const MeshFile& file, TexturePlaces* places) { return ObjReader(file, places).read(); }

}  // namespace palpate::mesh
