#include "palpate/deform/deformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/tests/deform/golden_grid.h"
#include "core/tests/deform/scalar_reference.h"
#include "core/tests/deform/stage.h"
#include "support/golden.h"

namespace palpate::deform {

using test::anyContact;
using test::bits;
using test::drag;
using test::press;
using test::Stage;
using test::triangleNear;

TEST(Deformer, DeformsTheReferenceGrid) {
  Stage stage(test::goldenGrid());
  int cases = 0;
  for (const auto& c : test::goldenRows("fsmd_grid", "cases")) {
    if (c["mode"] != "recommended") continue;
    ++cases;
    const Contact contact = test::goldenContact(stage.mesh, c);
    stage.apply({contact});

    std::vector<bool> listed(stage.skin.vertices, false);
    for (const auto& v : c["vertices"]) {
      const auto index = v["index"].get<Index>();
      listed[index] = true;
      EXPECT_LT((stage.surface.positionAt(index).cast<double>() - test::vec3(v["position"])).norm(), 1e-4) << v;
    }
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      if (!listed[v]) {
        EXPECT_LT(stage.surface.displacementAt(v).norm(), 1e-5f) << c["name"] << " " << v;
      }
    }
  }
  EXPECT_EQ(cases, 4);
}

TEST(Deformer, AgreesWithTheScalarReferenceForAnyContact) {
  for (auto& mesh : {lab::backMesh(6261), test::torso()}) {
    Stage stage(mesh, test::formulaeAlone());
    Random random(23);
    for (int i = 0; i < 100; ++i) {
      const Contact contact = anyContact(stage.mesh, random);
      stage.apply({contact});
      const auto expected = test::displacementsOf(stage.skin, test::scalarContact(contact));
      for (Index v = 0; v < stage.skin.vertices; ++v) {
        ASSERT_LT((stage.surface.displacementAt(v).cast<double>() - expected[v]).norm(), 1e-4) << i << " " << v;
        const Vec3 position = test::restPoint(stage.skin, v) + expected[v];
        ASSERT_LT((stage.surface.positionAt(v).cast<double>() - position).norm(), 1e-4) << i << " " << v;
      }
    }
  }
}

TEST(Deformer, SkinAtTheAnchorFollowsTheTip) {
  Stage stage(lab::backMesh(20389));
  const Index triangle = triangleNear(stage.mesh, {175, 200, 80});
  const Contact contact = drag(press(stage.mesh, triangle, 6.0, Vec3(1, 0, 0)), {4, 3, 0});
  stage.apply({contact});
  const Vec3 tip = contact.anchor + contact.drag_mm - contact.depth_mm * contact.normal;
  EXPECT_LT((stage.surface.positionAt(stage.mesh.triangles[triangle][0]).cast<double>() - tip).norm(), 1e-4);
}

TEST(Deformer, NothingMovesOutsideTheRegion) {
  Stage stage(lab::backMesh(8163));
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Contact contact = anyContact(stage.mesh, random);
    stage.apply({contact});
    const auto scalar = test::scalarContact(contact);
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      const Vec3 p = test::restPoint(stage.skin, v);
      if (std::min(scalar.normalRatio(p), scalar.tangentialRatio(p)) < 1.0 + 1e-5) continue;
      ASSERT_TRUE(stage.surface.displacementAt(v).isZero(0.0f));
      ASSERT_EQ(stage.surface.positionAt(v), stage.skin.restPosition(v));
      ASSERT_EQ(stage.surface.normalAt(v), stage.skin.restNormal(v));
    }
  }
}

TEST(Deformer, LooksAtAllThatItMovesAndAtRestAtNothing) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage stage(lab::backMesh(8163), {}, way);
    const Report report = stage.apply({press(stage.mesh, 1000, 6.0)});
    EXPECT_GT(report.moved_vertices, 0u);
    EXPECT_GE(report.visited_vertices, report.moved_vertices);
    EXPECT_EQ(stage.apply({}).visited_vertices, 0u);
  }
}

