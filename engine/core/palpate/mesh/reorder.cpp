// Triangles: Morton codes of their centres on a 2^21 lattice per axis, radix sorted. Vertices: split at the median of
// the longest axis, always at whole groups.
//
// Based on: Morton, "A computer oriented geodetic data base" (1966), interleaved bits; Bentley, "Multidimensional
// binary search trees used for associative searching" (1975), median splits.
//
// Preferred to meshoptimizer 0.18 (Debian 12; the benchmark's back of 1,000,000 triangles in each order, one core, best
// of four rounds that take turns; deform, search and blocks as in `palpate study bench deform`, 37,634 vertices
// moved; box: mean diagonal of 64 consecutive vertices):
//
//                                                   sort, ms   box, mm   deform, ns   search, ns   blocks
//   as made, row by row                                    0        67         11.0          3.1      806
//   both by Morton's curve                               139      12.4          6.7          3.3      662
//   meshopt_spatialSortTriangles, spatialSortRemap        70      12.5          6.4          3.0      663
//   meshopt_optimizeVertexCache, optimizeVertexFetch     208      13.6          5.2          1.4      659
//   this                                                 187       7.0          3.7          0.8      630
//
// A deformation takes 1.4 times as long in the best of theirs, at 41,582 triangles as well (5.4 ns against 3.8). A tick
// of back_slide hardly notices: 0.21 us here, 0.22 to 0.24 in theirs, 0.30 as made, at 41,582 triangles 0.15 in every
// order; and the surface is built in the same time (0.74 s), because its tree sorts for itself. Its Morton sort of the
// triangles alone is twice as fast as ours: 0.07 s of loading a million, too little for another library.
#include "palpate/mesh/reorder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "palpate/base/background.h"
#include "palpate/mesh/weld.h"

namespace palpate::mesh {

namespace {

// --- in compact groups ---

/// Floats: half the memory to move, and a cut a tenth of a micrometre off the middle is as good.
struct Placed {
  Vec3f point;
  Index place;  // in the given order
};

Vec3f finite(const Vec3& point) {
  return point.cast<float>().unaryExpr([](float x) { return std::isfinite(x) ? x : 0.0f; });
}

int longestAxis(std::span<const Placed> points) {
  Eigen::AlignedBox3f box;
  for (const Placed& placed : points) box.extend(placed.point);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  return axis;
}

/// Number of these points for the lower half: whole groups of groups while there are several, then whole groups, a
/// power of two, so that no later cut falls within one.
std::size_t lowerHalf(std::size_t points) {
  const auto units_for = [](std::size_t n) { return (n + kCompactGroup - 1) / kCompactGroup; };
  const std::size_t groups = units_for(points);
  const std::size_t large = units_for(groups);
  const std::size_t lower = large > 1 ? (large + 1) / 2 * kCompactGroup : std::bit_ceil(groups) / 2;
  return lower * kCompactGroup;
}

/// Fewer are split in less time than starting a thread is worth.
constexpr std::size_t kSharedPoints = 50'000;

/// `threads` share the work; the cuts are the same for any number of them.
void split(std::span<Placed> points, std::size_t threads) {
  if (points.size() <= kCompactGroup) {
    std::sort(points.begin(), points.end(), [](const Placed& a, const Placed& b) { return a.place < b.place; });
    return;
  }
  const int axis = longestAxis(points);
  const auto middle = static_cast<std::ptrdiff_t>(lowerHalf(points.size()));
  std::nth_element(points.begin(), points.begin() + middle, points.end(), [axis](const Placed& a, const Placed& b) {
    return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.place < b.place;
  });
  const std::span lower = points.first(static_cast<std::size_t>(middle));
  const std::span upper = points.subspan(static_cast<std::size_t>(middle));
  if (threads < 2 || points.size() < kSharedPoints) {
    split(lower, 1);
    split(upper, 1);
    return;
  }
  Background beside([&] { split(lower, threads / 2); });
  split(upper, threads - threads / 2);
  beside.join();
}

// --- along the curve ---

/// 21 bits an axis fill 63 bits; at 4 million triangles on a back that is 0.2 micrometre, finer than any mesh.
constexpr int kBitsPerAxis = 21;
constexpr double kCellsPerAxis = static_cast<double>(1 << kBitsPerAxis);

/// Moves bit i to bit 3 i.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffffull;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffull;
  bits = (bits | bits << 8) & 0x100f00f00f00f00full;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
  return (bits | bits << 2) & 0x1249249249249249ull;
}

std::uint64_t cell(double coordinate, double low, double cells_per_unit) {
  const double scaled = (coordinate - low) * cells_per_unit;
  // Written so that NaN falls into cell 0.
  return scaled > 0.0 ? static_cast<std::uint64_t>(std::min(scaled, kCellsPerAxis - 1.0)) : 0;
}

struct CodedIndex {
  std::uint64_t code;
  Index index;
};

std::vector<CodedIndex> mortonCodes(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) {
    if (point.allFinite()) box.extend(point);
  }
  std::vector<CodedIndex> codes(points.size());
  if (box.isEmpty()) box.extend(Vec3::Zero().eval());
  // One scale for the three axes: cells are cubes, so runs of the order are round.
  const double longest = box.sizes().maxCoeff();
  const double cells_per_unit = longest > 0.0 ? kCellsPerAxis / longest : 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    codes[i] = {spread(cell(p.x(), box.min().x(), cells_per_unit)) |
                    spread(cell(p.y(), box.min().y(), cells_per_unit)) << 1 |
                    spread(cell(p.z(), box.min().z(), cells_per_unit)) << 2,
                i};
  }
  return codes;
}

