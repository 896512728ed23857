#include "support/mesh_zoo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace palpate::zoo {

using mesh::TriangleMesh;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Two triangles for the square a-b-c-d, counter-clockwise.
void addSquare(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// Replaces each triangle by four; `middles` remembers the vertex in the middle of each edge.
void refineOnSphere(TriangleMesh& mesh, double radius, const Vec3& centre) {
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.positions.size()));
    if (is_new) {
      const Vec3 direction = mesh.positions[a] + mesh.positions[b] - 2.0 * centre;
      mesh.positions.push_back(centre + radius * direction.normalized());
    }
    return entry->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b);
    const Index bc = middle(b, c);
    const Index ca = middle(c, a);
    finer.insert(finer.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

TriangleMesh icosahedron(double radius, const Vec3& centre) {
  const double g = std::numbers::phi;
  TriangleMesh mesh{{{-1, g, 0},
                     {1, g, 0},
                     {-1, -g, 0},
                     {1, -g, 0},
                     {0, -1, g},
                     {0, 1, g},
                     {0, -1, -g},
                     {0, 1, -g},
                     {g, 0, -1},
                     {g, 0, 1},
                     {-g, 0, -1},
                     {-g, 0, 1}},
                    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& position : mesh.positions) position = centre + radius * position.normalized();
  return mesh;
}

/// A surface over a rectangle of parameters: point(u, v) for u in 0..columns, v in 0..rows.
template <class Point>
TriangleMesh parametricSheet(int columns, int rows, const Point& point) {
  TriangleMesh mesh;
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u <= columns; ++u) mesh.positions.push_back(point(u, v));
  }
  const auto at = [columns](int u, int v) { return static_cast<Index>(v * (columns + 1) + u); };
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) addSquare(mesh, at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1));
  }
  return mesh;
}

}  // namespace

TriangleMesh cube(double edge_mm, const Vec3& low_corner) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(low_corner + edge_mm * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  }
  addSquare(mesh, 0, 2, 3, 1);  // z = 0, facing down
  addSquare(mesh, 4, 5, 7, 6);
  addSquare(mesh, 0, 1, 5, 4);  // y = 0
  addSquare(mesh, 2, 6, 7, 3);
  addSquare(mesh, 0, 4, 6, 2);  // x = 0
  addSquare(mesh, 1, 3, 7, 5);
  return mesh;
}

TriangleMesh sphere(double radius_mm, int levels, const Vec3& centre) {
  TriangleMesh mesh = icosahedron(radius_mm, centre);
  for (int level = 0; level < levels; ++level) refineOnSphere(mesh, radius_mm, centre);
  return mesh;
}

TriangleMesh torus(double ring_radius_mm, double tube_radius_mm, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = kTurn * i / around;
      const double b = kTurn * j / across;
      const double r = ring_radius_mm + tube_radius_mm * std::cos(b);
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), tube_radius_mm * std::sin(b));
    }
  }
  const auto at = [=](int i, int j) { return static_cast<Index>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) addSquare(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return mesh;
}

TriangleMesh grid(int cells, double edge_mm) { return wavyGrid(cells, edge_mm, 0.0); }

TriangleMesh wavyGrid(int cells, double edge_mm, double amplitude_mm) {
  return parametricSheet(cells, cells, [=](int u, int v) {
    const double x = static_cast<double>(u) / cells;
    const double y = static_cast<double>(v) / cells;
    const double z = amplitude_mm * std::sin(2.0 * kTurn * x) * std::sin(2.0 * kTurn * y);
    return Vec3(edge_mm * x, edge_mm * y, amplitude_mm == 0.0 ? 0.0 : z);
  });
}

TriangleMesh dome(const Vec2& low_corner, double cell_mm, double top_mm) {
  return parametricSheet(20, 20, [=](int u, int v) {
    const Vec2 place = low_corner + cell_mm * Vec2(u, v);
    return Vec3(place.x(), place.y(), top_mm - 0.001 * place.squaredNorm());
  });
}

TriangleMesh plate(double edge_mm, double thickness_mm) {
  TriangleMesh mesh = cube(1.0);
  for (Vec3& p : mesh.positions) p = Vec3(edge_mm * p.x(), edge_mm * p.y(), thickness_mm * p.z());
  return mesh;
}

