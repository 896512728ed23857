// The texture of one mesh on another mesh of the same surface: each corner looks up the nearest place of the textured
// one and uses its barycentric shares there. Load time, after repair and reordering (scene/skin_texture.cpp).
#include "palpate/mesh/textured_mesh.h"

#include "palpate/mesh/nearest.h"

namespace palpate::mesh {

namespace {

/// A corner is looked up this share of the way towards the middle of its triangle: farther than welding and mending
/// move a vertex, so that the side of a seam is certain; so little that on a surface cut into other triangles the
/// picture is displaced by no more than this share of a triangle.
constexpr double kInwards = 0.01;

/// Shares of the corners in the point of the triangle that is nearest to p; never negative.
Vec3 sharesAt(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 nearest = nearestOnTriangle(p, a, b, c);
  const Vec3 normal = areaVector2(a, b, c);
  const double squared = normal.squaredNorm();
  if (!(squared > 0.0)) return {1.0, 0.0, 0.0};
  const Vec3 shares(areaVector2(b, c, nearest).dot(normal), areaVector2(c, a, nearest).dot(normal),
                    areaVector2(a, b, nearest).dot(normal));
  return (shares / squared).cwiseMax(0.0);
}

class TextureLookup {
 public:
  explicit TextureLookup(const TexturedMesh& textured)
      : textured_(textured), triangles_(textured.mesh), reach_(nearReach(textured.mesh)) {}

  TextureCorners cornersOf(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 middle = (a + b + c) / 3.0;
    return {placeOf(a, middle), placeOf(b, middle), placeOf(c, middle)};
  }

 private:
  /// Nearly every corner is on the surface: a small reach finds it several times faster.
  static double nearReach(const TriangleMesh& mesh) {
    constexpr double kOfDiagonal = 1e-4;
    return kOfDiagonal * boundingBox(mesh).diagonal().norm();
  }

  TexturePlace placeOf(const Vec3& corner, const Vec3& middle) const {
    const Vec3 inside = corner + kInwards * (middle - corner);
    NearestTriangle::Hit hit = triangles_.find(inside, reach_);
    if (hit.triangle == kNoIndex) hit = triangles_.find(inside);
    if (hit.triangle == kNoIndex) return TexturePlace::Zero();  // so far away that distances overflow
    const auto& [a, b, c] = textured_.mesh.triangles[hit.triangle];
    const auto& at = textured_.mesh.positions;
    const Vec3f shares = sharesAt(corner, at[a], at[b], at[c]).cast<float>();
    return shares[0] * textured_.places[a] + shares[1] * textured_.places[b] + shares[2] * textured_.places[c];
  }

  const TexturedMesh& textured_;
  NearestTriangle triangles_;
  double reach_;
};

}  // namespace

std::vector<TextureCorners> textureOn(const TriangleMesh& mesh, const TexturedMesh& textured,
                                      const Progress& progress) {
  constexpr std::size_t kBetweenReports = 1 << 16;
  const TextureLookup lookup(textured);
  std::vector<TextureCorners> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    if (corners.size() % kBetweenReports == 0) {
      report(progress, "laying the texture",
             static_cast<double>(corners.size()) / static_cast<double>(mesh.triangles.size()));
    }
    corners.push_back(lookup.cornersOf(mesh.positions[a], mesh.positions[b], mesh.positions[c]));
  }
  return corners;
}

}  // namespace palpate::mesh
