// Kinds beyond the embedded shapes are made from them, or from the held-out meshes, by damage and by gluing.
// Data flow: kind and seed -> here -> mesh::repair, hunt/hunt_world.h.
#include "lab/workloads/hunted_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/hunted_shapes.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/error.h"
#include "palpate/mesh/decimate.h"

namespace palpate::lab {
namespace {

Vec3 anyDirection(Random& random) { return random.normal3().normalized(); }

mesh::TriangleMesh someShape(Random& random) {
  const std::vector<std::string> names = huntedShapeNames();
  return huntedShape(names[random.below(names.size())], random);
}

/// Draws are made one after another: in which order arguments are made is the compiler's choice.
mesh::TriangleMesh someBall(Random& random, double radius, std::array<double, 2> bump, std::array<double, 2> waves,
                            int rounds) {
  const double number = random.uniform(waves[0], waves[1]);
  const double height = random.uniform(bump[0], bump[1]);
  return bumpyBallMesh(radius, height, number, rounds);
}

/// Squeezes by a share between these, in any direction.
void squeezeRandomly(mesh::TriangleMesh& mesh, Random& random, double low, double high) {
  const double share = random.uniform(low, high);
  squeeze(mesh, anyDirection(random), share);
}

/// A small closed part: balls, rings and plates of few triangles.
mesh::TriangleMesh somePart(Random& random, double size) {
  switch (random.below(4)) {
    case 0:
      return someBall(random, size, {0, 0.1}, {2, 8}, 4);
    case 1:
      return torusMesh(size, random.uniform(0.2, 0.6) * size, 40, 16);
    case 2: {
      mesh::TriangleMesh plate = plateMesh(2 * size, random.uniform(0.05, 1.0) * size, 12);
      for (Vec3& p : plate.positions) p -= size * Vec3(1, 1, 0);
      return plate;
    }
    default: {
      mesh::TriangleMesh limb = bumpyBallMesh(size, 0, 0, 4);
      squeeze(limb, Vec3::UnitZ(), random.uniform(2, 4));
      return limb;
    }
  }
}

// ---- slivers, coarse, noise ---------------------------------------------------------------------------------------

mesh::TriangleMesh leaf(Random& random) {
  mesh::TriangleMesh mesh = someBall(random, 70, {0, 0.08}, {3, 9}, 5);
  squeezeRandomly(mesh, random, 0.02, 0.2);
  return mesh;
}

mesh::TriangleMesh coarse(Random& random) {
  const auto triangles = static_cast<std::size_t>(2 * (20 + random.below(300)));
  return mesh::decimate(someBall(random, 60, {0.02, 0.2}, {3, 9}, 4), triangles);
}

mesh::TriangleMesh slivers(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  splitIntoSlivers(mesh, random.uniform(0.05, 0.8), random);
  return mesh;
}

mesh::TriangleMesh noisy(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  shake(mesh, std::pow(10.0, random.uniform(-2.5, -0.3)), random);
  return mesh;
}

mesh::TriangleMesh octahedra(Random& random) {
  const auto rounds = static_cast<int>(random.below(3));
  mesh::TriangleMesh mesh = bumpyBallMesh(random.uniform(30, 70), 0, 0, rounds);
  squeezeRandomly(mesh, random, 0.2, 1.0);
  return mesh;
}

mesh::TriangleMesh narrowTorus(Random& random) {
  const int round = 8 + static_cast<int>(random.below(12));
  return torusMesh(45, random.uniform(6, 30), 300, round);
}

mesh::TriangleMesh thinPlate(Random& random) { return plateMesh(90, random.uniform(0.05, 4.0), 24); }

// ---- self-intersecting --------------------------------------------------------------------------------------------

mesh::TriangleMesh parts(Random& random, std::size_t count, double size, double apart) {
  mesh::TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    mesh::TriangleMesh part = somePart(random, random.uniform(0.4, 1.0) * size);
    place(part, random.uniform(0.2, 1.0) * apart * anyDirection(random), random);
    mesh::append(part, mesh);
  }
  return mesh;
}

mesh::TriangleMesh limbThroughBody(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  mesh::TriangleMesh limb = bumpyBallMesh(random.uniform(6, 16), 0, 0, 4);
  squeeze(limb, Vec3::UnitX(), random.uniform(2, 6));
  place(limb, random.uniform(0, 30) * anyDirection(random), random);
  mesh::append(limb, mesh);
  return mesh;
}

/// One sheet through another that almost lies in it.
mesh::TriangleMesh grazingBalls(Random& random) {
  mesh::TriangleMesh mesh = bumpyBallMesh(45, 0, 0, 4), other = bumpyBallMesh(45, random.uniform(0.002, 0.03), 6, 4);
  place(other, random.uniform(0, 1.0) * anyDirection(random), random);
  mesh::append(other, mesh);
  return mesh;
}

/// A tube that is narrow or turned over where it is twisted: sheets meet themselves.
mesh::TriangleMesh pinchedTube(Random& random) {
  mesh::TriangleMesh mesh = torusMesh(38, random.uniform(30, 50), 60, 40);  // wider than its hole: a spindle
  shake(mesh, random.uniform(0, 0.2), random);
  return mesh;
}

// ---- torn, doubled, open ------------------------------------------------------------------------------------------

mesh::TriangleMesh pierced(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  pierce(mesh, 1 + random.below(6), random);
  return mesh;
}

mesh::TriangleMesh slitted(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  const double width = std::pow(10.0, random.uniform(-6, -1));
  slit(mesh, 1 + random.below(5), width, random);
  return mesh;
}

mesh::TriangleMesh doubled(Random& random) {
  mesh::TriangleMesh mesh = someShape(random);
  repeatTriangles(mesh, 1 + random.below(200), random);
  return mesh;
}

mesh::TriangleMesh openSheet(Random& random) {
  const double height = random.uniform(0, 14), wave = 2 * std::numbers::pi / random.uniform(12, 90),
               turn = random.uniform(0, 3);
  return sheet(
      {.triangles = 5000 + 2 * random.below(5000), .width_mm = 150, .length_mm = 150, .jitter = random.uniform(0, 0.9)},
      [=](double x, double y) {
        return height * std::sin(wave * (x * std::cos(turn) + y * std::sin(turn))) * std::sin(0.61 * wave * y + turn);
      });
}

mesh::TriangleMesh ridge(Random& random) {
  const double slope = random.uniform(0.2, 4.0);
  const double sign = random.below(2) == 0 ? 1.0 : -1.0;
  return sheet({.triangles = 6400, .width_mm = 150, .length_mm = 150, .jitter = 0.0},
               [=](double x, double) { return sign * slope * std::abs(x - 75); });
}

// ---- voxels, hairline gaps, thin parts, open and inside out ---------------------------------------------------------

/// The skin of cubes of a lattice, like a segmented scan. Cubes that share only an edge or a corner are there.
mesh::TriangleMesh voxels(Random& random) {
  constexpr int kCells = 9;
  constexpr std::size_t kRow = kCells;
  const auto cell_of = [](int i) { return std::array{i % kCells, i / kCells % kCells, i / (kCells * kCells)}; };
  const double size = random.uniform(4, 12), share = random.uniform(0.5, 0.95), reach = random.uniform(2.5, 4.5);
  std::vector<std::uint8_t> filled(kCells * kCells * kCells, 0);
  const auto at = [&](int x, int y, int z) {
    const bool within = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < kCells;
    return within && filled[kRow * (kRow * static_cast<std::size_t>(z) + static_cast<std::size_t>(y)) +
                            static_cast<std::size_t>(x)] != 0;
  };
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    constexpr int kMiddle = kCells / 2;
    const auto [x, y, z] = cell_of(i);
    const Vec3 from_middle(x - kMiddle, y - kMiddle, z - kMiddle);
    filled[static_cast<std::size_t>(i)] = from_middle.norm() <= reach && random.uniform(0, 1) < share ? 1 : 0;
  }
  filled[filled.size() / 2] = 1;  // one at least
  mesh::TriangleMesh mesh;
  const auto add_face = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {  // seen from u x v
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3& p : {corner, Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)})
      mesh.positions.push_back(size * p);
    const Index turn = random.below(2) == 0 ? 0 : 1;  // either diagonal
    mesh.triangles.push_back({first + turn, first + turn + 1, first + turn + 2});
    mesh.triangles.push_back({first + turn, first + turn + 2, first + (turn + 3) % 4});
  };
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    const auto [x, y, z] = cell_of(i);
    if (!at(x, y, z)) continue;
    const Vec3 c(x, y, z), ex = Vec3::UnitX(), ey = Vec3::UnitY(), ez = Vec3::UnitZ();
    if (!at(x + 1, y, z)) add_face(c + ex, ey, ez);
    if (!at(x - 1, y, z)) add_face(c, ez, ey);
    if (!at(x, y + 1, z)) add_face(c + ey, ez, ex);
    if (!at(x, y - 1, z)) add_face(c, ex, ez);
    if (!at(x, y, z + 1)) add_face(c + ez, ex, ey);
    if (!at(x, y, z - 1)) add_face(c, ey, ex);
  }
  return mesh;
}

