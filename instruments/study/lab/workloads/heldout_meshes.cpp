// Shapes by formula: grids that close on themselves, a cut octahedron, faces welded to boxes, sheets over a height.
// Boxes are made of whole steps from the origin, so that their faces meet bit by bit.
#include "lab/workloads/heldout_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/error.h"

namespace palpate::lab {
namespace {

using std::numbers::pi;

/// Cells (u, v) -> (u + 1, v + 1) of a grid whose rows and columns both close on themselves.
void addWrappedCells(int around, int across, std::vector<Triangle>& triangles) {
  const auto at = [&](int u, int v) { return static_cast<Index>(u % around * across + v % across); };
  for (int u = 0; u < around; ++u) {
    for (int v = 0; v < across; ++v) {
      triangles.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1)});
      triangles.push_back({at(u, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
}

mesh::TriangleMesh octahedron() {
  mesh::TriangleMesh m;
  for (int axis = 0; axis < 3; ++axis) {
    m.positions.emplace_back(Vec3::Unit(axis));
    m.positions.emplace_back(-Vec3::Unit(axis));
  }
  m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return m;
}

/// Each triangle into four, new vertices on the unit sphere.
mesh::TriangleMesh subdivided(const mesh::TriangleMesh& coarse) {
  mesh::TriangleMesh fine{coarse.positions, {}};
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(fine.positions.size()));
    if (is_new) fine.positions.emplace_back((fine.positions[a] + fine.positions[b]).normalized());
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) fine.triangles.push_back(t);
  }
  return fine;
}

/// Vertices of equal position become one; corners of a plate's six faces are made apart and joined here.
mesh::TriangleMesh welded(const mesh::TriangleMesh& soup) {
  mesh::TriangleMesh result;
  std::map<std::array<double, 3>, Index> known;
  std::vector<Index> now(soup.positions.size());
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Vec3& p = soup.positions[i];
    const auto [found, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(result.positions.size()));
    if (is_new) result.positions.push_back(p);
    now[i] = found->second;
  }
  for (const Triangle& t : soup.triangles) result.triangles.push_back({now[t[0]], now[t[1]], now[t[2]]});
  return result;
}

/// A rectangle of n x m cells from `corner` along `u` and `v`; u x v points outwards.
void addFace(const Vec3& corner, const Vec3& u, const Vec3& v, int n, int m, mesh::TriangleMesh& soup) {
  const auto first = static_cast<Index>(soup.positions.size());
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) soup.positions.emplace_back(corner + u * i + v * j);
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<Index>(first + j * (n + 1) + i), row = static_cast<Index>(n + 1);
      soup.triangles.push_back({a, a + 1, a + row + 1});
      soup.triangles.push_back({a, a + row + 1, a + row});
    }
  }
}

/// Faces meet bit by bit because every position is a whole number of steps from the origin.
mesh::TriangleMesh boxMesh(const Vec3& step, const std::array<int, 3>& cells) {
  const Vec3 x = step.x() * Vec3::UnitX(), y = step.y() * Vec3::UnitY(), z = step.z() * Vec3::UnitZ();
  const Vec3 far(step.x() * cells[0], step.y() * cells[1], step.z() * cells[2]);
  const Vec3 right(far.x(), 0, 0), back(0, far.y(), 0), top(0, 0, far.z());
  mesh::TriangleMesh soup;
  addFace(top, x, y, cells[0], cells[1], soup);
  addFace(Vec3::Zero(), y, x, cells[1], cells[0], soup);
  addFace(Vec3::Zero(), x, z, cells[0], cells[2], soup);
  addFace(back, z, x, cells[2], cells[0], soup);
  addFace(Vec3::Zero(), z, y, cells[2], cells[1], soup);
  addFace(right, y, z, cells[1], cells[2], soup);
  return welded(soup);
}

void append(mesh::TriangleMesh more, const Vec3& shift, mesh::TriangleMesh& to) {
  for (Vec3& p : more.positions) p += shift;
  append(more, to);
}

double saddleHeight(double x, double y) { return ((x - 100) * (x - 100) - (y - 100) * (y - 100)) / 120.0; }

/// Terraces 12 mm high whose risers are 0.5 mm wide: a slope of more than 80 degrees.
double cliffHeight(double x, double) {
  const double step = std::floor(x / 20.0), within = x - 20.0 * step;
  return 12.0 * (step + std::clamp((within - 10.0) / 0.5, 0.0, 1.0));
}

/// Sums of sines with irrational ratios down to 3 mm wavelength: no plane, no symmetry, no smooth scale.
double terrainHeight(double x, double y) {
  double z = 0.0, size = 12.0, wave = 90.0, turn = 0.7;
  for (int octave = 0; octave < 6; ++octave, size *= 0.55, wave *= 0.51, turn += 2.4) {
    const double u = x * std::cos(turn) - y * std::sin(turn), v = x * std::sin(turn) + y * std::cos(turn);
    z += size * std::sin(2 * pi * u / wave) * std::sin(2 * pi * v / (1.37 * wave) + octave);
  }
  return z;
}

