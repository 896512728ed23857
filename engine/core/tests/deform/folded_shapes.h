// Skin with gaps: what lies near the finger through the air and far along the surface.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "core/tests/deform/shapes.h"

namespace palpate::test {

/// Cells of an open sheet with corner points `at(i, j)`, facing up where i grows along x and j along y.
inline mesh::TriangleMesh makeSheet(int along, int across, const std::function<Vec3(double, double)>& at) {
  mesh::TriangleMesh mesh;
  for (int j = 0; j <= across; ++j) {
    for (int i = 0; i <= along; ++i) mesh.positions.push_back(at(1.0 * i / along, 1.0 * j / across));
  }
  const auto row = static_cast<Index>(along + 1);
  for (Index j = 0; j < static_cast<Index>(across); ++j) {
    for (Index i = 0; i < static_cast<Index>(along); ++i) {
      const Index a = j * row + i;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return mesh;
}

/// A polyline walked at even speed: its place after a share of its length.
inline Vec2 alongLine(const std::vector<Vec2>& line, double share) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  double left = share * length;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = (line[i] - line[i - 1]).norm();
    if (left <= piece) return line[i - 1] + left / piece * (line[i] - line[i - 1]);
    left -= piece;
  }
  return line.back();
}

/// Two fingers along y, 16 mm thick and `gap_mm` apart, joined by a web 40 mm deep between them; the first lies at x <
/// 0.
inline mesh::TriangleMesh twoFingers(double gap_mm = 3.0, int cells = 150) {
  constexpr double kRadius = 8.0;
  constexpr double kDeep = 40.0;
  const double middle = kRadius + 0.5 * gap_mm;
  std::vector<Vec2> line{{-middle - kRadius, -kDeep}};
  const auto add_arc = [&](const Vec2& centre, double from, double to) {
    for (int i = 0; i <= 24; ++i) {
      const double angle = from + (to - from) * i / 24;
      line.emplace_back(centre + kRadius * Vec2(std::cos(angle), std::sin(angle)));
    }
  };
  add_arc({-middle, 0.0}, std::numbers::pi, 0.0);
  line.emplace_back(-0.5 * gap_mm, -kDeep);
  line.emplace_back(0.5 * gap_mm, -kDeep);
  add_arc({middle, 0.0}, std::numbers::pi, 0.0);
  line.emplace_back(middle + kRadius, -kDeep);
  return makeSheet(cells, 60, [&](double s, double t) {
    const Vec2 place = alongLine(line, s);
    return Vec3(place.x(), 120.0 * t, place.y());
  });
}

/// Toes: flat skin for y < 0, which a gap with walls opens along x = 0 from there on, 30 mm deep. The far bank can be
/// reached around its end within a press.
inline mesh::TriangleMesh twoToes(double gap_mm = 3.0, int cells = 120) {
  return makeSheet(cells, 100, [&](double s, double t) {
    const double x = 80.0 * (s - 0.5);
    const double y = 80.0 * (t - 0.4);
    const double open = std::clamp(y / 6.0, 0.0, 1.0);
    const double wall = std::clamp((std::abs(x) - 0.5 * gap_mm) / 1.0, 0.0, 1.0);
    return Vec3(x, y, -30.0 * open * (1.0 - wall * wall * (3.0 - 2.0 * wall)));
  });
}

/// A back (z = 0) with an arm before it: a sheet that turns up at its end, runs back over the first 60 mm higher,
/// facing the same way as the back; a ramp joins the two, all of it facing up.
inline mesh::TriangleMesh ramp(double height_mm = 200.0) {
  return makeSheet(160, 40, [&](double s, double t) {
    const double x = 80.0 * (s - 0.5);
    const double up = std::clamp((x - 4.0) / 12.0, 0.0, 1.0);
    return Vec3(x, 80.0 * (t - 0.5), height_mm * up * up * (3.0 - 2.0 * up));
  });
}

/// A roof with an edge of 90 degrees along y: `cell_mm` wide cells.
inline mesh::TriangleMesh ridge(double cell_mm) {
  const int cells = static_cast<int>(100.0 / cell_mm);
  return makeSheet(cells, cells, [&](double s, double t) {
    const double x = 100.0 * (s - 0.5);
    return Vec3(x, 100.0 * (t - 0.5), -std::abs(x));
  });
}

/// A body of random lumps: a ball whose radius varies, with valleys as steep as the lumps are many.
inline mesh::TriangleMesh lumpyBody(Random& random, int levels) {
  mesh::TriangleMesh body = zoo::sphere(1.0, levels);
  const double size = random.uniform(20.0, 150.0);
  const double lumps = random.uniform(0.0, 0.35);
  const Vec3 waves(std::floor(random.uniform(1, 9)), std::floor(random.uniform(1, 9)),
                   std::floor(random.uniform(1, 9)));
  const Vec3 stretch(random.uniform(0.3, 1.0), 1.0, random.uniform(0.3, 1.0));
  for (Vec3& p : body.positions) {
    const double radius = 1.0 + lumps * std::sin(waves.x() * p.x()) * std::sin(waves.y() * p.y() + waves.z() * p.z());
    p = size * radius * p.cwiseProduct(stretch);
  }
  return body;
}

}  // namespace palpate::test
