// Regularity of a mesh's triangles: `palpate body info --shape`, and the table of docs/explanation/bodies.md.
#pragma once

#include <string>

#include "palpate/base/json.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::app {

/// Nearest-rank percentiles of one measure over a mesh; all zero for none.
struct ShapeSpread {
  double least = 0, p1 = 0, p50 = 0, p99 = 0, most = 0;
};

struct TriangleShapes {
  ShapeSpread fold_deg;      ///< per edge between two triangles: the angle between their normals, 0 flat
  ShapeSpread aspect;        ///< per triangle: circumradius over twice the inradius, 1 equilateral
  ShapeSpread angle_deg;     ///< per triangle: its smallest angle, at most 60
  ShapeSpread area_of_mean;  ///< per triangle: its area over the mean one
  double area_deviation = 0;
  double mean_edge_mm = 0;
};

/// Triangles without area are left out.
TriangleShapes triangleShapes(const mesh::TriangleMesh& mesh);

std::string asText(const TriangleShapes& shapes);
Json asJson(const TriangleShapes& shapes);

}  // namespace palpate::app
