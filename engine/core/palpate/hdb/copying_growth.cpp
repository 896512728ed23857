// Grows a tree with case A or B: a triangle that a plane crosses continues in both children, cut in pieces (A) or whole
// (B).
//
// Copies can multiply without end: slivers that cross every plane, coincident triangles, the triangles around a vertex.
// So each node has an allowance of entries, which its children share by their number; where they would need more,
// the node stays a leaf.
//
// Data flow: mesh -> here -> the tree in a Growth -> finishPartition (partition.cpp). At load time.
// Based on: Ji, dissertation 2008, 3.3.2; Sutherland, Hodgman, "Reentrant polygon clipping" (1974) for the cut.
#include "palpate/hdb/copying_growth.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/hdb/detail/growth.h"

namespace palpate::hdb {

// ---- cutting one triangle -------------------------------------------------------------------------------------------

namespace {

/// Where the edge meets the plane, which it crosses. The corner below the plane comes first, so that both directions
/// of an edge give the same bits.
Vec3 meetingPoint(const Vec3& below, const Vec3& above, const AxisPlane& plane) {
  const double down = plane.at - below[plane.axis];
  const double up = above[plane.axis] - plane.at;
  Vec3 point = below + (down / (down + up)) * (above - below);
  point[plane.axis] = plane.at;
  return point;
}

struct Polygon {
  std::array<Vec3, 4> corners;  // a triangle cut once has at most four
  int count = 0;
  void add(const Vec3& corner) { corners[count++] = corner; }
};

}  // namespace

Pieces clip(const std::array<Vec3, 3>& triangle, const AxisPlane& plane, bool positive) {
  const double sign = positive ? 1.0 : -1.0;
  Polygon kept;
  for (int i = 0; i < 3; ++i) {
    const Vec3& from = triangle[i];
    const Vec3& to = triangle[(i + 1) % 3];
    const double from_side = sign * (from[plane.axis] - plane.at);
    const double to_side = sign * (to[plane.axis] - plane.at);
    if (from_side >= 0.0) kept.add(from);
    const bool crosses = (from_side > 0.0 && to_side < 0.0) || (from_side < 0.0 && to_side > 0.0);
    if (!crosses) continue;
    const bool from_below = from[plane.axis] < plane.at;
    kept.add(from_below ? meetingPoint(from, to, plane) : meetingPoint(to, from, plane));
  }
  Pieces pieces;
  for (int i = 2; i < kept.count; ++i) {
    pieces.triangles[pieces.count++] = {kept.corners[0], kept.corners[i - 1], kept.corners[i]};
  }
  return pieces;
}

// ---- growing the tree -----------------------------------------------------------------------------------------------

namespace {

/// Case B decides by the vertices' extreme coordinates, which are the box's.
struct WholeTriangle {
  Box3 box;
  Index triangle;

  static WholeTriangle of(const Piece& corners, Index triangle) {
    WholeTriangle whole{Box3(corners[0]), triangle};
    whole.box.extend(corners[1]).extend(corners[2]);
    return whole;
  }
  /// No plane can separate triangles with equal boxes.
  bool sameAs(const WholeTriangle& other) const { return box.min() == other.box.min() && box.max() == other.box.max(); }
  void divide(const AxisPlane& plane, std::vector<WholeTriangle>& negative,
              std::vector<WholeTriangle>& positive) const {
    if (box.min()[plane.axis] < plane.at) negative.push_back(*this);
    if (box.max()[plane.axis] >= plane.at) positive.push_back(*this);  // E9
  }
  void addTo(Growth& growth) const { growth.items.push_back({box.center(), triangle, 0}); }
};

struct CutTriangle {
  Piece corners;
  Index triangle;

  static CutTriangle of(const Piece& corners, Index triangle) { return {corners, triangle}; }
  bool sameAs(const CutTriangle& other) const { return corners == other.corners; }

