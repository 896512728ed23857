
#include <gtest/gtest.h>

#include <set>

#include "palpate/deform/skin.h"
#include "palpate/view/layers/skin_chunks.h"
#include "support/mesh_zoo.h"
#include "support/textured_bytes.h"

namespace palpate::view {
namespace {

DrawnVertices makeDrawnVertices(const mesh::TriangleMesh& mesh, const support::TextureLaw& law) {
  return drawnVertices(static_cast<Index>(mesh.positions.size()), mesh.triangles, support::cornersBy(law, mesh));
}

Index sourceVertex(const DrawnVertices& drawn, Index v) {
  return v < drawn.of_skin ? v : drawn.copied[v - drawn.of_skin];
}

TEST(DrawnVertices, AreThoseOfTheSkinWithoutASeam) {
  const mesh::TriangleMesh sheet = zoo::grid(8, 100.0);
  for (const DrawnVertices& drawn : {makeDrawnVertices(sheet, support::onSheet),
                                     drawnVertices(static_cast<Index>(sheet.positions.size()), sheet.triangles)}) {
    EXPECT_EQ(drawn.count(), sheet.positions.size());
    EXPECT_EQ(drawn.triangles, sheet.triangles);
  }
}

TEST(DrawnVertices, HaveACopyForEachFurtherSideOfASeam) {
  const DrawnVertices drawn = makeDrawnVertices(zoo::cube(), support::onCube);
  EXPECT_EQ(drawn.of_skin, 8u);
  EXPECT_EQ(drawn.copied.size(), 8u * 2u) << "three sides meet in a corner";
  EXPECT_EQ(drawn.places.size(), drawn.count());
  EXPECT_TRUE(std::is_sorted(drawn.copied.begin(), drawn.copied.end()));
}

TEST(DrawnVertices, PutEveryCornerWhereTheTextureWantsIt) {
  for (const auto& [mesh, law] : {std::pair{zoo::cube(), support::TextureLaw(support::onCube)},
                                  std::pair{zoo::sphere(), support::TextureLaw(support::onSphere)}}) {
    const DrawnVertices drawn = makeDrawnVertices(mesh, law);
    const auto corners = support::cornersBy(law, mesh);
    for (std::size_t t = 0; t < corners.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(sourceVertex(drawn, drawn.triangles[t][i]), mesh.triangles[t][i]);
        EXPECT_LT((drawn.places[drawn.triangles[t][i]] - corners[t][i]).norm(), 2.0f * kSamePlace);
      }
    }
  }
}

TEST(DrawnVertices, CopyOnlyTheSeam) {
  const mesh::TriangleMesh ball = zoo::sphere(20.0, 4);
  const DrawnVertices drawn = makeDrawnVertices(ball, support::onSphere);
  EXPECT_LT(drawn.copied.size(), ball.positions.size() / 10);
  for (const Index v : drawn.copied) {
    const Vec3& p = ball.positions[v];
    const bool on_seam = p.x() < 0.0 && std::abs(p.y()) < 20.0 * 0.1;
    EXPECT_TRUE(on_seam || p.head<2>().norm() < 1e-6) << p.transpose();
  }
}

TEST(DrawnVertices, KnowTheCopiesOfARange) {
  const DrawnVertices drawn = makeDrawnVertices(zoo::sphere(20.0, 4), support::onSphere);
  Index covered = 0;
  for (Index first = 0; first < drawn.of_skin; first += 64) {
    const Index end = std::min(first + 64, drawn.of_skin);
    const deform::VertexRange copies = drawn.copiesIn({first, end});
    EXPECT_EQ(copies.first, covered) << "one after the other";
    for (Index copy = copies.first; copy < copies.end; ++copy) {
      EXPECT_GE(drawn.copied[copy], first);
      EXPECT_LT(drawn.copied[copy], end);
    }
    covered = copies.end;
  }
  EXPECT_EQ(covered, drawn.copied.size());
}

TEST(DrawnVertices, ValuesOfCopiesAreThoseOfTheirVertices) {
  const DrawnVertices drawn = makeDrawnVertices(zoo::cube(), support::onCube);
  const std::vector<int> values = {0, 1, 2, 3, 4, 5, 6, 7};
  const std::vector<int> all = drawn.withCopies<int>(values);
  ASSERT_EQ(all.size(), drawn.count());
  for (Index v = 0; v < drawn.count(); ++v) EXPECT_EQ(all[v], static_cast<int>(sourceVertex(drawn, v)));
}

/// A triangle that reached across the seam would show the whole picture within its own width.
TEST(CoarserTriangles, DoNotReachAcrossASeam) {
  const mesh::TriangleMesh ball = zoo::sphere(50.0, 5);
  const deform::Skin skin = deform::buildSkin(ball);
  const DrawnVertices drawn = makeDrawnVertices(ball, support::onSphere);
  std::vector<Vec3f> places, normals;
  for (Index v = 0; v < skin.vertices; ++v) {
    places.push_back(skin.restPosition(v));
    normals.push_back(skin.restNormal(v));
  }
  std::vector<Required> stays;
  for (const std::uint8_t near : drawn.nearSeam()) stays.push_back(near != 0 ? Required::cell : Required::no);
  places = drawn.withCopies<Vec3f>(places);
  normals = drawn.withCopies<Vec3f>(normals);
  const auto coarse = coarserTriangles({places, normals, drawn.triangles}, stays, 4.0f);
  EXPECT_LT(coarse.size(), ball.triangles.size() / 2);
  for (const Triangle& t : coarse) {
    const float pole = std::max({std::abs(places[t[0]].z()), std::abs(places[t[1]].z()), std::abs(places[t[2]].z())});
    if (pole > 45.0f) continue;  // there u turns fast without a seam
    float low = 2.0f, high = -2.0f;
    for (const Index v : t) {
      low = std::min(low, drawn.places[v].x());
      high = std::max(high, drawn.places[v].x());
    }
    EXPECT_LT(high - low, 0.15f) << "u from " << low << " to " << high;
  }
}

}  // namespace
}  // namespace palpate::view
