// The benchmark meshes: height fields of exact triangle counts, computed instead of stored.
//
// They take part in every contact benchmark and in the tests of the contact bars. The formulae are those of the
// benchmark's reference script, so that the same meshes come out bit by bit (instruments/study/lab/tests/lab checks
// their SHA-256).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// z(x, y), all in mm.
using HeightField = std::function<double(double, double)>;

/// The benchmark's back lies over this, from (0, 0) on.
inline constexpr double kBackWidthMm = 350.0;
inline constexpr double kBackLengthMm = 400.0;

struct SheetSize {
  std::size_t triangles = 0;         ///< exact count; at least 8
  double width_mm = kBackWidthMm;    ///< along x, from 0
  double length_mm = kBackLengthMm;  ///< along y, from 0
  double jitter = 0.3;               ///< interior vertices move by up to half this share of a cell; 0 is a regular grid
};

/// An open sheet over a height field, counter-clockwise seen from +z, with coordinates rounded to float as a binary STL
/// stores them. The count is made exact by splitting border edges. Throws Error when it cannot be reached.
mesh::TriangleMesh sheet(const SheetSize& size, const HeightField& height);

/// The height of the benchmark's back at any (x, y), about 0 to 120 mm: a round torso, the long curvature, spinal
/// furrow, two scapulae and spinous processes.
double backHeight(double x, double y);

mesh::TriangleMesh backMesh(std::size_t triangles);
/// A V along y with its bottom at x = 100 mm, z = 0; the angle is the interior one.
mesh::TriangleMesh grooveMesh(double angle_deg);
/// The height of the groove above.
HeightField grooveHeight(double angle_deg);
/// An inverted pyramid: four concave edges that meet in (100, 100, 0).
mesh::TriangleMesh pitMesh();
/// Bumps of 6 mm pitch and +-2 mm.
mesh::TriangleMesh eggcrateMesh();
double eggcrateHeight(double x, double y);
/// 100 mm x 100 mm at z = 0.
mesh::TriangleMesh flatMesh(double jitter = 0.3);

/// The mesh called `back_N` (N triangles), `groove60`, `groove90`, `groove120`, `pit`, `eggcrate`, `flat100` or
/// `lattice100` (flat100 without jitter). Throws Error for another name.
mesh::TriangleMesh workloadMesh(std::string_view name);

/// Every name above, with the benchmark's eight sizes of the back.
std::vector<std::string> workloadMeshNames();

}  // namespace palpate::lab