TriangleMesh oneTriangle() { return {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}}; }

TriangleMesh openTube(double radius_mm, double length_mm, int around, int along) {
  TriangleMesh mesh;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double a = kTurn * i / around;
      mesh.positions.emplace_back(radius_mm * std::cos(a), radius_mm * std::sin(a), length_mm * j / along);
    }
  }
  const auto at = [=](int i, int j) { return static_cast<Index>(j * around + i % around); };
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) addSquare(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return mesh;
}

TriangleMesh cubesSharingAnEdge() {
  TriangleMesh mesh = joined(cube(), cube(10.0, Vec3(10, 10, 0)));
  // The second cube's edge (10, 10, z) takes the first one's vertices 3 and 7.
  for (Triangle& triangle : mesh.triangles) {
    for (Index& v : triangle) v = v == 8 ? 3 : v == 12 ? 7 : v;
  }
  return mesh;
}

TriangleMesh cubesSharingAVertex() {
  TriangleMesh mesh = joined(cube(), cube(10.0, Vec3(10, 10, 10)));
  for (Triangle& triangle : mesh.triangles) std::replace(triangle.begin(), triangle.end(), Index{8}, Index{7});
  return mesh;
}

TriangleMesh book() {
  return {{{0, 0, 0}, {0, 10, 0}, {10, 0, 0}, {-5, 0, 8}, {-5, 0, -8}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
}

TriangleMesh moebius(int around, double radius_mm, double width_mm) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double a = kTurn * i / around;
    for (double side : {-0.5, 0.5}) {
      const double r = radius_mm + side * width_mm * std::cos(a / 2);
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), side * width_mm * std::sin(a / 2));
    }
  }
  for (int i = 0; i < around; ++i) {
    const auto low = static_cast<Index>(2 * i);
    const bool last = i + 1 == around;  // comes back upside down
    const Index next_low = last ? 1 : low + 2;
    const Index next_high = last ? 0 : low + 3;
    addSquare(mesh, low, low + 1, next_high, next_low);
  }
  return mesh;
}

TriangleMesh kleinBottle(int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = kTurn * i / around;
      const double b = kTurn * j / across;
      const double r = 20.0 + 6.0 * (std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b));
      const double z = 6.0 * (std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  const auto at = [=](int i, int j) {
    const int column = i == around ? (across - j % across) % across : j % across;  // glued the other way round
    return static_cast<Index>((i % around) * across + column);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) addSquare(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return mesh;
}

TriangleMesh cubeWithCap() {
  TriangleMesh mesh = cube();
  // The top is 4-5-7, 4-7-6. A vertex on the diagonal 4-7 makes a triangle of no height and splits one neighbour only.
  mesh.positions.emplace_back(5, 5, 10);
  mesh.triangles[3] = {4, 8, 6};
  mesh.triangles.push_back({8, 7, 6});
  mesh.triangles.push_back({4, 7, 8});
  return mesh;
}

TriangleMesh cubeWithNeedles() {
  TriangleMesh mesh = cube();
  // Vertex 8 doubles vertex 7 on the top and the y side; two triangles without area close the slit.
  mesh.positions.emplace_back(10, 10, 10);
  for (std::size_t t : {2u, 3u}) std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), Index{7}, Index{8});
  mesh.triangles.push_back({5, 7, 8});
  mesh.triangles.push_back({6, 8, 7});
  return mesh;
}

TriangleMesh plateWithFoldedSliver() {
  // Upper and lower half of a plate meet along 1-3; the vertex 4 has slipped 1e-13 mm over that edge.
  return {{{0, -10, 0}, {-10, 0, 0}, {0, 10, 0}, {10, 0, 0}, {0, -1e-13, 0}},
          {{0, 3, 1}, {1, 4, 2}, {4, 3, 2}, {1, 3, 4}}};
}

TriangleMesh cubeWithFin() {
  TriangleMesh mesh = cube();
  mesh.positions.emplace_back(2, 2, 18);
  mesh.positions.emplace_back(8, 8, 18);
  for (const Triangle& t : {Triangle{4, 7, 9}, Triangle{4, 9, 8}}) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[0], t[2], t[1]});
  }
  return mesh;
}

