// The built-in back without relief and asymmetry, and the built-in hand, at the printed numbers of triangles.
#include "lab/measured/model_meshes.h"

#include <algorithm>
#include <set>

#include "palpate/body/back.h"
#include "palpate/body/hand.h"
#include "palpate/mesh/topology.h"

namespace palpate::study {

namespace {

body::Skin backSkin(std::size_t triangles) {
  return body::makeBackSkin(
      {.triangles = triangles, .shape = {.stature_mm = 1750, .relief = body::noRelief(), .asymmetry = 0}});
}

}  // namespace

mesh::TriangleMesh backModel(std::size_t triangles) { return backSkin(triangles).mesh; }

mesh::TriangleMesh handModel() { return body::makeHand({.triangles = kHandTriangles}); }

mesh::TriangleMesh openHandModel(std::size_t triangles) {
  // A hole of n edges without a vertex inside is n - 2 triangles wide.
  const std::size_t hole = triangles == kNamelessTriangles ? 12 : 14;
  mesh::TriangleMesh hand = body::makeHand({.triangles = triangles + hole});
  const auto neighbours = mesh::neighboursOfTriangles(hand);
  const auto is_nearer_wrist = [&](const Triangle& a, const Triangle& b) {
    return centreOf(hand, a).y() < centreOf(hand, b).y();
  };
  const auto first = static_cast<Index>(
      std::min_element(hand.triangles.begin(), hand.triangles.end(), is_nearer_wrist) - hand.triangles.begin());
  std::vector<Index> cut{first};
  std::set<Index> seen(hand.triangles[first].begin(), hand.triangles[first].end());
  // Each triangle that is joined on has a vertex of its own, so that none comes to lie inside.
  for (std::size_t i = 0; i < cut.size() && cut.size() < hole; ++i) {
    for (const Index next : neighbours[cut[i]]) {
      std::size_t known = 0;
      for (const Index corner : hand.triangles[next]) known += seen.count(corner);
      if (known != 2 || cut.size() == hole) continue;
      cut.push_back(next);
      seen.insert(hand.triangles[next].begin(), hand.triangles[next].end());
    }
  }
  std::sort(cut.rbegin(), cut.rend());
  for (const Index t : cut) hand.triangles.erase(hand.triangles.begin() + t);
  return hand;
}

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
