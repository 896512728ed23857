// Contacts that bring the curves of layered tissue: both ways to displace against the formulae, against each other, and
// against what may not happen.
#include <gtest/gtest.h>

#include "core/tests/deform/scalar_reference.h"
#include "core/tests/deform/stage.h"

namespace palpate::deform {
namespace {

using test::bonyShape;
using test::layered;
using test::Stage;

/// What the formulae say of a place on a plane through the anchor, away from any hold.
Vec3 expectedOnPlane(const Contact& contact, const Vec3& place) {
  const Vec3 n = contact.normal.normalized();
  const LayeredShape& shape = *contact.layered;
  const Vec3 offset = place - contact.anchor;
  const double q = offset.norm() / shape.press.radius_mm;
  const auto press = [&](const tissue::LayeredCurve& curve) {
    return tissue::curveAt(curve, tissue::kPressBend, q * q).value;
  };
  const Vec3 major = contact.tangential_region.half_major;
  const double a = major.norm();
  const double s = major.dot(offset) / (a * a);
  const double t = n.cross(major / a).dot(offset) / (a * contact.tangential_region.aspect);
  const double share = tissue::curveAt(shape.drag, tissue::kDragBend, s * s + t * t).value;
  return -contact.depth_mm * press(shape.press.down) * n +
         contact.depth_mm * press(shape.press.outward) / shape.press.radius_mm * offset + share * contact.drag_mm;
}

mesh::TriangleMesh plate() { return zoo::grid(120, 240.0); }

Contact onPlate(const mesh::TriangleMesh& mesh, double depth_mm) {
  return layered(test::press(mesh, test::triangleNear(mesh, {118.0, 121.0, 0.0}), depth_mm));
}

TEST(LayeredTissue, MovesEveryVertexByItsCurvesBothWays) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage stage(plate(), {}, way);
    const Contact contact = test::drag(onPlate(stage.mesh, 7.0), {6.0, -3.0, 0.0});
    stage.apply({contact});
    double worst = 0.0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      worst = std::max(worst, (stage.moved(v) - expectedOnPlane(contact, test::restPoint(stage.skin, v))).norm());
    }
    EXPECT_LT(worst, 2e-5) << (way == Way::general);
  }
}

/// A press whose region follows the anatomy is an ellipse.
Contact bent(Contact contact) {
  contact.normal_region = {contact.layered->press.radius_mm * Vec3(0.9, 0.5, 0.0), 0.7};
  return contact;
}

TEST(LayeredTissue, AnEllipticPressMovesOutwardAcrossItsContours) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage stage(plate(), {}, way);
    const Contact contact = bent(onPlate(stage.mesh, 7.0));
    stage.apply({contact});
    const Vec3 major = contact.normal_region.half_major;
    const double a = major.norm();
    const double b = a * contact.normal_region.aspect;
    const Vec3 along = major / a;
    const Vec3 across = Vec3::UnitZ().cross(along);
    double worst = 0.0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      const Vec3 offset = test::restPoint(stage.skin, v) - contact.anchor;
      const double s = along.dot(offset) / a;
      const double t = across.dot(offset) / b;
      const auto press = [&](const tissue::LayeredCurve& curve) {
        return tissue::curveAt(curve, tissue::kPressBend, s * s + t * t).value;
      };
      const Vec3 expected = -7.0 * press(contact.layered->press.down) * Vec3::UnitZ() +
                            7.0 * b * press(contact.layered->press.outward) * (s / a * along + t / b * across);
      worst = std::max(worst, (stage.moved(v) - expected).norm());
    }
    EXPECT_LT(worst, 2e-5) << (way == Way::general);
  }
}

TEST(LayeredTissue, HasABulgeAndAPullThatTheHalfGaussianHasNot) {
  Stage stage(plate());
  const Contact contact = onPlate(stage.mesh, 8.0);
  stage.apply({contact});
  double highest = 0.0;
  double farthest = 0.0;
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    const Vec3 moved = stage.moved(v);
    highest = std::max(highest, moved.dot(contact.normal));
    farthest = std::max(farthest, (moved - moved.dot(contact.normal) * contact.normal).norm());
  }
  EXPECT_GT(highest, 0.3);
  EXPECT_NEAR(farthest, 0.8, 0.1);
}

