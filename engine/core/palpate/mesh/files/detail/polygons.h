// Polygons of a file -> triangles.
//
// The readers of OBJ, PLY and OFF collect faces here, because a face may come before its vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/mesh/files/detail/passed_over.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// `guessed`: the polygon has no area of its own to cut (it crosses itself, seen along its mean normal) and got the
/// surface of least area over its corners. `impossible`: the same with too many corners for that.
enum class PolygonCut : std::uint8_t { exact, guessed, impossible };

/// Appends triangles over the polygon's corners, with its winding; none for fewer than 3 corners. A square is cut along
/// the diagonal that folds it least, a longer one to the area of its outline (outline_cut.h), with holes where bridges
/// lead to them. Corners may be out of range or unusable: then it is cut as a fan, for `validate` to count.
PolygonCut triangulate(const std::vector<Vec3>& positions, std::span<const Index> polygon,
                       std::vector<Triangle>& triangles);

/// Numbering of a file: the unit of its places and the number of its first vertex.
struct FileCounting {
  std::string_view name;
  FilePlace place = FilePlace::line;
  Index first_vertex = 0;
};

class PolygonList {
 public:
  void addCorner(Index vertex) { corners_.push_back(vertex); }
  /// Ends the polygon whose corners were added since the last call. `place`: its line or byte in the file.
  void close(std::size_t place) { polygons_.push_back({corners_.size(), place}); }
  /// Forgets the corners that were added since the last `close`.
  void dropOpen() { corners_.resize(polygons_.empty() ? 0 : polygons_.back().end); }
  bool empty() const { return polygons_.empty(); }

  /// Cuts all polygons into `mesh.triangles`; those of fewer than three corners are noted in `passed_over`, and so are
  /// guesses. Throws Error at the place of the first one with a wrong index, unless those are to be kept, and of one
  /// that cannot be cut.
  void cut(TriangleMesh& mesh, const FileCounting& counting, bool keep_wrong_indices, PassedOver& passed_over) const;

 private:
  struct Polygon {
    std::size_t end;  // behind its last corner
    std::size_t place;
  };
  std::vector<Index> corners_;
  std::vector<Polygon> polygons_;
};

}  // namespace palpate::mesh
