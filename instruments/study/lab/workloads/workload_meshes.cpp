// A jittered grid of cells, split at the border until the count is exact, then lifted onto a height and rounded to
// float. The order of operations is part of the contract: another order rounds differently and makes another mesh.
#include "lab/workloads/workload_meshes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::lab {

namespace {

using std::numbers::pi;

constexpr double square(double x) { return x * x; }

/// A deterministic number in [0, 1) for the grid point (i, j). `salt` separates x from y.
double hash01(std::uint64_t i, std::uint64_t j, std::uint64_t salt) {
  std::uint64_t a = (i * 73856093u) ^ (j * 19349663u) ^ (salt * 83492791u);
  a = (a * 2654435761u) & 0xffffffffu;
  a ^= a >> 15;
  a = (a * 2246822519u) & 0xffffffffu;
  a ^= a >> 13;
  return static_cast<double>(a & 0xffffffu) / static_cast<double>(0x1000000);
}

/// Cells of a sheet, and how many triangles the cells fall short of the asked count.
struct Grid {
  std::size_t nx = 0, ny = 0, missing = 0;
};

Grid gridFor(const SheetSize& size) {
  if (size.triangles < 8) throw Error("a sheet needs at least 8 triangles");
  const double cells = static_cast<double>(size.triangles) / 2.0 * size.width_mm / size.length_mm;
  Grid grid;
  grid.nx = static_cast<std::size_t>(std::floor(std::sqrt(cells)));
  if (grid.nx == 0) throw Error("a sheet this narrow needs more triangles");
  grid.ny = size.triangles / 2 / grid.nx;
  grid.missing = size.triangles - 2 * grid.nx * grid.ny;
  if (grid.missing > 2 * grid.nx)
    throw Error(fmt::format("a sheet of this shape cannot have {} triangles", size.triangles));
  return grid;
}

void addGridPoints(const SheetSize& size, const Grid& grid, std::vector<Vec3>& points) {
  const auto nx = static_cast<double>(grid.nx), ny = static_cast<double>(grid.ny);
  for (std::size_t j = 0; j <= grid.ny; ++j) {
    for (std::size_t i = 0; i <= grid.nx; ++i) {
      double x = static_cast<double>(i) * (size.width_mm / nx), y = static_cast<double>(j) * (size.length_mm / ny);
      if (i > 0 && i < grid.nx && j > 0 && j < grid.ny) {
        x += (hash01(i, j, 1) - 0.5) * size.jitter * size.width_mm / nx;
        y += (hash01(i, j, 2) - 0.5) * size.jitter * size.length_mm / ny;
      }
      points.emplace_back(x, y, 0.0);
    }
  }
}

/// Corners of cell (i, j), counter-clockwise from its lower left.
std::array<Index, 4> cellCorners(const Grid& grid, std::size_t i, std::size_t j) {
  const auto a = static_cast<Index>(j * (grid.nx + 1) + i), row = static_cast<Index>(grid.nx + 1);
  return {a, a + 1, a + row + 1, a + row};
}

/// First all triangles with the edge (a, b), then all with the edge (c, d); the diagonal alternates from cell to cell.
void addGridTriangles(const Grid& grid, std::vector<Triangle>& triangles) {
  triangles.resize(2 * grid.nx * grid.ny);
  std::size_t cell = 0;
  for (std::size_t j = 0; j < grid.ny; ++j) {
    for (std::size_t i = 0; i < grid.nx; ++i, ++cell) {
      const auto [a, b, c, d] = cellCorners(grid, i, j);
      const bool alternate = ((i + j) & 1) != 0;
      triangles[cell] = alternate ? Triangle{a, b, d} : Triangle{a, b, c};
      triangles[cell + grid.nx * grid.ny] = alternate ? Triangle{b, c, d} : Triangle{a, c, d};
    }
  }
}

/// Splits the edge (from, to) of triangle `t` at its middle.
void splitEdge(Index from, Index to, std::size_t t, mesh::TriangleMesh& sheet) {
  Index opposite = kNoIndex;
  for (const Index corner : sheet.triangles[t]) {
    if (corner != from && corner != to) opposite = corner;
  }
  const auto middle = static_cast<Index>(sheet.positions.size());
  sheet.positions.emplace_back((sheet.positions[from] + sheet.positions[to]) / 2.0);
  sheet.triangles[t] = {from, middle, opposite};
  sheet.triangles.push_back({middle, to, opposite});
}

/// Splits border edges of the first row of cells, then of the last, until the count is right.
void addMissingTriangles(const Grid& grid, mesh::TriangleMesh& sheet) {
  for (std::size_t k = 0; k < grid.missing; ++k) {
    const bool first_row = k < grid.nx;
    const std::size_t i = first_row ? k : k - grid.nx, j = first_row ? 0 : grid.ny - 1;
    const auto [a, b, c, d] = cellCorners(grid, i, j);
    const std::size_t cell = j * grid.nx + i;
    if (first_row) {
      splitEdge(a, b, cell, sheet);
    } else {
      splitEdge(c, d, grid.nx * grid.ny + cell, sheet);
    }
  }
}

double rawBackHeight(double x, double y) {
  const double u = (x - 175.0) / 175.0, v = (y - 200.0) / 200.0;
  double z = 90.0 * std::sqrt(1.0 - 0.9 * u * u);                // round torso
  z += 10.0 * std::cos(pi * v);                                  // long curvature
  z -= 8.0 * std::exp(-square(x - 175.0) / (2 * square(10.0)));  // spinal furrow
  z += 9.0 * std::exp(-(square(x - 105.0) / (2 * square(30.0)) + square(y - 290.0) / (2 * square(45.0))));  // scapula
  z += 9.0 * std::exp(-(square(x - 245.0) / (2 * square(30.0)) + square(y - 290.0) / (2 * square(45.0))));
  z += 1.5 * std::exp(-square(x - 175.0) / (2 * square(5.0))) * std::cos(2 * pi * y / 28.0);  // spinous processes
  return z;
}

/// The number behind `prefix` in a name such as back_2962.
std::size_t countAfter(std::string_view prefix, std::string_view name) {
  const std::optional<double> count = parseNumber(name.substr(prefix.size()));
  if (!count || !(*count >= 8 && *count <= 1e8) || std::floor(*count) != *count) {
    throw Error(fmt::format("mesh name '{}' has no valid triangle count", name));
  }
  return static_cast<std::size_t>(*count);
}

}  // namespace