TriangleMesh doubleSidedGrid(int cells) {
  TriangleMesh mesh = grid(cells);
  const TriangleMesh back = flipped(mesh);
  mesh.triangles.insert(mesh.triangles.end(), back.triangles.begin(), back.triangles.end());
  return mesh;
}

TriangleMesh cubeWithDuplicates() {
  TriangleMesh mesh = cube();
  for (std::size_t t : {1u, 5u, 8u}) {
    const Triangle twin = mesh.triangles[t];
    mesh.triangles.push_back({twin[1], twin[2], twin[0]});
  }
  return mesh;
}

TriangleMesh coincidentTriangles() { return joined(oneTriangle(), oneTriangle()); }

TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const Triangle& triangle : mesh.triangles) {
    const auto first = static_cast<Index>(result.positions.size());
    for (Index v : triangle) result.positions.push_back(mesh.positions[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TriangleMesh overlappingSpheres(int levels) {
  return joined(sphere(20.0, levels), sphere(20.0, levels, Vec3(25, 0, 0)));
}

TriangleMesh hollowSphere(int levels) { return joined(sphere(20.0, levels), flipped(sphere(12.0, levels))); }

TriangleMesh mixedWinding() {
  TriangleMesh mesh = sphere(20.0, 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return mesh;
}

TriangleMesh insideOut() { return flipped(sphere(20.0, 2)); }

TriangleMesh cubeWithUnusedVertices() {
  TriangleMesh mesh = cube();
  mesh.positions.insert(mesh.positions.begin() + 4, Vec3(50, 0, 0));
  for (Triangle& triangle : mesh.triangles) {
    for (Index& v : triangle) v += v >= 4 ? 1 : 0;
  }
  mesh.positions.insert(mesh.positions.end(), 2, Vec3(0, 0, 70));
  return mesh;
}

TriangleMesh cubeWithNonFiniteVertices() {
  TriangleMesh mesh = cube();
  mesh.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  mesh.positions.emplace_back(0, -std::numeric_limits<double>::infinity(), 0);
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({9, 2, 3});
  return mesh;
}

TriangleMesh cubeWithWrongIndices() {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({kNoIndex, 2, 3});
  return mesh;
}

TriangleMesh empty() { return {}; }

TriangleMesh flipped(TriangleMesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriangleMesh joined(TriangleMesh first, const TriangleMesh& second) {
  append(second, first);
  return first;
}

std::vector<Specimen> specimens() {
  return {{"cube", cube()},
          {"sphere", sphere()},
          {"torus", torus()},
          {"grid", grid()},
          {"wavy grid", wavyGrid()},
          {"plate", plate()},
          {"one triangle", oneTriangle()},
          {"open tube", openTube()},
          {"cubes sharing an edge", cubesSharingAnEdge()},
          {"cubes sharing a vertex", cubesSharingAVertex()},
          {"book", book()},
          {"moebius", moebius()},
          {"klein bottle", kleinBottle()},
          {"cube with cap", cubeWithCap()},
          {"cube with needles", cubeWithNeedles()},
          {"plate with folded sliver", plateWithFoldedSliver()},
          {"cube with fin", cubeWithFin()},
          {"double-sided grid", doubleSidedGrid()},
          {"cube with duplicates", cubeWithDuplicates()},
          {"coincident triangles", coincidentTriangles()},
          {"soup", soup(cube())},
          {"overlapping spheres", overlappingSpheres()},
          {"hollow sphere", hollowSphere()},
          {"mixed winding", mixedWinding()},
          {"inside out", insideOut()},
          {"cube with unused vertices", cubeWithUnusedVertices()},
          {"cube with non-finite vertices", cubeWithNonFiniteVertices()},
          {"cube with wrong indices", cubeWithWrongIndices()}};
}

TriangleMesh hugeGrid(std::size_t triangles) {
  const int cells = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(triangles) / 2.0)));
  return wavyGrid(cells, 100.0, 5.0);
}

}  // namespace palpate::zoo
