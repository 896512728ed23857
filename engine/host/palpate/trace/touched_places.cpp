// The skin is cut finer only where a place reaches it (found by the triangle tree); the small triangles are then found
// from each place through a grid of their centres, as wide as the farthest reach.
#include "palpate/trace/touched_places.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/hash.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::trace {

namespace {

/// No body extends farther out than this, mm.
constexpr double kFarthestPlaceMm = 1e6;
/// No side of a triangle that is touched is longer than this share of the reach: a fingertip's edge is then some
/// 25 pieces long.
constexpr double kPieceShare = 0.25;
/// For the whole skin; a mesh that would need more is cut more coarsely.
constexpr std::size_t kMaxPieces = 200'000;
constexpr int kMaxCuts = 8;

std::int64_t cellIndex(double mm, double cell_mm) { return static_cast<std::int64_t>(std::floor(mm / cell_mm)); }

double longestSide(const mesh::TriangleMesh& mesh, const Triangle& t) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm());
  }
  return longest;
}

Vec3 triangleAreaVector2(const mesh::TriangleMesh& mesh, const Triangle& t) {
  return mesh::areaVector2(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

/// The skin within the reach of any place.
struct Reached {
  std::vector<bool> triangles;  ///< of the skin
  std::vector<Vec3> normals;    ///< at each place, not of unit length; zero: the place lies on no skin
};

Reached reachedBy(const mesh::TriangleMesh& skin, std::span<const TouchedPlace> places,
                  const std::vector<double>& reach_mm) {
  const tree::TriangleTree tree = tree::buildTriangleTree(skin);
  Reached reached{std::vector<bool>(skin.triangles.size(), false), {}};
  reached.normals.reserve(places.size());
  for (const TouchedPlace& place : places) {
    const double reach = reach_mm[place.finger];
    double nearest = reach * reach;
    Vec3 normal = Vec3::Zero();
    tree::visitNearTriangles(tree, place.place, nearest, [&](Index record, const tree::ClosestOnTriangle& closest) {
      const Index triangle = tree.source_triangle[record];
      reached.triangles[triangle] = true;
      if (closest.squared_distance < nearest) {
        nearest = closest.squared_distance;
        normal = triangleAreaVector2(skin, skin.triangles[triangle]);
      }
      return reach * reach;
    });
    // The triangle that was felt knows its side best, also where two sheets lie close together.
    if (!normal.isZero(0.0) && place.triangle < skin.triangles.size()) {
      normal = triangleAreaVector2(skin, skin.triangles[place.triangle]);
    }
    reached.normals.push_back(normal);
  }
  return reached;
}

/// Into how many strips each side of a triangle is cut so that none is longer.
int countStrips(double side_mm, double longest_mm) {
  return std::clamp(static_cast<int>(std::ceil(side_mm / longest_mm)), 1, 1 << kMaxCuts);
}

/// A triangle as strips^2 small ones of its own shape.
void addPieces(const mesh::TriangleMesh& skin, const Triangle& t, int strips, mesh::TriangleMesh& pieces) {
  const Vec3& a = skin.positions[t[0]];
  const Vec3 u = (skin.positions[t[1]] - a) / strips;
  const Vec3 v = (skin.positions[t[2]] - a) / strips;
  const auto first = static_cast<Index>(pieces.positions.size());
  const auto corner = [&](int i, int j) {  // row j has strips + 1 - j corners
    return first + static_cast<Index>(j * (strips + 1) - j * (j - 1) / 2 + i);
  };
  for (int j = 0; j <= strips; ++j) {
    for (int i = 0; i + j <= strips; ++i) pieces.positions.push_back(a + i * u + j * v);
  }
  for (int j = 0; j < strips; ++j) {
    for (int i = 0; i + j < strips; ++i) {
      pieces.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
      if (i + j + 1 < strips) pieces.triangles.push_back({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
}

/// The skin with finer triangles where it is reached, those first.
mesh::TriangleMesh cutSkin(const mesh::TriangleMesh& skin, const std::vector<bool>& reached, double longest_mm) {
  double pieces = 0.0;
  for (;; longest_mm *= 1.5) {
    pieces = 0.0;
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
      if (reached[t]) pieces += elementary::square(countStrips(longestSide(skin, skin.triangles[t]), longest_mm));
    }
    const auto reached_triangles = static_cast<double>(std::count(reached.begin(), reached.end(), true));
    if (pieces <= std::max(static_cast<double>(kMaxPieces), reached_triangles)) break;
  }
  mesh::TriangleMesh cut;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    if (!reached[t]) continue;
    const Triangle& triangle = skin.triangles[t];
    addPieces(skin, triangle, countStrips(longestSide(skin, triangle), longest_mm), cut);
  }
  const auto first = static_cast<Index>(cut.positions.size());
  cut.positions.insert(cut.positions.end(), skin.positions.begin(), skin.positions.end());
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const auto& [a, b, c] = skin.triangles[t];
    if (!reached[t]) cut.triangles.push_back({first + a, first + b, first + c});
  }
  return cut;
}

/// The centres of triangles by cells of space.
class CentreGrid {
 public:
  CentreGrid(const mesh::TriangleMesh& mesh, double cell_mm) : cell_mm_(cell_mm) {
    for (const Triangle& triangle : mesh.triangles) centres_.push_back(mesh::centreOf(mesh, triangle));
    for (Index t = 0; t < centres_.size(); ++t) rows_[cellAt(centres_[t])].push_back(t);
  }

  /// Calls visit(triangle, squared distance) for those within `reach`, at most a cell away.
  template <class Visit>
  void forEachNear(const Vec3& place, double reach, const Visit& visit) const {
    const Cell middle = cellAt(place);
    for (int k = 0; k < 27; ++k) {
      const auto row = rows_.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
      if (row == rows_.end()) continue;
      for (const Index triangle : row->second) {
        if ((centres_[triangle] - place).squaredNorm() <= reach * reach) visit(triangle);
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const noexcept {
      Hash hash;
      for (const std::int64_t number : cell) hash.add(static_cast<std::uint64_t>(number));
      return hash.value();
    }
  };
  Cell cellAt(const Vec3& place) const {
    return {cellIndex(place.x(), cell_mm_), cellIndex(place.y(), cell_mm_), cellIndex(place.z(), cell_mm_)};
  }

  double cell_mm_;
  std::vector<Vec3> centres_;
  std::unordered_map<Cell, std::vector<Index>, CellHash> rows_;
};

void addAreas(TouchedSurface& surface) {
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const Vec3 normal2 = triangleAreaVector2(surface.mesh, surface.mesh.triangles[t]);
    const double area = 0.5 * normal2.norm();
    const bool dorsal = normal2.z() > kDorsalNormalZ * normal2.norm();
    const bool touched = surface.ticks[t] > 0.0;
    surface.dorsal_mm2 += dorsal ? area : 0.0;
    surface.touched_mm2 += touched ? area : 0.0;
    surface.touched_dorsal_mm2 += dorsal && touched ? area : 0.0;
  }
}

}  // namespace

std::size_t PlaceCollector::KeyHash::operator()(const Key& key) const noexcept {
  Hash hash;
  for (const std::int64_t number : key) hash.add(static_cast<std::uint64_t>(number));
  return hash.value();
}

void PlaceCollector::add(const Sample& sample) {
  const contact::FingerOutput& felt = sample.contact;
  if (felt.touch == contact::Touch::free) return;
  if (!(felt.proxy.array().abs() <= kFarthestPlaceMm).all()) {
    ++left_out_;
    return;
  }
  const Key key = {sample.world,
                   sample.finger,
                   felt.triangle,
                   cellIndex(felt.proxy.x(), kPlaceCellMm),
                   cellIndex(felt.proxy.y(), kPlaceCellMm),
                   cellIndex(felt.proxy.z(), kPlaceCellMm)};
  auto found = cells_.find(key);
  if (found == cells_.end()) {
    if (cells_.size() >= kMaxPlaces) {
      ++left_out_;
      return;
    }
    found = cells_.emplace(key, Cell{}).first;
  }
  Cell& cell = found->second;
  cell.sum += felt.proxy;
  ++cell.ticks;
  const double force = felt.force.norm();
  if (force > cell.peak_force_n) cell.peak_force_n = force;
}

std::vector<TouchedPlace> PlaceCollector::places() const {
  std::vector<std::pair<Key, Cell>> sorted(cells_.begin(), cells_.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TouchedPlace> places;
  places.reserve(sorted.size());
  for (const auto& [key, cell] : sorted) {
    places.push_back({static_cast<std::uint32_t>(key[0]), static_cast<std::uint32_t>(key[1]),
                      static_cast<Index>(key[2]), cell.sum / static_cast<double>(cell.ticks), cell.ticks,
                      cell.peak_force_n});
  }
  return places;
}

TouchedSurface touchedSurface(const mesh::TriangleMesh& skin, std::span<const TouchedPlace> places,
                              std::span<const double> reach_mm) {
  std::vector<double> reach(reach_mm.begin(), reach_mm.end());
  for (double& mm : reach) mm = std::max(mm, kMinReachMm);
  std::uint32_t fingers = 0;
  for (const TouchedPlace& place : places) fingers = std::max(fingers, place.finger + 1);
  reach.resize(std::max<std::size_t>(reach.size(), fingers), kMinReachMm);
  const auto [least, most] = std::minmax_element(reach.begin(), reach.end());
  const double shortest_reach = reach.empty() ? kMinReachMm : *least;
  const double longest_reach = reach.empty() ? kMinReachMm : *most;

  const Reached reached = reachedBy(skin, places, reach);
  TouchedSurface surface;
  surface.mesh = cutSkin(skin, reached.triangles, kPieceShare * shortest_reach);
  surface.ticks.assign(surface.mesh.triangles.size(), 0.0);
  surface.peak_force_n.assign(surface.mesh.triangles.size(), 0.0);
  const CentreGrid grid(surface.mesh, longest_reach);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const TouchedPlace& place = places[i];
    bool found = false;
    grid.forEachNear(place.place, reach[place.finger], [&](Index piece) {
      if (triangleAreaVector2(surface.mesh, surface.mesh.triangles[piece]).dot(reached.normals[i]) <= 0.0) return;
      surface.ticks[piece] += static_cast<double>(place.ticks);
      surface.peak_force_n[piece] = std::max(surface.peak_force_n[piece], place.peak_force_n);
      found = true;
    });
    if (!found) surface.astray_ticks += place.ticks;
  }
  addAreas(surface);
  return surface;
}

}  // namespace palpate::trace
