// A place of the surface is a local minimum of the distance to a point only if the way to the point lies within the
// cone of the normals around that place: round an edge or a corner the surface is a height field over the plane across
// the cone's axis, as steep as the cone is wide, and a way outside the cone leaves some direction downhill. So a child
// whose cone misses the point holds no foot. The normals around a place are those of all triangles at its corners,
// within the child or next to it; they are gathered per vertex first.
//
// Where the surface ends, folds over by more than 45 degrees or has triangles without area, nothing is excluded.
//
// Based on: Johnson and Cohen, "Spatialized normal cone hierarchies" (2001); Ericson (2005), 4.6 for slabs.
#include "palpate/tree/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "palpate/base/background.h"
#include "palpate/tree/closest_on_triangle.h"

namespace palpate::tree {

namespace {

/// Larger children have a box only: seen from a finger they are not flat.
constexpr Index kMaxTriangles = 1024;
/// Added to the sine of a spread: above the rounding of normals kept as floats, below half a step.
constexpr double kSineSlack = 1e-3;
/// Added to the top of a plate, in its steps: above the rounding of a query's floats.
constexpr double kTopSlack = 1e-3;

constexpr std::string_view kPlateStage = "building the tree";
/// Plates of fewer nodes take less than 0.1 s.
constexpr std::uint32_t kReportedNodes = 4096;

/// The normals of the triangles at a vertex: all within an angle of `axis`, given by its cosine; -1 for any.
struct NormalCone {
  Vec3f axis = Vec3f::Zero();
  float cosine = 1.0f;
};

Vec3 unitNormal(const TriangleRecord& record) {
  const auto& [a, b, c] = record.corners;
  const Vec3 normal = mesh::areaVector2(a, b, c);
  const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  if (!(normal.squaredNorm() > kSliverShare * longest2 * longest2)) return Vec3::Zero();
  return normal.stableNormalized();
}

/// Cones of all vertices of the mesh, in three passes of about 0.1 s a million triangles.
std::vector<NormalCone> conesOfVertices(const TriangleTree& tree, const Progress& progress) {
  Index vertices = 0;
  for (const TriangleRecord& record : tree.records) {
    for (const Index v : record.vertices) vertices = std::max(vertices, v + 1);
  }
  report(progress, kPlateStage, 0.0);
  std::vector<NormalCone> cones(vertices);
  for (const TriangleRecord& record : tree.records) {
    const Vec3f normal = unitNormal(record).cast<float>();
    for (const Index v : record.vertices) cones[v].axis += normal;
  }
  report(progress, kPlateStage, 0.0);
  for (NormalCone& cone : cones) cone.axis.stableNormalize();
  for (const TriangleRecord& record : tree.records) {
    const Vec3f normal = unitNormal(record).cast<float>();
    for (int i = 0; i < 3; ++i) {
      NormalCone& cone = cones[record.vertices[i]];
      cone.cosine = std::min(cone.cosine, cone.axis.dot(normal));
      if (record.neighbours[i] != kNoIndex) continue;
      cone.cosine = cones[record.vertices[(i + 1) % 3]].cosine = -1.0f;
    }
    if (!normal.isZero()) continue;
    for (const Index v : record.vertices) cones[v].cosine = -1.0f;
  }
  report(progress, kPlateStage, 0.0);
  return cones;
}

double sineFromCosine(double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); }

std::int8_t rounded(double value) { return static_cast<std::int8_t>(std::lround(value)); }

/// The two bytes of facingVector nearest to a direction (not zero).
std::array<std::int8_t, 2> facingBytes(const Vec3& direction) {
  const Vec3 on_octahedron = direction * (kFacingLength / direction.lpNorm<1>());
  double u = on_octahedron.x();
  double v = on_octahedron.y();
  if (on_octahedron.z() < 0.0) {
    u = std::copysign(kFacingLength - std::abs(on_octahedron.y()), on_octahedron.x());
    v = std::copysign(kFacingLength - std::abs(on_octahedron.x()), on_octahedron.y());
  }
  return {rounded(u), rounded(v)};
}

bool hasChild(const WideNode& node, int slot) { return node.low[0][slot] <= node.high[0][slot]; }

/// Records, one after the other.
struct RecordRange {
  Index begin = kNoIndex;
  Index end = 0;
};

RecordRange rangeBelow(const ChildLink& link, const std::vector<RecordRange>& of_nodes) {
  if (!link.isLeaf()) return of_nodes[link.node()];
  return {link.firstTriangle(), link.firstTriangle() + link.triangleCount()};
}

/// The records below each node; a node comes before those below it.
std::vector<RecordRange> rangesOfNodes(const TriangleTree& tree) {
  std::vector<RecordRange> ranges(tree.nodes.size());
  for (std::size_t index = tree.nodes.size(); index-- > 0;) {
    const WideNode& node = tree.nodes[index];
    for (int i = 0; i < kNodeWidth; ++i) {
      if (!hasChild(node, i)) continue;
      const RecordRange below = rangeBelow(node.children[i], ranges);
      ranges[index] = {std::min(ranges[index].begin, below.begin), std::max(ranges[index].end, below.end)};
    }
  }
  return ranges;
}

class PlateFiller {
 public:
  PlateFiller(TriangleTree& tree, const Progress& progress)
      : tree_(tree), progress_(progress), cones_(conesOfVertices(tree, progress)), ranges_(rangesOfNodes(tree)) {}