/// Boxes next to each other, with a nanometre to a tenth of a millimetre between them.
mesh::TriangleMesh hairlineParts(Random& random) {
  const double gap = std::pow(10.0, random.uniform(-6, -1));
  const int cells = 2 + static_cast<int>(random.below(5));
  mesh::TriangleMesh mesh;
  for (int i = 0; i < 6; ++i) {
    mesh::TriangleMesh part = plateMesh(40, 30, cells);
    const int row = i / 3;
    for (Vec3& p : part.positions) p += Vec3(i % 3 * (40 + gap), row * (40 + gap), 0);
    mesh::append(part, mesh);
  }
  return mesh;
}

/// Plates and limbs of 0.5 to 8 mm, far enough apart not to touch.
mesh::TriangleMesh thinParts(Random& random) {
  mesh::TriangleMesh mesh;
  for (int i = 0; i < 4; ++i) {
    mesh::TriangleMesh part = plateMesh(40, random.uniform(0.5, 8), 10);
    if (random.below(2) == 0) {
      part = bumpyBallMesh(20, 0, 0, 4);
      squeeze(part, Vec3::UnitZ(), random.uniform(0.02, 0.2));
    }
    const int row = i / 2;
    place(part, 90 * Vec3(i % 2, row, 0), random);
    mesh::append(part, mesh);
  }
  return mesh;
}

