// Chosen for being plain: edges one by one in place of regions, the winding number summed over all triangles. A grid, a
// tree of boxes and a ball round the last point known to hold no surface speed up the rest.
// Based on: see surface_side.h; the grid, the tree and the ball are our own.
#include "lab/judges/surface_side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace palpate::lab {
namespace {

/// Between the 0 outside and the 1 inside of a body; above 1/2 so that slits left by repair do not flip the answer.
constexpr double kInsideWinding = 0.75;
/// Barycentric coordinates this small count as zero when a feature (edge, vertex) is named.
constexpr double kOnFeature = 1e-9;
/// On an open surface a tip this many times its depth from a border may have been released there: the skin between can
/// be steep.
constexpr double kBesideBorder = 3.0;
constexpr Index kLeafTriangles = 8;

double cross2(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// Twice the signed area seen from +z.
double projectedArea2(const std::array<Vec3, 3>& c) { return cross2(c[0], c[1], c[2].x(), c[2].y()); }

double segmentParameter(const Vec3& a, const Vec3& b, const Vec3& point) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0.0 ? std::clamp((point - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

/// Barycentric coordinates of the foot of the perpendicular on the plane; nothing for a triangle without area.
std::optional<Vec3> footCoordinates(const std::array<Vec3, 3>& c, const Vec3& point) {
  const Vec3 n = mesh::areaVector2(c[0], c[1], c[2]);
  const double n2 = n.squaredNorm();
  if (!(n2 > 0.0)) return std::nullopt;
  const double u = n.dot((c[2] - c[1]).cross(point - c[1])) / n2;
  const double v = n.dot((c[0] - c[2]).cross(point - c[2])) / n2;
  return Vec3(u, v, 1.0 - u - v);
}

Vec3 combined(const std::array<Vec3, 3>& c, const Vec3& b) { return b[0] * c[0] + b[1] * c[1] + b[2] * c[2]; }

/// Barycentric coordinates of the nearest point: the foot if it is inside, else the best of the three edges. Slower
/// than the usual decision tree over regions and free of its special cases.
Vec3 nearestCoordinates(const std::array<Vec3, 3>& c, const Vec3& point) {
  const std::optional<Vec3> foot = footCoordinates(c, point);
  if (foot && foot->minCoeff() >= 0.0) return *foot;
  Vec3 best = Vec3::Zero();
  double best2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double s = segmentParameter(c[i], c[(i + 1) % 3], point);
    const Vec3 b = (1.0 - s) * Vec3::Unit(i) + s * Vec3::Unit((i + 1) % 3);
    const double d2 = (combined(c, b) - point).squaredNorm();
    if (d2 < best2) best = b, best2 = d2;
  }
  return best;
}

/// Solid angle of a triangle seen from the origin, over 4 pi.
double solidAngleShare(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return std::atan2(a.dot(b.cross(c)), denominator) / (2.0 * std::numbers::pi);
}

SurfaceKind kindOf(const mesh::TriangleMesh& mesh, const std::vector<std::array<Index, 3>>& neighbours) {
  bool closed = true, faces_up = true;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index n : neighbours[t]) closed = closed && n != kNoIndex;
    const Triangle& v = mesh.triangles[t];
    faces_up = faces_up && projectedArea2({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]}) > 0.0;
  }
  if (closed) return SurfaceKind::closed;
  return faces_up ? SurfaceKind::height_field : SurfaceKind::open;
}

std::vector<std::array<Index, 2>> borderEdges(const mesh::TriangleMesh& mesh,
                                              const std::vector<std::array<Index, 3>>& neighbours) {
  std::vector<std::array<Index, 2>> edges;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbours[t][i] == kNoIndex) edges.push_back({mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]});
    }
  }
  return edges;
}

/// The cells that the box of a triangle overlaps, first and last of x and y.
struct CellRange {
  std::size_t x0, x1, y0, y1;
};

std::size_t cellIndex(double position, double origin, double size, std::size_t cells) {
  return static_cast<std::size_t>(
      std::clamp(std::floor((position - origin) / size), 0.0, static_cast<double>(cells) - 1.0));
}

}  // namespace

double windingNumber(const mesh::TriangleMesh& mesh, const Vec3& point) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += solidAngleShare(mesh.positions[t[0]] - point, mesh.positions[t[1]] - point, mesh.positions[t[2]] - point);
  }
  return sum;
}

Vec3 nearestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& point) {
  return combined(corners, nearestCoordinates(corners, point));
}