mesh::TriangleMesh sheet(const SheetSize& size, const HeightField& height) {
  const Grid grid = gridFor(size);
  mesh::TriangleMesh result;
  addGridPoints(size, grid, result.positions);
  addGridTriangles(grid, result.triangles);
  addMissingTriangles(grid, result);
  for (Vec3& p : result.positions) {
    p.z() = height(p.x(), p.y());
    p = p.cast<float>().cast<double>();
  }
  return result;
}

double backHeight(double x, double y) {
  constexpr double kRawMin = 18.46, kRawMax = 99.39;  // mm; so that the height spans about 0 to 120 mm
  return (rawBackHeight(x, y) - kRawMin) * 120.0 / (kRawMax - kRawMin);
}

HeightField grooveHeight(double angle_deg) {
  const double slope = 1.0 / std::tan(angle_deg / 2 * (pi / 180.0));
  return [slope](double x, double) { return slope * std::abs(x - 100.0); };
}

double eggcrateHeight(double x, double y) { return 2.0 * std::sin(2 * pi * x / 6.0) * std::sin(2 * pi * y / 6.0); }

mesh::TriangleMesh backMesh(std::size_t triangles) { return sheet({.triangles = triangles}, backHeight); }

mesh::TriangleMesh grooveMesh(double angle_deg) {
  return sheet({.triangles = 2 * 80 * 40, .width_mm = 200.0, .length_mm = 100.0, .jitter = 0.0},
               grooveHeight(angle_deg));
}

mesh::TriangleMesh pitMesh() {
  return sheet({.triangles = 2 * 64 * 64, .width_mm = 200.0, .length_mm = 200.0, .jitter = 0.0},
               [](double x, double y) { return std::max(std::abs(x - 100.0), std::abs(y - 100.0)); });
}

mesh::TriangleMesh eggcrateMesh() {
  return sheet({.triangles = 2 * 240 * 240, .width_mm = 120.0, .length_mm = 120.0, .jitter = 0.0}, eggcrateHeight);
}

mesh::TriangleMesh flatMesh(double jitter) {
  return sheet({.triangles = 2 * 50 * 50, .width_mm = 100.0, .length_mm = 100.0, .jitter = jitter},
               [](double, double) { return 0.0; });
}

mesh::TriangleMesh workloadMesh(std::string_view name) {
  if (name.starts_with("back_")) return backMesh(countAfter("back_", name));
  if (name == "groove60") return grooveMesh(60.0);
  if (name == "groove90") return grooveMesh(90.0);
  if (name == "groove120") return grooveMesh(120.0);
  if (name == "pit") return pitMesh();
  if (name == "eggcrate") return eggcrateMesh();
  if (name == "flat100") return flatMesh();
  if (name == "lattice100") return flatMesh(0.0);
  throw Error(fmt::format("unknown benchmark mesh '{}'", name));
}

std::vector<std::string> workloadMeshNames() {
  return {"back_2962",   "back_6261",    "back_8163",    "back_20389", "back_41582",
          "back_200000", "back_1000000", "back_4000000", "groove60",   "groove90",
          "groove120",   "pit",          "eggcrate",     "flat100",    "lattice100"};
}

}  // namespace palpate::lab