/// Needles of 10 mm height, 10 mm apart, about 1.5 mm wide at half height.
double spikeHeight(double x, double y) {
  const double dx = std::remainder(x, 10.0), dy = std::remainder(y, 10.0);
  return 10.0 * std::exp(-(dx * dx + dy * dy) / (2 * 0.65 * 0.65));
}

mesh::TriangleMesh sheet200(std::size_t triangles, const HeightField& height, double jitter = 0.3) {
  return sheet({.triangles = triangles, .width_mm = 200, .length_mm = 200, .jitter = jitter}, height);
}

mesh::TriangleMesh scaledMesh(mesh::TriangleMesh m, double factor) {
  for (Vec3& p : m.positions) p *= factor;
  return m;
}

/// Cells of 100 : 1, as a mesh that follows a long fold has them.
mesh::TriangleMesh sliverMesh() {
  mesh::TriangleMesh m = sheet({.triangles = 20000, .width_mm = 2000, .length_mm = 20}, [](double x, double y) {
    return 6 * std::sin(2 * pi * x / 600) + 3 * std::cos(2 * pi * y / 15);
  });
  for (Vec3& p : m.positions) p = Vec3(p.x() / 10.0, p.y() * 10.0, p.z());
  return m;
}

}  // namespace

mesh::TriangleMesh torusMesh(double ring_radius_mm, double tube_radius_mm, int around, int across) {
  mesh::TriangleMesh m;
  for (int u = 0; u < around; ++u) {
    for (int v = 0; v < across; ++v) {
      const double a = 2 * pi * u / around, b = 2 * pi * v / across,
                   out = ring_radius_mm + tube_radius_mm * std::cos(b);
      m.positions.emplace_back(out * std::cos(a), out * std::sin(a), tube_radius_mm * std::sin(b));
    }
  }
  addWrappedCells(around, across, m.triangles);
  return m;
}

mesh::TriangleMesh bumpyBallMesh(double radius_mm, double bump, double bumps_around, int level) {
  mesh::TriangleMesh m = octahedron();
  for (int i = 0; i < level; ++i) m = subdivided(m);
  for (Vec3& p : m.positions) {
    const Vec3 phase = bumps_around * p;
    p *= radius_mm * (1.0 + bump * std::sin(phase.x()) * std::sin(phase.y() + 1) * std::sin(phase.z() + 2));
  }
  return m;
}

mesh::TriangleMesh plateMesh(double size_mm, double thickness_mm, int cells) {
  return boxMesh({size_mm / cells, size_mm / cells, thickness_mm}, {cells, cells, 1});
}

mesh::TriangleMesh overlappingBallsMesh() {
  const mesh::TriangleMesh ball = bumpyBallMesh(20.0, 0.0, 0.0, 5);
  mesh::TriangleMesh m;
  append(ball, {-12.5, 0, 0}, m);
  append(ball, {12.5, 0.1, 0.07}, m);  // off axis, so that no edges cross exactly
  return m;
}

mesh::TriangleMesh touchingBoxesMesh() {
  const mesh::TriangleMesh box = boxMesh({5, 5, 5}, {6, 6, 6});
  mesh::TriangleMesh m;
  append(box, Vec3::Zero(), m);
  append(box, {30, 30, 0}, m);
  return welded(m);
}

mesh::TriangleMesh heldoutMesh(std::string_view name) {
  if (name == "ring") return torusMesh(50, 18, 160, 60);
  if (name == "ball") return bumpyBallMesh(60, 0.08, 9.0, 5);
  if (name == "plate2mm") return plateMesh(100, 2, 40);
  if (name == "plate_thick") return plateMesh(100, 30, 12);
  if (name == "saddle") return sheet200(20000, saddleHeight);
  if (name == "cliffs") return sheet200(80000, cliffHeight, 0.0);
  if (name == "terrain") return sheet200(60000, terrainHeight);
  if (name == "spikes") return sheet200(200000, spikeHeight);
  if (name == "slivers") return sliverMesh();
  if (name == "ridge")
    return sheet200(
        12800, [](double x, double) { return -2.5 * std::abs(x - 100); }, 0.0);
  if (name == "tiny") return scaledMesh(backMesh(6261), 0.01 / 400);
  if (name == "huge") return scaledMesh(backMesh(6261), 1e5 / 400);
  if (name == "overlapping_balls") return overlappingBallsMesh();
  if (name == "touching_boxes") return touchingBoxesMesh();
  throw Error(fmt::format("unknown held-out mesh '{}'", name));
}

std::vector<std::string> heldoutMeshNames() {
  return {"ring",  "ball", "plate2mm", "plate_thick",       "saddle",        "cliffs", "terrain", "spikes", "slivers",
          "ridge", "tiny", "huge",     "overlapping_balls", "touching_boxes"};
}

}  // namespace palpate::lab
