// Analytic normals against those recomputed from the deformed triangles: they converge as the mesh gets finer.
#include "palpate/deform/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/tests/deform/shapes.h"
#include "palpate/base/gaussian.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::deform {

struct Angles {
  double mean_deg = 0.0;
  double max_deg = 0.0;
};

double angleDeg(const Vec3f& a, const Vec3f& b) {
  const Vec3 u = a.cast<double>();
  const Vec3 v = b.cast<double>();
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 57.29577951308232;
}

/// The ellipse of the bounds: inside it, where q^2 < 0.8, normals are compared.
const maps::Ellipse kJudged{60.0, 0.8};
/// The bounds were measured with the profile exp(-4.5 q^2) in that ellipse. The half Gaussian has the rate 1.96 pi: the
/// same dent needs axes sqrt(1.96 pi / 4.5) times as long.
const maps::Ellipse kPressed{60.0 * std::sqrt(kGaussianRate / 4.5), 0.8};

/// 8 mm deep in the middle of the back.
Contact middlePress(const mesh::TriangleMesh& mesh) {
  Contact contact = test::press(mesh, test::triangleNear(mesh, {175, 200, 100}), 8.0);
  contact.normal_region = maps::liftedOntoSurface(kPressed, contact.normal);
  return contact;
}

bool isJudged(const Contact& contact, const Vec3& place) {
  const Vec3 in_plane = maps::projectedOnPlane(place, contact.anchor, contact.normal) - contact.anchor;
  return std::pow(maps::locationRatio(maps::liftedOntoSurface(kJudged, contact.normal), in_plane), 2) < 0.8;
}

Angles differenceOfNormals(const mesh::TriangleMesh& mesh, const std::vector<Contact>& contacts) {
  const auto analytic = deformed(mesh, contacts);
  Settings settings;
  settings.normals = Normals::recomputed;
  const auto recomputed = deformed(mesh, contacts, settings);
  Angles angles;
  double count = 0.0;
  for (Index v = 0; v < analytic.vertices(); ++v) {
    if (!isJudged(contacts.front(), mesh.positions[v])) continue;
    const double angle = angleDeg(analytic.normalAt(v), recomputed.normalAt(v));
    angles.max_deg = std::max(angles.max_deg, angle);
    angles.mean_deg += angle;
    count += 1.0;
  }
  angles.mean_deg /= count;
  return angles;
}

struct Bound {
  std::size_t triangles;
  double mean_deg;
  double max_deg;
};

TEST(AnalyticNormals, AgreeWithTheTrianglesAsTheyGetFiner) {
  for (const auto& [triangles, mean_deg, max_deg] :
       {Bound{2962, 1.07, 3.8}, Bound{20389, 0.34, 1.9}, Bound{41582, 0.24, 1.5}, Bound{200000, 0.10, 0.8}}) {
    const auto mesh = lab::backMesh(triangles);
    const Angles angles = differenceOfNormals(mesh, {middlePress(mesh)});
    EXPECT_LE(angles.mean_deg, mean_deg) << triangles;
    EXPECT_LE(angles.max_deg, max_deg) << triangles;
  }
}

TEST(AnalyticNormals, HoldForADrag) {
  const auto mesh = lab::backMesh(200000);
  Contact contact = test::drag(middlePress(mesh), {8, 4, 0});
  contact.tangential_region = contact.normal_region;
  const Angles angles = differenceOfNormals(mesh, {contact});
  EXPECT_LE(angles.mean_deg, 0.10);
  EXPECT_LE(angles.max_deg, 0.8);
}

TEST(AnalyticNormals, HoldForOverlappingContacts) {
  const auto mesh = lab::backMesh(200000);
  Contact second = test::drag(test::press(mesh, test::triangleNear(mesh, {195, 190, 100}), 6.0), {-5, 5, 0});
  second.normal_region = maps::liftedOntoSurface({50.0, 0.7, 0.4}, second.normal);
  Contact third = test::drag(test::press(mesh, test::triangleNear(mesh, {160, 215, 100}), 7.0), {0, 4, 0});
  third.normal_region = maps::liftedOntoSurface({50.0, 0.9, 2.4}, third.normal);
  const Angles angles = differenceOfNormals(mesh, {middlePress(mesh), second, third});
  EXPECT_LE(angles.mean_deg, 0.15);
  EXPECT_LE(angles.max_deg, 1.6);
}

TEST(RecomputedNormals, AreThoseOfTheMeshRoom) {
  const auto mesh = lab::backMesh(6261);
  const Contact contact = middlePress(mesh);
  Settings settings;
  settings.normals = Normals::recomputed;
  const auto surface = deformed(mesh, {&contact, 1}, settings);
  mesh::TriangleMesh moved = mesh;
  for (Index v = 0; v < surface.vertices(); ++v) moved.positions[v] = surface.positionAt(v).cast<double>();
  const auto expected = mesh::vertexNormals(moved);
  for (Index v = 0; v < surface.vertices(); ++v) {
    ASSERT_LT((surface.normalAt(v).cast<double>() - expected[v]).norm(), 1e-6) << v;
  }
}

TEST(AnalyticNormals, AreOfUnitLength) {
  const auto mesh = test::torso();
  const Skin skin = buildSkin(mesh);
  Deformer deformer(skin);
  DeformedSurface surface(skin);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    deformer.apply(std::vector<Contact>{test::anyContact(mesh, random), test::anyContact(mesh, random)}, surface);
    for (Index v = 0; v < skin.vertices; ++v) ASSERT_NEAR(surface.normalAt(v).norm(), 1.0f, 1e-5f);
  }
}

}  // namespace palpate::deform