/// A sound shape with an opening, all its triangles turned: repair has to find the outside.
mesh::TriangleMesh insideOutOpen(Random& random) {
  const double waves = random.uniform(2, 8);
  const double bump = random.uniform(0, 0.1);
  mesh::TriangleMesh mesh = bumpyBallMesh(random.uniform(40, 70), bump, waves, 5);
  const Vec3 axis = anyDirection(random);
  const double height = mesh::boundingBox(mesh).sizes().maxCoeff() * random.uniform(0.32, 0.45);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh::centreOf(mesh, t).dot(axis) > height; });
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Cuts off the body beyond a plane near one end: an opening that is far from most of the body.
mesh::TriangleMesh openAtOneEnd(mesh::TriangleMesh mesh, Random& random) {
  const Vec3 axis = random.below(2) == 0 ? anyDirection(random) : Vec3(Vec3::Unit(static_cast<int>(random.below(3))));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec3& p : mesh.positions) low = std::min(low, p.dot(axis)), high = std::max(high, p.dot(axis));
  const double cut = high - random.uniform(0.03, 0.2) * (high - low);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh::centreOf(mesh, t).dot(axis) > cut; });
  return mesh;
}

/// A scan: a whole body but for one cut, a hand at the wrist. Half of them have gaps that a finger is pressed through.
mesh::TriangleMesh farHole(Random& random) {
  constexpr std::array kWithGaps{"comb", "fingers", "crossing_crevices", "plates", "limbs"};
  const std::size_t pick = random.below(2 * kWithGaps.size());
  mesh::TriangleMesh mesh = pick < kWithGaps.size() ? huntedShape(kWithGaps[pick], random) : someShape(random);
  if (random.below(3) == 0) shake(mesh, std::pow(10.0, random.uniform(-2.5, -0.5)), random);
  return openAtOneEnd(std::move(mesh), random);
}

mesh::TriangleMesh farHoleOfParts(Random& random) {
  return openAtOneEnd(random.below(2) == 0 ? parts(random, 4, 30, 35) : limbThroughBody(random), random);
}