TEST(Deformer, WithoutStrainClearsWhatAnotherWrote) {
  FormSettings with_strain;
  with_strain.common.strain = true;
  Stage stage(lab::backMesh(2962), with_strain);
  const Contact contact = press(stage.mesh, 1000, 6.0);
  stage.apply({contact});
  const auto strain_before = stage.surface.strain();
  ASSERT_TRUE(std::any_of(strain_before.begin(), strain_before.end(), [](float strain) { return strain != 0.0f; }));
  Deformer(stage.skin, Settings{}).apply({&contact, 1}, stage.surface);
  for (const float strain : stage.surface.strain()) ASSERT_EQ(strain, 0.0f);
}

// Minus zero is a coordinate too: adding a displacement of zero would turn it into plus zero.
TEST(Deformer, RestKeepsTheSignOfZero) {
  auto mesh = zoo::grid(20, 200.0);
  for (Vec3& p : mesh.positions) p.z() = -0.0;
  Stage stage(mesh);
  const auto rest = bits(stage.surface);
  stage.apply({press(stage.mesh, 400, 5.0)});
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    if (stage.surface.displacementAt(v).isZero(0.0f)) {
      ASSERT_TRUE(std::signbit(stage.surface.positionAt(v).z()));
    }
  }
  stage.apply({});
  EXPECT_EQ(bits(stage.surface), rest);
}

TEST(Deformer, ResultDoesNotDependOnTheOrderOfVertices) {
  const auto mesh = test::torso();
  const auto n = static_cast<Index>(mesh.positions.size());
  auto backwards = mesh;
  std::reverse(backwards.positions.begin(), backwards.positions.end());
  for (Triangle& t : backwards.triangles) t = {n - 1 - t[0], n - 1 - t[1], n - 1 - t[2]};
  Stage a(mesh);
  Stage b(backwards);
  Random random(29);
  for (int i = 0; i < 20; ++i) {
    const std::vector<Contact> contacts{anyContact(mesh, random), anyContact(mesh, random)};
    a.apply(contacts);
    b.apply(contacts);
    for (Index v = 0; v < n; ++v) {
      ASSERT_EQ(a.surface.positionAt(v), b.surface.positionAt(n - 1 - v));
      ASSERT_EQ(a.surface.displacementAt(v), b.surface.displacementAt(n - 1 - v));
    }
  }
}

// A torso pressed on its back with an ellipse as wide as itself: seen along the normal, its belly lies in the ellipse.
TEST(Deformer, FarSideOfAClosedBodyNeverMoves) {
  Stage stage(test::torso(5));
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(0, 1, 0.3), Vec3(-1, 0.2, 0)}) {
    const Vec3 place = direction.normalized().cwiseProduct(Vec3(160, 280, 100));
    Contact contact = press(stage.mesh, triangleNear(stage.mesh, place), 10.0);
    contact.tangential_region = maps::liftedOntoSurface({179.0, 1.0 / 1.134, 1.57}, contact.normal);
    contact = drag(contact, {9, 9, 9});
    const Report report = stage.apply({contact});
    EXPECT_GT(report.moved_vertices, 100u);
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      const bool far = stage.skin.restNormal(v).cast<double>().dot(contact.normal) <= 0.0;
      if (far) {
        ASSERT_TRUE(stage.surface.displacementAt(v).isZero(0.0f)) << v;
      }
    }
  }
}

double depthAt(const Stage& stage, const Contact& contact, Index vertex) {
  return -stage.surface.displacementAt(vertex).cast<double>().dot(contact.normal.normalized());
}

