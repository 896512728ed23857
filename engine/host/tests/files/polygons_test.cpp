// Faces of many corners: whatever their form, the triangles cover the area of the outline, once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "palpate/base/random.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "support/error_message.h"

namespace palpate::mesh {

namespace {

using Outline = std::vector<Vec2>;

/// One face of an OBJ whose corners lie in a plane that `place` gives them.
std::string objOf(const Outline& outline, const std::function<Vec3(const Vec2&)>& place) {
  std::string text;
  std::string face = "f";
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec3 at = place(outline[k]);
    char row[120];
    std::snprintf(row, sizeof(row), "v %.17g %.17g %.17g\n", at.x(), at.y(), at.z());
    text += row;
    face += " " + std::to_string(k + 1);
  }
  return text + face + "\n";
}

Vec3 flat(const Vec2& p) { return {p.x(), p.y(), 0.0}; }

double areaOf(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2& a = outline[k];
    const Vec2& b = outline[(k + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// No triangle is turned over, and together they have the outline's area: so they lie within it, once.
void expectCovered(const Outline& outline, const char* name) {
  const Vec3 right = Vec3(0.6, 0.0, 0.8);
  const Vec3 up = Vec3(0.48, 0.8, -0.36);
  struct Plane {
    std::function<Vec3(const Vec2&)> place;
    Vec3 normal;
  };
  const Plane planes[] = {
      {flat, Vec3::UnitZ()},
      {[](const Vec2& p) { return Vec3(p.y(), p.x(), 5.0); }, -Vec3::UnitZ()},
      {[](const Vec2& p) { return Vec3(7.0, p.x(), p.y()); }, Vec3::UnitX()},
      {[](const Vec2& p) { return Vec3(p.x(), -3.0, p.y()); }, -Vec3::UnitY()},
      {[&](const Vec2& p) { return Vec3(p.x() * right + p.y() * up); }, right.cross(up)},
  };
  for (const auto& [place, normal] : planes) {
    const auto [mesh, channels, notes] = loadWithChannelsFromMemory(objOf(outline, place), Format::obj, name);
    EXPECT_TRUE(notes.empty()) << name << ": " << notes.front();
    double area = 0.0;
    std::size_t turned_over = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const double facing = 0.5 * areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).dot(normal);
      area += facing;
      turned_over += facing < -1e-12 ? 1 : 0;
    }
    EXPECT_EQ(turned_over, 0u) << name;
    EXPECT_NEAR(area, areaOf(outline), 1e-9 * areaOf(outline)) << name;
  }
}

Outline ring(std::size_t corners, double radius, const std::function<double(double)>& roughness) {
  Outline outline;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    outline.push_back((radius + roughness(angle)) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

Outline comb(std::size_t teeth) {
  Outline outline = {{0.0, -1.0}, {2.0 * static_cast<double>(teeth), -1.0}};
  for (std::size_t t = teeth; t-- > 0;) {
    const auto x = 2.0 * static_cast<double>(t);
    outline.insert(outline.end(), {{x + 2.0, 100.0}, {x + 1.0, 100.0}, {x + 1.0, 0.0}, {x + 0.25, 0.0}});
  }
  return outline;
}

/// A band that runs around itself.
Outline spiral(std::size_t corners) {
  Outline outer;
  Outline inner;
  for (std::size_t k = 0; k < corners / 2; ++k) {
    const double angle = 0.1 * static_cast<double>(k);
    const Vec2 direction(std::cos(angle), std::sin(angle));
    outer.push_back((10.0 + angle) * direction);
    inner.push_back((8.0 + angle) * direction);
  }
  std::reverse(inner.begin(), inner.end());
  outer.insert(outer.end(), inner.begin(), inner.end());
  return outer;
}

/// The rim of a maze without loops, on whole numbers: corners on straight sides, and every depth of pockets.
Outline maze(int size, std::uint64_t seed) {
  const int width = 2 * size - 1;
  std::vector<char> filled(static_cast<std::size_t>(width) * static_cast<std::size_t>(width), 0);
  const auto cell = [&](int x, int y) -> char& {
    return filled[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  };
  Random random(seed);
  std::vector<std::pair<int, int>> trail = {{0, 0}};
  cell(0, 0) = 1;
  while (!trail.empty()) {
    const auto [x, y] = trail.back();
    std::vector<std::pair<int, int>> ways;
    for (const auto& [dx, dy] : {std::pair(2, 0), {-2, 0}, {0, 2}, {0, -2}}) {
      const bool inside = x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < width;
      if (inside && cell(x + dx, y + dy) == 0) ways.emplace_back(dx, dy);
    }
    if (ways.empty()) {
      trail.pop_back();
      continue;
    }
    const auto [dx, dy] = ways[random.below(ways.size())];
    cell(x + dx / 2, y + dy / 2) = cell(x + dx, y + dy) = 1;
    trail.emplace_back(x + dx, y + dy);
  }
  const auto is_filled = [&](int x, int y) { return x >= 0 && y >= 0 && x < width && y < width && cell(x, y) != 0; };
  Outline outline;
  int x = 0, y = 0, dx = 1, dy = 0;  // walks with the filled cells to its left
  do {
    outline.emplace_back(x, y);
    x += dx;
    y += dy;
    const auto filled_at = [&](int right, int ahead) {  // of the four cells around the corner
      const int side_x = right * dy, side_y = -right * dx;
      return is_filled(x + (ahead * dx + side_x - 1) / 2, y + (ahead * dy + side_y - 1) / 2);
    };
    if (filled_at(1, 1)) {
      std::tie(dx, dy) = std::pair(dy, -dx);
    } else if (!filled_at(-1, 1)) {
      std::tie(dx, dy) = std::pair(-dy, dx);
    }
  } while (x != 0 || y != 0);
  return outline;
}

TEST(Polygons, CoverTheirOutlineWhateverItsForm) {
  Random random(3);
  const auto rough = [&](double) { return 8.0 * (random.uniform() - 0.5); };
  for (const std::size_t corners : {5u, 6u, 9u, 64u, 65u, 66u, 500u}) {
    expectCovered(ring(corners, 10.0, rough), "rough ring");
    expectCovered(ring(corners, 10.0, [](double) { return 0.0; }), "circle");
    expectCovered(ring(corners, 40.0, [](double a) { return 15.0 * std::cos(a) + 12.0 * std::cos(2.0 * a); }),
                  "kidney");
  }
  for (const std::size_t teeth : {2u, 40u, 300u}) expectCovered(comb(teeth), "comb");
  for (const std::size_t corners : {20u, 80u, 700u}) expectCovered(spiral(corners), "spiral");
  for (const std::uint64_t seed : {1u, 2u, 3u}) expectCovered(maze(12, seed), "maze");
}

TEST(Polygons, OfAHundredThousandCornersAreCutAsQuickly) { expectCovered(comb(25'000), "comb"); }

TEST(Polygons, HaveHolesWhereABridgeLeadsToThem) {
  const Outline hole_a = {{2, 2}, {2, 4}, {4, 4}, {4, 2}};  // clockwise
  const Outline hole_b = {{6, 6}, {6, 8}, {8, 8}, {8, 6}};
  Outline bridged = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
  bridged.insert(bridged.end(), hole_a.begin(), hole_a.end());
  bridged.push_back(hole_a[0]);
  expectCovered(bridged, "one hole");

  Outline chained = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {2, 2}, {2, 4}, {4, 4}};
  chained.insert(chained.end(), hole_b.begin(), hole_b.end());
  chained.insert(chained.end(), {{6, 6}, {4, 4}, {4, 2}, {2, 2}});
  expectCovered(chained, "a hole bridged to the next");

  Outline from_a_side = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 3}, {2, 3},
                         {2, 4}, {4, 4},  {4, 2},   {2, 2},  {2, 3}, {0, 3}};
  expectCovered(from_a_side, "a bridge from the middle of a side");

  Outline many = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};  // along the left side, 48 holes
  for (int k = 48; k > 0; --k) {
    const double y = 2.0 * k;
    many.insert(many.end(), {{0, y}, {1, y}, {1, y + 1}, {50, y + 1}, {50, y}, {1, y}, {0, y}});
  }
  expectCovered(many, "many holes");
}

TEST(Polygons, OfOneBridgedVertexEachAreCutAlike) {
  // The corners of the bridge are the same vertices, not copies at the same place.
  const std::string text =
      "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 2 2 0\nv 2 4 0\nv 4 4 0\nv 4 2 0\nf 1 2 3 4 1 5 6 7 8 5\n";
  const TriangleMesh mesh = loadFromMemory(text, Format::obj, "x");
  EXPECT_NEAR(validate(mesh).area_mm2, 96.0, 1e-12);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(validate(mesh).border_loops, 2u);
}

TEST(Polygons, MayTouchThemselvesAndRunToAndFro) {
  expectCovered({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, "a corner on a side");
  expectCovered({{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}, "two squares that share a corner");
  expectCovered({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 7}, {2, 4}, {0, 4}}, "a spike outwards");
  expectCovered({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 1}, {2, 4}, {0, 4}}, "a spike inwards");
  expectCovered({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 4}}, "corners twice");
  Outline to_and_fro = {{0, 0}};
  for (int k = 1; k < 200; ++k) to_and_fro.insert(to_and_fro.end(), {{1.0 * k, 0}, {0.5, 0}});
  to_and_fro.insert(to_and_fro.end(), {{200, 0}, {200, 10}, {0, 10}});
  expectCovered(to_and_fro, "a side run again and again");
}

TEST(Polygons, RoughAcrossTheirPlaneAreSeenAlongTheirNormal) {
  // A rim cut by hand: seen along the nearest axis its zigzag of 3 mm across a plane at 45 degrees crosses itself.
  Random random(5);
  const Vec3 right = Vec3(1, 0, 1).normalized();
  const Vec3 normal = Vec3(-1, 0, 1).normalized();
  const Outline outline = ring(400, 100.0, [](double) { return 0.0; });
  std::size_t k = 0;
  const auto rough = [&](const Vec2& p) {
    return Vec3(p.x() * right + p.y() * Vec3::UnitY() + (k++ % 2 == 0 ? 3.0 : -3.0) * normal);
  };
  const auto [mesh, channels, notes] = loadWithChannelsFromMemory(objOf(outline, rough), Format::obj, "rim");
  EXPECT_TRUE(notes.empty());
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).dot(normal);
  }
  EXPECT_NEAR(area, areaOf(outline), 1e-9 * areaOf(outline));
}

TEST(Polygons, ThatCrossThemselvesAreToldOrRefusedWithTheirLine) {
  const auto star = [](std::size_t corners) {
    Outline outline;
    const Outline round = ring(corners, 10.0, [](double) { return 0.0; });
    for (std::size_t k = 0; k < corners; ++k) outline.push_back(round[2 * k % corners]);
    return objOf(outline, flat);
  };
  const auto notes_of = [](const std::string& text) {
    return loadWithChannelsFromMemory(text, Format::obj, "x").notes;
  };
  EXPECT_EQ(
      notes_of(star(5)),
      std::vector<std::string>{"x:6: the outline of the face crosses itself; it is triangulated with the least area"});
  EXPECT_EQ(notes_of(objOf({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, flat)).size(), 1u) << "a bow tie";
  EXPECT_EQ(support::thrownMessage([&] { notes_of(star(65)); }),
            "x:66: the outline of the face of 65 corners crosses itself: it bounds no surface");
  Outline eight = ring(100, 10.0, [](double) { return 0.0; });
  std::reverse(eight.begin() + 30, eight.begin() + 70);
  EXPECT_NE(support::thrownMessage([&] { notes_of(objOf(eight, flat)); }).find("crosses itself"), std::string::npos);
  Outline twice = ring(50, 10.0, [](double) { return 0.0; });
  twice.insert(twice.end(), twice.begin(), twice.begin() + 50);
  EXPECT_NE(support::thrownMessage([&] { notes_of(objOf(twice, flat)); }).find("crosses itself"), std::string::npos);
}

TEST(Polygons, OnALineHaveNoAreaAndNoFault) {
  Outline line;
  for (int k = 0; k < 100; ++k) line.emplace_back(k, 3.0 * k);
  EXPECT_TRUE(loadWithChannelsFromMemory(objOf(line, flat), Format::obj, "x").notes.empty());
}

}  // namespace

}  // namespace palpate::mesh