/// Stable radix sort by 11 bits a pass: about four times as fast as std::sort at four million.
void sortByCode(std::vector<CodedIndex>& codes) {
  constexpr int kBitsPerPass = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kBitsPerPass;
  std::vector<CodedIndex> other(codes.size());
  for (int shift = 0; shift < 3 * kBitsPerAxis; shift += kBitsPerPass) {
    std::array<std::size_t, kBuckets> next{};
    for (const auto& c : codes) ++next[(c.code >> shift) & (kBuckets - 1)];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    for (const auto& c : codes) other[next[(c.code >> shift) & (kBuckets - 1)]++] = c;
    codes.swap(other);
  }
}

// --- a mesh in order ---

/// Used vertices in compact groups, within a group by first use; then the others.
std::vector<Index> groupedVertices(const TriangleMesh& mesh) {
  std::vector<Index> order;
  order.reserve(mesh.positions.size());
  std::vector<bool> seen(mesh.positions.size(), false);
  const auto visit = [&](Index v) {
    if (seen[v]) return;
    seen[v] = true;
    order.push_back(v);
  };
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) visit(v);
  }
  order = inCompactGroups(mesh.positions, order);
  for (Index v = 0; v < mesh.positions.size(); ++v) visit(v);
  return order;
}

}  // namespace

std::vector<Index> inCompactGroups(std::span<const Vec3> points, std::span<const Index> order) {
  std::vector<Placed> placed;
  placed.reserve(order.size());
  for (Index i = 0; i < order.size(); ++i) placed.push_back({finite(points[order[i]]), i});
  split(placed, processors());
  std::vector<Index> sorted;
  sorted.reserve(order.size());
  for (const Placed& p : placed) sorted.push_back(order[p.place]);
  return sorted;
}

std::vector<Index> mortonOrder(std::span<const Vec3> points) {
  auto codes = mortonCodes(points);
  const auto is_before = [](const CodedIndex& a, const CodedIndex& b) { return a.code < b.code; };
  if (!std::is_sorted(codes.begin(), codes.end(), is_before)) sortByCode(codes);
  std::vector<Index> order(codes.size());
  std::transform(codes.begin(), codes.end(), order.begin(), [](const CodedIndex& c) { return c.index; });
  return order;
}

std::vector<Vec3> triangleCentres(const TriangleMesh& mesh) {
  std::vector<Vec3> centres;
  centres.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) centres.push_back(centreOf(mesh, triangle));
  return centres;
}

Reordering reorderSpatially(TriangleMesh& mesh) {
  Reordering order;
  order.source_triangle = mortonOrder(triangleCentres(mesh));
  mesh.triangles = picked(mesh.triangles, order.source_triangle);
  order.source_vertex = groupedVertices(mesh);
  mesh.positions = picked(mesh.positions, order.source_vertex);
  std::vector<Index> new_index(mesh.positions.size());
  for (Index v = 0; v < new_index.size(); ++v) new_index[order.source_vertex[v]] = v;
  for (Triangle& triangle : mesh.triangles) {
    for (Index& v : triangle) v = new_index[v];
  }
  return order;
}

}  // namespace palpate::mesh