TEST(Deformer, TwoFingersEachHoldTheirDepth) {
  Stage stage(lab::backMesh(41582));
  for (const double distance : {20.0, 30.0, 45.0, 80.0}) {
    std::vector<Contact> contacts;
    std::vector<Index> vertices;
    for (const double side : {-0.5, 0.5}) {
      const Index triangle = triangleNear(stage.mesh, {175 + 40 + side * distance, 200, 100});
      contacts.push_back(press(stage.mesh, triangle, side < 0 ? 8.0 : 6.0, Vec3(1, 0, 0)));
      contacts.back().normal_region = normalRegion(contacts.back().normal, 8.0, {});
      vertices.push_back(stage.mesh.triangles[triangle][0]);
    }
    stage.apply(contacts);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(depthAt(stage, contacts[i], vertices[i]), contacts[i].depth_mm, 1e-3) << distance;
    }
  }
}

TEST(Deformer, TwoFingersEachHoldTheirDrag) {
  Stage stage(test::goldenGrid());
  const Index left = triangleNear(stage.mesh, {-20, 0, 0});
  const Index right = triangleNear(stage.mesh, {20, 0, 0});
  const std::vector<Contact> contacts{drag(press(stage.mesh, left, 5.0, Vec3(1, 0, 0)), {6, 2, 0}),
                                      drag(press(stage.mesh, right, 5.0, Vec3(1, 0, 0)), {3, -4, 0})};
  stage.apply(contacts);
  for (const Contact& contact : contacts) {
    const Vec3f moved = stage.surface.displacementAt(stage.mesh.triangles[contact.anchor_triangle][0]);
    EXPECT_LT((moved.cast<double>() - contact.drag_mm + 5.0 * Vec3::UnitZ()).norm(), 1e-4);
  }
}

// Fingers on both sides of a thin plate do not feel each other's dent.
TEST(Deformer, PinchingAPlateDentsBothSides) {
  Stage stage(zoo::plate(50.0, 2.0));
  std::vector<Contact> contacts;
  for (const double z : {2.0, 0.0}) {
    contacts.push_back(press(stage.mesh, triangleNear(stage.mesh, {25, 25, z}), 0.9, Vec3(1, 0, 0)));
  }
  ASSERT_LT(contacts[0].normal.dot(contacts[1].normal), -0.99);
  stage.apply(contacts);
  for (const Contact& contact : contacts) {
    EXPECT_NEAR(depthAt(stage, contact, stage.mesh.triangles[contact.anchor_triangle][0]), 0.9, 1e-4);
  }
}

TEST(Deformer, OneDegenerateEllipseLeavesTheOtherPartWorking) {
  Stage stage(lab::backMesh(2962));
  Contact contact = drag(press(stage.mesh, 1000, 5.0), {4, 0, 0});
  contact.normal_region.half_major.setZero();
  const Report report = stage.apply({contact});
  EXPECT_EQ(report.status, kDegenerateRegion);
  EXPECT_GT(report.moved_vertices, 10u);
}

TEST(Deformer, CoarseMeshMovesTheCornersThatLieInside) {
  Stage stage(zoo::oneTriangle());
  const Report at_corner = stage.apply({press(stage.mesh, 0, 5.0, Vec3(1, 0, 0))});
  EXPECT_GE(at_corner.moved_vertices, 1u);
  EXPECT_NEAR(stage.surface.displacementAt(stage.mesh.triangles[0][0]).z(), -5.0f, 1e-5f);
  Contact small = press(stage.mesh, 0, 5.0);
  small.normal_region.half_major *= 0.001;
  EXPECT_EQ(stage.apply({small}).status, kNoVertexInRegion);
}

TEST(Deformer, OneCallDoesTheSameAsTheParts) {
  Stage stage(lab::backMesh(2962));
  const std::vector<Contact> contacts{press(stage.mesh, 700, 5.0), drag(press(stage.mesh, 1500, 8.0), {5, 5, 0})};
  stage.apply(contacts);
  EXPECT_EQ(bits(deformed(stage.mesh, contacts)), bits(stage.surface));
}

}  // namespace palpate::deform