/// A band drawn along a bend that is tighter than the band is wide, and made a body: on the inner side its two flat
/// caps lie doubled in their planes, one of the sheets inside out.
mesh::TriangleMesh doubledCaps(Random& random) {
  const double half = random.uniform(6, 18), thickness = random.uniform(5, 60), bend = random.uniform(0.2, 1.2) * half,
               turn = random.uniform(0.8, 4.5);
  const auto columns = static_cast<Index>(16 + random.below(40)), rows = static_cast<Index>(1 + random.below(12));
  mesh::TriangleMesh mesh;
  const auto ring = 2 * (rows + 1);
  for (Index i = 0; i <= columns; ++i) {
    const double along = (static_cast<double>(i) / columns - 0.5) * 2.0;  // the middle half is the bend
    const double angle = turn * std::clamp(along, -0.5, 0.5);
    const Vec3 out(std::sin(angle), std::cos(angle), 0.0);
    const double straight = 80.0 * (along - std::clamp(along, -0.5, 0.5));
    const Vec3 middle = bend * out + straight * Vec3(std::cos(angle), -std::sin(angle), 0.0);
    for (Index j = 0; j < ring; ++j) {
      const Index row = j <= rows ? j : ring - 1 - j;
      const double up = thickness * row / rows;
      mesh.positions.push_back(middle + (j <= rows ? half : -half) * out + up * Vec3::UnitZ());
    }
  }
  const auto at = [&](Index i, Index j) { return i * ring + j % ring; };
  for (Index i = 0; i < columns; ++i) {
    for (Index j = 0; j < ring; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  for (Index j = 0; j < rows; ++j) {
    for (const Index end : {Index{0}, columns}) {
      Triangle one{at(end, j), at(end, j + 1), at(end, ring - 2 - j)};
      Triangle other{at(end, j), at(end, ring - 2 - j), at(end, ring - 1 - j)};
      if (end != 0) std::swap(one[1], one[2]), std::swap(other[1], other[2]);
      mesh.triangles.push_back(one);
      mesh.triangles.push_back(other);
    }
  }
  return mesh;
}

/// Plates side by side with a crack between them, straight or jagged, that is a real one: wider than repair joins.
mesh::TriangleMesh cracks(Random& random) {
  const double gap = std::pow(10.0, random.uniform(-1.8, -0.5));
  const double jag = random.below(2) == 0 ? 0.0 : random.uniform(0.1, 3.0);
  constexpr int kCells = 16;
  mesh::TriangleMesh left = plateMesh(60, 25, kCells);
  for (Vec3& p : left.positions) {
    const double side = std::max(0.0, p.x() - 30.0) / 30.0;
    p.x() += side * jag * std::sin(1.7 * p.y());
  }
  mesh::TriangleMesh right = left;
  for (Vec3& p : right.positions) p.x() = 120.0 + gap - p.x();
  for (Triangle& t : right.triangles) std::swap(t[1], t[2]);
  if (jag > 0.0) {  // the right one's edge runs along with the left one's
    for (Vec3& p : right.positions) {
      const double side = std::max(0.0, 90.0 + gap - p.x()) / 30.0;
      p.x() += 2.0 * side * jag * std::sin(1.7 * p.y());
    }
  }
  mesh::append(right, left);
  return left;
}

struct BodyKind {
  const char* name;
  mesh::TriangleMesh (*make)(Random& random);
};

constexpr std::array<BodyKind, 28> kMade{{
    {"leaf", leaf},
    {"coarse", coarse},
    {"slivers", slivers},
    {"noisy", noisy},
    {"octahedra", octahedra},
    {"narrow_torus", narrowTorus},
    {"thin_plate", thinPlate},
    {"two_parts", [](Random& r) { return parts(r, 2, 40, 30); }},
    {"many_parts", [](Random& r) { return parts(r, 8, 25, 45); }},
    {"limb_through_body", limbThroughBody},
    {"grazing_balls", grazingBalls},
    {"pinched_tube", pinchedTube},
    {"overlapping_balls", [](Random&) { return overlappingBallsMesh(); }},
    {"touching_boxes", [](Random&) { return touchingBoxesMesh(); }},
    {"pierced", pierced},
    {"slitted", slitted},
    {"doubled", doubled},
    {"open_sheet", openSheet},
    {"ridge", ridge},
    {"slivers_of_leaf",
     [](Random& r) {
       auto mesh = leaf(r);
       splitIntoSlivers(mesh, 0.5, r);
       return mesh;
     }},
    {"voxels", voxels},
    {"hairline_parts", hairlineParts},
    {"thin_parts", thinParts},
    {"inside_out_open", insideOutOpen},
    {"far_hole", farHole},
    {"far_hole_of_parts", farHoleOfParts},
    {"doubled_caps", doubledCaps},
    {"cracks", cracks},
}};

}  // namespace

std::vector<std::string> huntedBodyKinds() {
  std::vector<std::string> kinds = huntedShapeNames();
  for (const BodyKind& kind : kMade) kinds.emplace_back(kind.name);
  return kinds;
}

mesh::TriangleMesh huntedBody(std::string_view kind, std::uint64_t seed) {
  Random random(seed);
  const auto* const made =
      std::find_if(kMade.begin(), kMade.end(), [&](const BodyKind& body) { return kind == body.name; });
  return made == kMade.end() ? huntedShape(kind, random) : made->make(random);
}

}  // namespace palpate::lab
