// The built-in back without relief and asymmetry, and the built-in hand, at the printed numbers of triangles. Own.
#include "study/measured/model_meshes.h"

#include "palpate/body/back.h"
#include "palpate/body/hand.h"

namespace palpate::study {

namespace {

body::Skin backSkin(std::size_t triangles) {
  return body::makeBackSkin(
      {.triangles = triangles, .shape = {.stature_mm = 1750, .relief = body::noRelief(), .asymmetry = 0}});
}

}  // namespace

mesh::TriangleMesh backModel(std::size_t triangles) { return backSkin(triangles).mesh; }

mesh::TriangleMesh handModel() { return body::makeHand({.triangles = kHandTriangles}); }

std::vector<Vec2> backOutline() {
  const body::Skin skin = backSkin(kBackTriangles);
  std::vector<Vec2> outline;
  outline.reserve(skin.border);
  for (Index v = 0; v < skin.border; ++v) outline.emplace_back(skin.mesh.positions[v].head<2>());
  return outline;
}

bool isInside(const std::vector<Vec2>& polygon, const Vec2& place) {
  bool inside = false;  // an odd number of sides crosses the ray to the right
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    if (place.x() < a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace palpate::study
