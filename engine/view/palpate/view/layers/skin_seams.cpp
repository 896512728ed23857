// Corners sorted by their vertex; each new place in the picture gets the vertex itself first and a copy after that.
#include "palpate/view/layers/skin_chunks.h"

#include <algorithm>

namespace palpate::view {

namespace {

/// A corner of a triangle: the skin's vertex there and its place in the picture.
struct SkinCorner {
  Index vertex;
  Index corner;  // 3 * triangle + 0, 1 or 2
};

/// All corners of the skin, those of one vertex together, in the order of the triangles.
std::vector<SkinCorner> cornersByVertex(std::span<const Triangle> triangles) {
  std::vector<SkinCorner> corners;
  corners.reserve(3 * triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) {
    for (Index i = 0; i < 3; ++i) corners.push_back({triangles[t][i], 3 * t + i});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const SkinCorner& a, const SkinCorner& b) { return a.vertex < b.vertex; });
  return corners;
}

bool isSamePlace(const mesh::TexturePlace& a, const mesh::TexturePlace& b) {
  return (a - b).cwiseAbs().maxCoeff() < kSamePlace;
}

/// Gives the corners of one vertex their drawn vertices.
class VertexSplitter {
 public:
  VertexSplitter(std::span<const mesh::TextureCorners> corners, DrawnVertices& drawn)
      : corners_(corners), drawn_(drawn), has_place_(drawn.of_skin, false) {}

  void split(std::span<const SkinCorner> corners) {
    const auto first_copy = drawn_.copied.size();
    for (const SkinCorner& corner : corners) {
      const mesh::TexturePlace& place = corners_[corner.corner / 3][corner.corner % 3];
      drawn_.triangles[corner.corner / 3][corner.corner % 3] = drawnFor(corner.vertex, place, first_copy);
    }
  }

 private:
  Index drawnFor(Index vertex, const mesh::TexturePlace& place, std::size_t first_copy) {
    if (!has_place_[vertex]) {
      has_place_[vertex] = true;
      drawn_.places[vertex] = place;
      return vertex;
    }
    if (isSamePlace(drawn_.places[vertex], place)) return vertex;
    for (std::size_t copy = first_copy; copy < drawn_.copied.size(); ++copy) {
      const std::size_t drawn = drawn_.of_skin + copy;
      if (isSamePlace(drawn_.places[drawn], place)) return static_cast<Index>(drawn);
    }
    drawn_.copied.push_back(vertex);
    drawn_.places.push_back(place);
    return drawn_.count() - 1;
  }

  std::span<const mesh::TextureCorners> corners_;
  DrawnVertices& drawn_;
  std::vector<bool> has_place_;
};

}  // namespace

DrawnVertices drawnVertices(Index vertices, std::span<const Triangle> triangles) {
  return {vertices, {}, {triangles.begin(), triangles.end()}, {}};
}

DrawnVertices drawnVertices(Index vertices, std::span<const Triangle> triangles,
                            std::span<const mesh::TextureCorners> corners) {
  DrawnVertices drawn = drawnVertices(vertices, triangles);
  drawn.places.assign(vertices, mesh::TexturePlace::Zero());
  const std::vector<SkinCorner> sorted = cornersByVertex(triangles);
  VertexSplitter splitter(corners, drawn);
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto other = [&](const SkinCorner& corner) { return corner.vertex != first->vertex; };
    const auto end = std::find_if(first, sorted.end(), other);
    splitter.split({first, end});
    first = end;
  }
  return drawn;
}

deform::VertexRange DrawnVertices::copiesIn(const deform::VertexRange& range) const {
  const auto number = [&](Index v) {
    return static_cast<Index>(std::lower_bound(copied.begin(), copied.end(), v) - copied.begin());
  };
  return {number(range.first), number(range.end)};
}

std::vector<std::uint8_t> DrawnVertices::nearSeam() const {
  std::vector<std::uint8_t> on_seam(count(), 0);
  for (std::size_t copy = 0; copy < copied.size(); ++copy) on_seam[of_skin + copy] = on_seam[copied[copy]] = 1;
  std::vector<std::uint8_t> near = on_seam;
  for (const auto& [a, b, c] : triangles) {
    if (on_seam[a] + on_seam[b] + on_seam[c] > 0) near[a] = near[b] = near[c] = 1;
  }
  return near;
}

}  // namespace palpate::view