TEST(LayeredTissue, BothWaysAgreeOnBodiesHeightsAndNormals) {
  const mesh::TriangleMesh mesh = test::torso();
  Stage fast(mesh);
  Stage general(mesh, {}, Way::general);
  Random random(11);
  double worst_place = 0.0;
  double worst_normal = 0.0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Contact> contacts;
    for (int k = 0; k <= i % 3; ++k) {
      Contact contact = test::anyContact(mesh, random);
      contact.depth_mm = random.uniform(0.5, 9.0);
      contacts.push_back(k == 1 ? contact : k == 0 ? layered(contact) : bent(layered(contact)));
    }
    fast.apply(contacts);
    general.apply(contacts);
    for (Index v = 0; v < fast.skin.vertices; ++v) {
      worst_place = std::max(worst_place, (fast.moved(v) - general.moved(v)).norm());
      const Vec3 difference = (fast.surface.normalAt(v) - general.surface.normalAt(v)).cast<double>();
      worst_normal = std::max(worst_normal, difference.norm());
    }
  }
  EXPECT_LT(worst_place, 2e-3);
  EXPECT_LT(worst_normal, 2e-3);
}

TEST(LayeredTissue, TheAnalyticNormalIsThatOfTheMovedSkin) {
  FormSettings recomputed;
  recomputed.common.normals = Normals::recomputed;
  Stage analytic(zoo::grid(240, 240.0));
  Stage triangles(analytic.mesh, recomputed);
  const Contact round = test::drag(onPlate(analytic.mesh, 6.0), {4.0, 2.0, 0.0});
  for (const Contact& contact : {round, bent(round)}) {
    analytic.apply({contact});
    triangles.apply({contact});
    double worst = 0.0;
    for (Index v = 0; v < analytic.skin.vertices; ++v) {
      worst = std::max(worst, (analytic.surface.normalAt(v) - triangles.surface.normalAt(v)).norm() * 1.0);
    }
    EXPECT_LT(worst, 0.04) << "a millimetre's grid against the smooth surface";
  }
}

TEST(LayeredTissue, TheSkinUnderTheFingerFollowsTheTip) {
  Stage stage(plate());
  const Index triangle = test::triangleNear(stage.mesh, {118.0, 121.0, 0.0});
  const Contact contact = test::drag(layered(test::press(stage.mesh, triangle, 6.0, Vec3(1, 0, 0))), {4, 3, 0});
  stage.apply({contact});
  const Vec3 tip = contact.anchor + contact.drag_mm - contact.depth_mm * contact.normal;
  EXPECT_LT((stage.surface.positionAt(stage.mesh.triangles[triangle][0]).cast<double>() - tip).norm(), 1e-4);
}

TEST(LayeredTissue, TwoFingersEachGetTheirDepth) {
  Stage stage(plate());
  std::vector<Contact> contacts;
  for (const double x : {100.0, 118.0}) {
    const Index triangle = test::triangleNear(stage.mesh, {x, 120.0, 0.0});
    contacts.push_back(layered(test::press(stage.mesh, triangle, 5.0, Vec3(1, 0, 0))));
  }
  stage.apply(contacts);
  for (const Contact& contact : contacts) {
    const Index vertex = stage.mesh.triangles[contact.anchor_triangle][0];
    EXPECT_NEAR(-stage.moved(vertex).dot(contact.normal), 5.0, 1e-3);
  }
}

TEST(LayeredTissue, NoTriangleTurnsOverOnAnyBody) {
  Random random(3);
  const mesh::TriangleMesh mesh = lab::backMesh(8163);
  Stage stage(mesh);
  for (int i = 0; i < 40; ++i) {
    Contact contact = layered(test::anyContact(mesh, random));
    contact.depth_mm = random.uniform(2.0, 10.0);
    stage.apply({contact});
    int turned = 0;
    for (const Triangle& t : mesh.triangles) {
      const auto at = [&](Index v) { return Vec3(stage.surface.positionAt(v).cast<double>()); };
      const Vec3 rest = mesh::areaVector2(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
      turned += mesh::areaVector2(at(t[0]), at(t[1]), at(t[2])).dot(rest) <= 0.0 ? 1 : 0;
    }
    EXPECT_EQ(turned, 0) << i;
  }
}

}  // namespace
}  // namespace palpate::deform