  /// The caller, who alone may report, begins with the first node.
  void fill(std::size_t begin, std::size_t end) {
    for (std::size_t index = begin; index < end; ++index) {
      if (begin == 0 && index % kReportedNodes == 0)
        report(progress_, kPlateStage, static_cast<double>(index) / static_cast<double>(end));
      WideNode& node = tree_.nodes[index];
      for (int i = 0; i < kNodeWidth; ++i) {
        setNoPlate(node, i);
        if (!hasChild(node, i)) continue;
        const RecordRange range = rangeBelow(node.children[i], ranges_);
        if (range.end - range.begin <= kMaxTriangles) setPlate(node, i, range);
      }
    }
  }

 private:
  static void setNoPlate(WideNode& node, int slot) {
    node.facing[0][slot] = node.facing[1][slot] = 0;
    node.top[slot] = kMaxTop;
    node.spread[slot] = kAnySpread;
  }

  void setPlate(WideNode& node, int slot, const RecordRange& range) const {
    Vec3 sum = Vec3::Zero();
    for (Index t = range.begin; t < range.end; ++t) {
      const auto& [a, b, c] = tree_.records[t].corners;
      sum += mesh::areaVector2(a, b, c);
    }
    sum.stableNormalize();
    if (!(sum.squaredNorm() > 0.5)) return;
    const auto [u, v] = facingBytes(sum);
    const auto facing = facingVector(u, v);
    const Vec3 axis = Vec3(facing[0], facing[1], facing[2]).normalized();
    const Vec3 low(node.low[0][slot], node.low[1][slot], node.low[2][slot]);
    const Vec3 high(node.high[0][slot], node.high[1][slot], node.high[2][slot]);
    const Vec3 middle = tree_.center + (0.5 / tree_.to_unit) * (low + high);
    double top = -std::numeric_limits<double>::infinity();  // mm
    double widest = 1.0;                                    // as a cosine
    for (Index t = range.begin; t < range.end; ++t) {
      const TriangleRecord& record = tree_.records[t];
      for (int i = 0; i < 3; ++i) {
        top = std::max(top, axis.dot(record.corners[i] - middle));
        widest = std::min(widest, cosineOfSpread(axis, cones_[record.vertices[i]]));
      }
    }
    node.facing[0][slot] = u;
    node.facing[1][slot] = v;
    node.top[slot] = topSteps(top * tree_.to_unit / (0.5 * (high - low).norm()));
    node.spread[slot] = encodeSpread(widest);
  }

  static std::int8_t topSteps(double share) {
    const double steps = std::ceil(kMaxTop * share + kTopSlack);
    return static_cast<std::int8_t>(std::clamp(steps, -1.0 * kMaxTop, 1.0 * kMaxTop));
  }

  /// Cosine of the widest angle from `axis` to a normal of the cone; -1 for any.
  static double cosineOfSpread(const Vec3& axis, const NormalCone& cone) {
    const double cosine = cone.cosine;
    const double between = axis.dot(cone.axis.cast<double>());
    if (cosine <= 0.0 || between <= 0.0) return -1.0;
    return cosine * between - sineFromCosine(cosine) * sineFromCosine(between);
  }

  static std::uint8_t encodeSpread(double cosine) {
    if (cosine <= 0.0) return kAnySpread;
    const double steps = std::ceil((sineFromCosine(cosine) + kSineSlack) / kSpreadStep);
    return steps < kAnySpread ? static_cast<std::uint8_t>(steps) : kAnySpread;
  }

  TriangleTree& tree_;
  const Progress& progress_;
  std::vector<NormalCone> cones_;
  std::vector<RecordRange> ranges_;
};

}  // namespace

void fillPlates(TriangleTree& tree, const Progress& progress) {
  PlateFiller filler(tree, progress);
  shareOut(tree.nodes.size(), kReportedNodes, [&](std::size_t begin, std::size_t end) { filler.fill(begin, end); });
}

}  // namespace palpate::tree
