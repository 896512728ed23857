#include "palpate/view/layers/skin_chunks.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"
#include "palpate/mesh/reorder.h"
#include "palpate/tree/triangle_tree.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

std::vector<Vec3f> placesOf(const deform::Skin& skin) {
  std::vector<Vec3f> places;
  for (Index v = 0; v < skin.vertices; ++v) places.push_back(skin.restPosition(v));
  return places;
}

std::vector<Vec3f> normalsOf(const deform::Skin& skin) {
  std::vector<Vec3f> normals;
  for (Index v = 0; v < skin.vertices; ++v) normals.push_back(skin.restNormal(v));
  return normals;
}

std::vector<Triangle> coarserTriangles(const deform::Skin& skin, std::span<const Required> stays, float cell_mm) {
  return coarserTriangles({placesOf(skin), normalsOf(skin), skin.triangles}, stays, cell_mm);
}

/// 1 for an index that is drawn; fails for one that is drawn twice.
std::vector<int> drawn(const SplitRuns& runs, std::size_t indices) {
  std::vector<int> count(indices, 0);
  for (const auto& list : {runs.touched, runs.plain}) {
    for (const IndexRun& run : list) {
      for (Index i = run.first; i < run.first + run.count; ++i) ++count[i];
    }
  }
  for (const int c : count) EXPECT_LE(c, 1);
  return count;
}

mesh::TriangleMesh ordered(mesh::TriangleMesh mesh) {
  mesh::reorderSpatially(mesh);
  return mesh;
}

struct Sheet {
  mesh::TriangleMesh mesh = ordered(zoo::grid(80, 300.0));
  SkinChunks chunks{placesOf(deform::buildSkin(mesh)), mesh.triangles};
  Camera camera = fitted(mesh::boundingBox(mesh), 1.5);
  Mat4f clip() const { return makeFrustum(cameraScreen(camera, 1.5), camera.eye(), 10.0, 5000.0).clip(); }
  Vec3 triangleCentre(Index triangle) const { return centreOf(mesh, mesh.triangles[triangle]); }
};

TEST(SkinChunks, DrawEveryTriangleOnceWhenAllIsSeen) {
  Sheet sheet;
  const Influence finger{{150, 150, 0}, {150, 150, 0}, 30.0f};
  const auto& runs = sheet.chunks.split(sheet.clip(), {&finger, 1});
  EXPECT_FALSE(runs.touched.empty());
  EXPECT_FALSE(runs.plain.empty());
  for (const int count : drawn(runs, 3 * sheet.mesh.triangles.size())) EXPECT_EQ(count, 1);
}

TEST(SkinChunks, CountAsTouchedAllThatIsNearAFinger) {
  Sheet sheet;
  const Influence finger{{100, 100, 0}, {200, 100, 0}, 20.0f};
  const auto& runs = sheet.chunks.split(sheet.clip(), {&finger, 1});
  EXPECT_FALSE(runs.plain.empty()) << "and not everything";
  for (const IndexRun& run : runs.plain) {
    for (Index i = run.first; i < run.first + run.count; i += 3) {
      const Vec3 middle = sheet.triangleCentre(i / 3);
      const double x = std::clamp(middle.x(), 100.0, 200.0);
      EXPECT_GT((middle - Vec3(x, 100.0, 0.0)).norm(), 20.0);
    }
  }
}

TEST(SkinChunks, LeaveOutOnlyWhatIsOutsideThePicture) {
  Sheet sheet;
  sheet.camera.distance_mm *= 0.2;
  const Frustum frustum = makeFrustum(cameraScreen(sheet.camera, 1.5), sheet.camera.eye(), 10.0, 5000.0);
  const auto count = drawn(sheet.chunks.split(sheet.clip(), {}), 3 * sheet.mesh.triangles.size());
  std::size_t left_out = 0;
  for (Index t = 0; t < sheet.mesh.triangles.size(); ++t) {
    if (count[std::size_t{3} * t] == 1) continue;
    ++left_out;
    const Vec2 seen = seenAt(frustum, sheet.triangleCentre(t));
    EXPECT_FALSE(seen.x() > 0.0 && seen.x() < 1.0 && seen.y() > 0.0 && seen.y() < 1.0);
  }
  EXPECT_GT(left_out, sheet.mesh.triangles.size() / 2);
}

