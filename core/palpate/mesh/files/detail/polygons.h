// Polygons of a file -> triangles.
//
// The readers of OBJ, PLY and OFF collect faces here, because a face may come before its vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Appends corners - 2 triangles with the polygon's winding; none for fewer than 3 corners. A square is cut along the
/// diagonal that folds it least. Indices may be out of range or repeated: then it is cut as a fan from its first
/// corner, like every polygon of more than 64 corners (clipping may cost the cube of their number).
void triangulate(const std::vector<Vec3>& positions, std::span<const Index> polygon, std::vector<Triangle>& triangles);

/// How a file counts: what its places are called and which number its first vertex has.
struct FileCounting {
  enum class Place : std::uint8_t { line, byte };
  std::string_view name;
  Place place = Place::line;
  Index first_vertex = 0;
};

class PolygonList {
 public:
  void addCorner(Index vertex) { corners_.push_back(vertex); }
  /// Ends the polygon whose corners were added since the last call. `place`: its line or byte in the file.
  void close(std::size_t place) { polygons_.push_back({corners_.size(), place}); }
  /// Forgets the corners that were added since the last `close`.
  void dropOpen() { corners_.resize(polygons_.empty() ? 0 : polygons_.back().end); }
  std::size_t openCorners() const { return corners_.size() - (polygons_.empty() ? 0 : polygons_.back().end); }

  /// Cuts all polygons into `mesh.triangles`. Throws Error at the place of the first one with a wrong index, unless
  /// those are to be kept.
  void cut(TriangleMesh& mesh, const FileCounting& counting, bool keep_wrong_indices) const;

 private:
  struct Polygon {
    std::size_t end;  // behind its last corner
    std::size_t place;
  };
  std::vector<Index> corners_;
  std::vector<Polygon> polygons_;
};

}  // namespace palpate::mesh