  void divide(const AxisPlane& plane, std::vector<CutTriangle>& negative, std::vector<CutTriangle>& positive) const {
    const auto above = [&](const Vec3& corner) { return corner[plane.axis] >= plane.at; };
    if (above(corners[0]) && above(corners[1]) && above(corners[2])) {
      positive.push_back(*this);  // also the one that lies in the plane (E9), so that no area is kept twice
      return;
    }
    append(clip(corners, plane, false), negative);
    append(clip(corners, plane, true), positive);
  }
  void addTo(Growth& growth) const {
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    growth.items.push_back({middle, triangle, static_cast<Index>(growth.pieces.size())});
    growth.pieces.push_back(corners);
  }

 private:
  void append(const Pieces& pieces, std::vector<CutTriangle>& side) const {
    for (int i = 0; i < pieces.count; ++i) side.push_back({pieces.triangles[i], triangle});
  }
};

template <class Part>
class CopyingGrowth {
 public:
  explicit CopyingGrowth(Growth& growth) : growth_(growth) {}

  /// `allowance`: the most entries that the node may end up with. `share`: of the mesh, for the progress.
  void grow(Index node, std::vector<Part> parts, double allowance, double share) {
    const int level = growth_.nodes[node].level;
    const bool small = parts.size() <= growth_.most_in_leaf;
    if (small || level >= mostLevels(growth_.tree) || allSame(parts)) {
      fillLeaf(node, parts, share);
      return;
    }
    Children children = divide(node, parts);
    if (static_cast<double>(children.total) > allowance) {
      fillLeaf(node, parts, share);
      return;
    }
    parts = {};  // the path down holds one level's children, not its parents' too
    const Index first = addChildren(growth_, node, children.slots);
    for (Index i = 0; i < children.parts.size(); ++i) {
      const double part = static_cast<double>(children.parts[i].size()) / static_cast<double>(children.total);
      grow(first + i, std::move(children.parts[i]), allowance * part, share * part);
    }
  }

 private:
  struct Children {
    std::vector<std::vector<Part>> parts;  // none of them empty
    std::vector<std::uint8_t> slots;
    std::size_t total = 0;
  };
  using Halves = std::array<std::vector<Part>, 2>;

  static bool allSame(const std::vector<Part>& parts) {
    return std::ranges::all_of(parts, [&](const Part& part) { return part.sameAs(parts.front()); });
  }

  void fillLeaf(Index node, const std::vector<Part>& parts, double share) {
    const std::size_t first = growth_.items.size();
    for (const Part& part : parts) part.addTo(growth_);
    makeLeaf(growth_, node, first, parts.size(), share);
  }

  static Halves halve(const std::vector<Part>& parts, int axis, const Vec3& at) {
    Halves halves;
    for (const Part& part : parts) part.divide({axis, at[axis]}, halves[0], halves[1]);
    return halves;
  }

  Children divide(Index node, const std::vector<Part>& parts) const {
    Children children;
    const auto append = [&](std::vector<Part>&& part, int slot) {
      if (part.empty()) return;
      children.total += part.size();
      children.parts.push_back(std::move(part));
      children.slots.push_back(static_cast<std::uint8_t>(slot));
    };
    divideAmongChildren(growth_, node, parts, halve, append);
    return children;
  }

  Growth& growth_;
};

template <class Part>
void growCopying(Growth& growth, const mesh::TriangleMesh& mesh) {
  std::vector<Part> parts;
  parts.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    parts.push_back(Part::of({mesh.positions[a], mesh.positions[b], mesh.positions[c]}, t));
  }
  const double allowance = kMaxEntriesPerTriangle * static_cast<double>(parts.size());
  CopyingGrowth<Part>(growth).grow(0, std::move(parts), allowance, 1.0);
}

}  // namespace

void growWithBothSides(Growth& growth, const mesh::TriangleMesh& mesh) { growCopying<WholeTriangle>(growth, mesh); }

void growWithCuts(Growth& growth, const mesh::TriangleMesh& mesh) { growCopying<CutTriangle>(growth, mesh); }

}  // namespace palpate::hdb