/// What each chunk is by itself, without the tree: the sphere of its box against the planes and the influences.
std::vector<int> drawnChunkByChunk(const Sheet& sheet, const Mat4f& clip, std::span<const Influence> influences) {
  constexpr std::size_t kChunk = 64;
  const std::vector<Vec3f> places = placesOf(deform::buildSkin(sheet.mesh));
  std::vector<int> count(3 * sheet.mesh.triangles.size(), 0);
  for (std::size_t first = 0; first < sheet.mesh.triangles.size(); first += kChunk) {
    const std::size_t end = std::min(first + kChunk, sheet.mesh.triangles.size());
    SkinChunks alone(places, std::span(sheet.mesh.triangles).subspan(first, end - first));
    const SplitRuns& runs = alone.split(clip, influences);
    const int is = runs.plain.empty() ? (runs.touched.empty() ? 0 : 2) : 1;
    std::fill(count.begin() + static_cast<std::ptrdiff_t>(3 * first),
              count.begin() + static_cast<std::ptrdiff_t>(3 * end), is);
  }
  return count;
}

// The tree over the chunks decides for many at once, and never otherwise than they would one by one.
TEST(SkinChunks, AreChosenByTheirTreeAsEachWouldBe) {
  Sheet sheet;
  const Influence finger{{100, 120, 0}, {180, 120, 0}, 15.0f};
  for (const double nearness : {1.0, 0.6, 0.3, 0.1}) {
    for (const double yaw : {0.0, 0.7}) {
      Camera camera = sheet.camera;
      camera.distance_mm *= nearness;
      camera.yaw_rad = yaw;
      camera.centre += Vec3(40.0, -30.0, 0.0);
      const Mat4f clip = makeFrustum(cameraScreen(camera, 1.5), camera.eye(), 10.0, 5000.0).clip();
      const auto expected = drawnChunkByChunk(sheet, clip, {&finger, 1});
      const SplitRuns& runs = sheet.chunks.split(clip, {&finger, 1});
      std::vector<int> found(expected.size(), 0);
      for (const IndexRun& run : runs.plain) std::fill_n(found.begin() + run.first, run.count, 1);
      for (const IndexRun& run : runs.touched) std::fill_n(found.begin() + run.first, run.count, 2);
      ASSERT_EQ(found, expected) << nearness << " " << yaw;
    }
  }
}

TEST(SkinChunks, AreMostlyNotLookedAtWhereAllOrNothingIsSeen) {
  Sheet sheet;
  const std::size_t chunks = sheet.mesh.triangles.size() / 64;
  sheet.camera.distance_mm *= 2.0;
  sheet.chunks.split(sheet.clip(), {});
  EXPECT_LT(sheet.chunks.tested(), chunks / 4);
  EXPECT_EQ(sheet.chunks.split(sheet.clip(), {}).plain.size(), 1u);
  sheet.camera.centre += Vec3(5000.0, 0.0, 0.0);
  sheet.chunks.split(sheet.clip(), {});
  EXPECT_LT(sheet.chunks.tested(), chunks / 4);
}

TEST(SkinChunks, AreAllTakenWithoutCulling) {
  Sheet sheet;
  sheet.camera.distance_mm *= 0.1;
  for (const int count : drawn(sheet.chunks.split(sheet.clip(), {}, false), 3 * sheet.mesh.triangles.size())) {
    EXPECT_EQ(count, 1);
  }
}

TEST(CoarserTriangles, CoverTheSameSkinWithFewerOfItsVertices) {
  const mesh::TriangleMesh ball = zoo::sphere(50.0, 5);
  const deform::Skin skin = deform::buildSkin(ball);
  const std::vector<Required> none(skin.vertices, Required::no);
  mesh::TriangleMesh coarse;
  for (Index v = 0; v < skin.vertices; ++v) coarse.positions.push_back(skin.restPosition(v).cast<double>());
  coarse.triangles = coarserTriangles(skin, none, 8.0f);
  EXPECT_LT(coarse.triangles.size(), skin.triangles.size() / 4);
  const tree::TriangleTree tree = tree::buildTriangleTree(coarse);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 way = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    const auto hit = tree::firstFrontCrossing(tree, 100.0 * way, Vec3::Zero());
    ASSERT_NE(hit.triangle, kNoIndex) << "a hole";
    EXPECT_NEAR(hit.point.norm(), 50.0, 2.0);
  }
}

TEST(CoarserTriangles, KeepTheVerticesThatAreFixed) {
  const mesh::TriangleMesh grid = zoo::grid(40, 100.0);
  const deform::Skin skin = deform::buildSkin(grid);
  std::vector<Required> stays(skin.vertices, Required::no);
  for (Index v = 0; v < skin.vertices; ++v) {
    if (skin.triangles_of_vertex[v].size() < 6) stays[v] = Required::vertex;
  }
  std::vector<std::uint8_t> used(skin.vertices, 0);
  for (const Triangle& t : coarserTriangles(skin, stays, 20.0f)) {
    for (const Index v : t) used[v] = 1;
  }
  for (Index v = 0; v < skin.vertices; ++v) {
    EXPECT_TRUE(used[v] == 1 || stays[v] == Required::no) << skin.restPosition(v).transpose();
  }
}

}  // namespace
}  // namespace palpate::view