SurfaceSide::SurfaceSide(mesh::TriangleMesh mesh)
    : mesh_(std::move(mesh)), diagonal_(mesh::boundingBox(mesh_).diagonal().norm()) {
  neighbours_ = mesh::neighboursOfTriangles(mesh_);
  kind_ = kindOf(mesh_, neighbours_);
  border_edges_ = borderEdges(mesh_, neighbours_);
  on_border_.resize(mesh_.positions.size(), false);
  for (const auto& [from, to] : border_edges_) on_border_[from] = on_border_[to] = true;
  if (kind_ == SurfaceKind::height_field) buildGrid();
}

std::array<Vec3, 3> SurfaceSide::corners(Index triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
}

// ---- height field -------------------------------------------------------------------------------------------------

void SurfaceSide::buildGrid() {
  const Eigen::AlignedBox3d box = mesh::boundingBox(mesh_);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(mesh_.triangles.size()) / 2.0)));
  cells_ = {side, side};
  grid_origin_ = box.min().head<2>();
  cell_size_ = (box.diagonal().head<2>() / static_cast<double>(side));

  const auto range_of = [&](Index t) {
    Eigen::AlignedBox3d b;
    for (const Vec3& c : corners(t)) b.extend(c);
    return CellRange{cellIndex(b.min().x(), grid_origin_.x(), cell_size_.x(), side),
                     cellIndex(b.max().x(), grid_origin_.x(), cell_size_.x(), side),
                     cellIndex(b.min().y(), grid_origin_.y(), cell_size_.y(), side),
                     cellIndex(b.max().y(), grid_origin_.y(), cell_size_.y(), side)};
  };
  const auto for_each_cell = [&](auto&& visit) {
    for (Index t = 0; t < mesh_.triangles.size(); ++t) {
      const CellRange range = range_of(t);
      for (std::size_t y = range.y0; y <= range.y1; ++y) {
        for (std::size_t x = range.x0; x <= range.x1; ++x) visit(y * side + x, t);
      }
    }
  };
  grid_.offsets.assign(side * side + 1, 0);
  for_each_cell([&](std::size_t cell, Index) { ++grid_.offsets[cell + 1]; });
  std::partial_sum(grid_.offsets.begin(), grid_.offsets.end(), grid_.offsets.begin());
  grid_.entries.resize(grid_.offsets.back());
  std::vector<Index> next(grid_.offsets.begin(), grid_.offsets.end() - 1);
  for_each_cell([&](std::size_t cell, Index t) { grid_.entries[next[cell]++] = t; });
}

std::optional<double> SurfaceSide::heightAt(double x, double y) const {
  const std::size_t cell = cellIndex(y, grid_origin_.y(), cell_size_.y(), cells_[1]) * cells_[0] +
                           cellIndex(x, grid_origin_.x(), cell_size_.x(), cells_[0]);
  std::optional<double> height;
  for (const Index t : grid_[static_cast<Index>(cell)]) {
    const std::array<Vec3, 3> c = corners(t);
    const Vec3 b =
        Vec3(cross2(c[1], c[2], x, y), cross2(c[2], c[0], x, y), cross2(c[0], c[1], x, y)) / projectedArea2(c);
    if (b.minCoeff() < -kOnFeature) continue;
    height = std::max(height.value_or(-std::numeric_limits<double>::infinity()), combined(c, b).z());
  }
  return height;
}

double SurfaceSide::distanceToBorder(const Vec3& point) const {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : border_edges_) {
    Vec3 a = mesh_.positions[from], b = mesh_.positions[to];
    if (kind_ == SurfaceKind::height_field) a.z() = b.z() = point.z();
    nearest2 = std::min(nearest2, (a + segmentParameter(a, b, point) * (b - a) - point).squaredNorm());
  }
  return std::sqrt(nearest2);
}

Side SurfaceSide::sideOverHeightField(const Vec3& point, double reach) const {
  const std::optional<double> height = heightAt(point.x(), point.y());
  if (!height) return Side::unknown;
  const double depth = *height - point.z();
  if (std::abs(depth) <= tolerance()) return Side::on_surface;
  if (depth < 0.0) return Side::outside;
  return distanceToBorder(point) < depth + reach ? Side::unknown : Side::inside;
}

// ---- nearest point ------------------------------------------------------------------------------------------------

void SurfaceSide::buildTree() {
  if (!boxes_.empty()) return;
  triangles_of_vertices_ = mesh::trianglesOfVertices(mesh_);
  std::vector<Vec3> centres(mesh_.triangles.size());
  for (Index t = 0; t < centres.size(); ++t) centres[t] = combined(corners(t), Vec3::Constant(1.0 / 3.0));
  order_.resize(mesh_.triangles.size());
  std::iota(order_.begin(), order_.end(), Index{0});
  buildBox(0, static_cast<Index>(order_.size()), centres);
}

Index SurfaceSide::buildBox(Index first, Index last, const std::vector<Vec3>& centres) {
  const auto self = static_cast<Index>(boxes_.size());
  boxes_.push_back({{}, first, last - first, 0});
  for (Index i = first; i < last; ++i) {
    for (const Vec3& c : corners(order_[i])) boxes_[self].bounds.extend(c);
  }
  if (last - first <= kLeafTriangles) return self;
  int axis = 0;
  boxes_[self].bounds.diagonal().maxCoeff(&axis);
  const Index middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](Index a, Index b) { return centres[a][axis] < centres[b][axis]; });
  boxes_[self].count = 0;
  buildBox(first, middle, centres);
  const Index right = buildBox(middle, last, centres);
  boxes_[self].right = right;
  return self;
}

void SurfaceSide::searchBox(Index box, const Vec3& point, NearestPoint& best, Vec3& barycentric) const {
  const Box& b = boxes_[box];
  for (Index i = b.first; i < b.first + b.count; ++i) {
    const std::array<Vec3, 3> c = corners(order_[i]);
    const Vec3 coordinates = nearestCoordinates(c, point);
    const Vec3 q = combined(c, coordinates);
    const double distance = (q - point).norm();
    if (distance >= best.distance) continue;
    best.point = q;
    best.distance = distance;
    best.triangle = order_[i];
    barycentric = coordinates;
  }
  if (b.count > 0) return;
  std::array<Index, 2> children{box + 1, b.right};
  std::array<double, 2> far{boxes_[children[0]].bounds.exteriorDistance(point),
                            boxes_[children[1]].bounds.exteriorDistance(point)};
  if (far[1] < far[0]) std::swap(children[0], children[1]), std::swap(far[0], far[1]);
  for (int i = 0; i < 2; ++i) {
    if (far[i] < best.distance) searchBox(children[i], point, best, barycentric);
  }
}

Vec3 SurfaceSide::vertexPseudoNormal(Index vertex) const {
  Vec3 sum = Vec3::Zero();
  for (const Index t : triangles_of_vertices_[vertex]) {
    const Triangle& v = mesh_.triangles[t];
    const auto i = static_cast<std::size_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
    const Vec3& p = mesh_.positions[vertex];
    const Vec3 to_next = (mesh_.positions[v[(i + 1) % 3]] - p).normalized();
    const Vec3 to_last = (mesh_.positions[v[(i + 2) % 3]] - p).normalized();
    const Vec3 n = to_next.cross(to_last);
    sum += std::atan2(n.norm(), to_next.dot(to_last)) * n.normalized();
  }
  return sum.normalized();
}

void SurfaceSide::describeFeature(const Vec3& barycentric, NearestPoint& nearest) const {
  const Triangle& v = mesh_.triangles[nearest.triangle];
  const auto normal_of = [&](Index t) {
    const std::array<Vec3, 3> c = corners(t);
    return mesh::areaVector2(c[0], c[1], c[2]).normalized();
  };
  std::array<int, 3> zeros{};
  int zero_count = 0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(barycentric[i]) <= kOnFeature) zeros[zero_count++] = i;
  }
  if (zero_count == 2) {
    const Index vertex = v[3 - zeros[0] - zeros[1]];
    nearest.on_border = on_border_[vertex];
    nearest.pseudo_normal = vertexPseudoNormal(vertex);
    return;
  }
  nearest.pseudo_normal = normal_of(nearest.triangle);
  if (zero_count != 1) return;
  const Index across = neighbours_[nearest.triangle][(zeros[0] + 1) % 3];  // the edge opposite to corner zeros[0]
  nearest.on_border = across == kNoIndex;
  if (across != kNoIndex) nearest.pseudo_normal = (nearest.pseudo_normal + normal_of(across)).normalized();
}

NearestPoint SurfaceSide::nearestTo(const Vec3& point) {
  buildTree();
  NearestPoint nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  Vec3 barycentric = Vec3::Zero();
  searchBox(0, point, nearest, barycentric);
  describeFeature(barycentric, nearest);
  return nearest;
}

Side SurfaceSide::sideOf(const Vec3& point, double reach) {
  if (kind_ == SurfaceKind::height_field) return sideOverHeightField(point, reach);
  if ((point - clear_centre_).norm() < clear_radius_) return clear_side_;
  const NearestPoint nearest = nearestTo(point);
  if (nearest.distance <= tolerance()) return Side::on_surface;
  Side side = Side::unknown;
  if (kind_ == SurfaceKind::closed) {
    side = windingNumber(mesh_, point) > kInsideWinding ? Side::inside : Side::outside;
    clear_centre_ = point;
    clear_radius_ = nearest.distance - tolerance();
    clear_side_ = side;
  } else if (!nearest.on_border && distanceToBorder(point) > kBesideBorder * nearest.distance + reach) {
    side = nearest.pseudo_normal.dot(point - nearest.point) < 0.0 ? Side::inside : Side::outside;
  }
  return side;
}

}  // namespace palpate::lab
