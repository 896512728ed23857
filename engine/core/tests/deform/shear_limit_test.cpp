// Skin follows the finger as skin: what is near only through the air stays, nothing tears, no triangle turns over.
#include "palpate/deform/shear_limit.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/tests/deform/folded_shapes.h"
#include "core/tests/deform/stage.h"
#include "lab/judges/deform_check.h"
#include "palpate/mesh/reorder.h"
#include "support/counted.h"

namespace palpate::deform {

using test::bits;
using test::drag;
using test::press;
using test::Stage;
using test::triangleNear;

/// Both ways to displace, as they come.
std::vector<Way> bothWays() { return {Way::chosen, Way::general}; }

/// A press of 10 mm and a drag of 20 mm, in regions as the engine has them.
Contact deepest(Contact contact, const Vec3& along) {
  contact.normal_region = normalRegion(contact.normal, contact.depth_mm, {});
  contact = drag(contact, along);
  const double length = contact.drag_mm.norm();
  if (length > 0.0) contact.drag_mm *= 20.0 / length;
  return contact;
}

lab::DeformReport judged(const Stage& stage, const std::vector<Contact>& contacts) {
  std::vector<Vec3f> places;
  for (Index v = 0; v < stage.skin.vertices; ++v) places.push_back(stage.surface.positionAt(v));
  std::vector<lab::TouchedPlace> touched;
  for (const Contact& c : contacts) {
    const double press_reach = c.depth_mm > 0.0 ? c.normal_region.half_major.norm() : 0.0;
    const double drag_reach = c.drag_mm.isZero() ? 0.0 : c.tangential_region.half_major.norm();
    touched.push_back({c.anchor, c.anchor_triangle, c.normal, 2.0 * std::max(press_reach, drag_reach)});
  }
  return lab::checkDeformation(stage.mesh, places, touched);
}

void expectSound(const Stage& stage, const std::vector<Contact>& contacts, const std::string& name) {
  const lab::DeformReport report = judged(stage, contacts);
  EXPECT_GT(report.moved, 0u) << name;
  EXPECT_EQ(report.unconnected, 0u) << name;
  EXPECT_EQ(report.off_plane, 0u) << name;
  EXPECT_EQ(report.turned, 0u) << name;
}

/// How far the farthest vertex moves among those that `where` names.
double farthestMove(const Stage& stage, const std::function<bool(const Vec3&)>& where) {
  double farthest = 0.0;
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    if (where(stage.mesh.positions[v])) farthest = std::max(farthest, stage.moved(v).norm());
  }
  return farthest;
}

// ---- what stays ---------------------------------------------------------------------------------------------------

TEST(ShearLimit, TheOtherFingerStays) {
  for (const Way way : bothWays()) {
    Stage stage(test::twoFingers(), {}, way);
    const Contact contact = press(stage.mesh, triangleNear(stage.mesh, {-9.5, 60, 8}), 10.0);
    for (const Contact& c : {deepest(contact, Vec3::Zero()), deepest(contact, {0, 1, 0})}) {
      stage.apply({c});
      expectSound(stage, {c}, "two fingers");
      EXPECT_GT(farthestMove(stage, [](const Vec3& p) { return p.x() < 0.0; }), 4.0);
      EXPECT_EQ(farthestMove(stage, [](const Vec3& p) { return p.x() > 0.0; }), 0.0);
    }
  }
}

// Around the end of the gap the far bank is 50 mm away, through the air 8 mm.
TEST(ShearLimit, TheOtherToeStaysThoughItsRootIsNear) {
  for (const Way way : bothWays()) {
    Stage stage(test::twoToes(), {}, way);
    const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {-5, 20, 0}), 10.0), Vec3::Zero());
    stage.apply({contact});
    expectSound(stage, {contact}, "two toes");
    const auto bank = [](const Vec3& p) { return p.x() > 2.5 && p.y() > 15.0; };
    EXPECT_LT(farthestMove(stage, bank), 0.5);
    Stage formulae(stage.mesh, test::formulaeAlone(), way);
    formulae.apply({contact});
    EXPECT_GT(farthestMove(formulae, bank), 2.0) << "the case shows nothing";
  }
}

// The input that showed it: two fingers on either side of a gap shared one room, and each dented the other's bank.
TEST(ShearLimit, TwoFingersDoNotDentEachOthersBank) {
  for (const Way way : bothWays()) {
    auto mesh = test::twoToes();
    mesh::reorderSpatially(mesh);
    std::vector<Contact> contacts;
    for (const double x : {-5.0, 5.0}) {
      contacts.push_back(deepest(press(mesh, triangleNear(mesh, {x, 20, 0}), 5.0), Vec3::Zero()));
    }
    Stage both(mesh, {}, way);
    both.apply(contacts);
    expectSound(both, contacts, "both banks");
    Stage left(mesh, {}, way);
    Stage right(mesh, {}, way);
    left.apply({contacts[0]});
    right.apply({contacts[1]});
    for (Index v = 0; v < both.skin.vertices; ++v) {
      EXPECT_LE(both.moved(v).norm(), left.moved(v).norm() + right.moved(v).norm() + 0.05);
    }
  }
}

/// How much farther apart the ends of an edge have moved, per mm of it; the most of all edges.
double widestParting(const Stage& stage) {
  double widest = 0.0;
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    for (const Index w : stage.skin.neighbours[v]) {
      const double length = (stage.mesh.positions[v] - stage.mesh.positions[w]).norm();
      widest = std::max(widest, (stage.moved(v) - stage.moved(w)).norm() / length);
    }
  }
  return widest;
}

// The input that showed it: two fingers in the banks of a gap on a scanned hand. Where the banks meet, vertices 1.5 mm
// from each other moved 10 mm apart: a spike.
TEST(ShearLimit, NoSpikeStandsUpWhereFingersPressTheBanksOfAGap) {
  const mesh::TriangleMesh groove = test::makeSheet(80, 40, [](double s, double t) {
    const double along = 60.0 * (s - 0.5);
    return Vec3(0.4 * along, 80.0 * t, 0.9 * std::abs(along));
  });
  for (const Way way : bothWays()) {
    std::vector<Contact> contacts;
    for (const double x : {-3.0, 3.0}) {
      contacts.push_back(deepest(press(groove, triangleNear(groove, {x, 40, 7}), 8.0), Vec3::Zero()));
    }
    Stage stage(groove, {}, way);
    stage.apply(contacts);
    expectSound(stage, contacts, "both banks of a groove");
    EXPECT_LE(widestParting(stage), 1.001 * ShearLimit::kMaxParting);
    EXPECT_GT(farthestMove(stage, [](const Vec3&) { return true; }), 4.0) << "and yet dented";
    Stage formulae(groove, test::formulaeAlone(), way);
    formulae.apply(contacts);
    EXPECT_GT(widestParting(formulae), 3.0) << "the case shows nothing";
  }
}

// A plate that is thinner than the press: the thickness is said, not found (tree/triangle_tree.h finds it).
TEST(ShearLimit, ADentGoesInByAtMostNineTenthsOfAThinPart) {
  for (const Way way : bothWays()) {
    Stage stage(test::makeSheet(60, 60, [](double s, double t) { return Vec3(60 * s, 60 * t, 0); }), {}, way);
    setThickness(std::vector<float>(stage.skin.vertices, 4.0f), stage.skin);
    const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {30, 30, 0}), 10.0), Vec3::Zero());
    EXPECT_GT(stage.apply({contact}).held_vertices, 10u);
    expectSound(stage, {contact}, "thin");
    EXPECT_NEAR(farthestMove(stage, [](const Vec3&) { return true; }), 3.6, 1e-4);
    setThickness(std::vector<float>(stage.skin.vertices, 20.0f), stage.skin);
    EXPECT_EQ(stage.apply({contact}).held_vertices, 0u);
  }
}

// The input that showed it: a press on a back dented the arm that rose out of it, 200 mm along the normal.
TEST(ShearLimit, TheArmAlongTheNormalStays) {
  for (const Way way : bothWays()) {
    Stage stage(test::ramp(), {}, way);
    const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {0, 0, 0}), 10.0), Vec3::Zero());
    const double reach = contact.normal_region.half_major.norm();
    stage.apply({contact});
    expectSound(stage, {contact}, "ramp");
    EXPECT_GT(farthestMove(stage, [&](const Vec3& p) { return p.z() < reach; }), 7.0);
    EXPECT_EQ(farthestMove(stage, [&](const Vec3& p) { return p.z() >= 2.0 * reach + 1e-3; }), 0.0);
  }
}

// The input that showed it: a shelf 55 mm up lay in the ellipse of the drag, and was pressed although the press ends at
// 51 mm.
TEST(ShearLimit, AShelfAboveThePressIsOnlyDragged) {
  auto mesh = test::ramp(55.0);
  mesh::reorderSpatially(mesh);
  for (const Way way : bothWays()) {
    Stage stage(mesh, {}, way);
    const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {0, 0, 0}), 10.0), {0, 1, 0});
    const double press_ends = 2.0 * contact.normal_region.half_major.norm();
    ASSERT_LT(press_ends, 54.0);
    stage.apply({contact});
    double dragged = 0.0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      if (stage.mesh.positions[v].z() < 54.0) continue;
      EXPECT_NEAR(stage.moved(v).dot(contact.normal), 0.0, 1e-5);
      dragged = std::max(dragged, stage.moved(v).norm());
    }
    EXPECT_GT(dragged, 0.1) << "the case shows nothing";
  }
}

TEST(ShearLimit, EachOfSeveralFingersHasItsOwnRegion) {
  Stage stage(test::twoFingers());
  std::vector<Contact> contacts;
  for (const double x : {-9.5, 9.5}) {
    contacts.push_back(deepest(press(stage.mesh, triangleNear(stage.mesh, {x, 60, 8}), 10.0), Vec3(0, x, 0)));
  }
  stage.apply(contacts);
  expectSound(stage, contacts, "both fingers");
  for (const double side : {-1.0, 1.0}) {
    EXPECT_GT(farthestMove(stage, [&](const Vec3& p) { return side * p.x() > 0.0; }), 4.0);
  }
}

// ---- what moves with it -------------------------------------------------------------------------------------------

// Beside skin that faces away displacement rises by 0.6 mm per mm and no more.
TEST(ShearLimit, TapersBesideSkinThatStays) {
  Stage stage(test::twoFingers());
  const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {-9.5, 60, 8}), 10.0), {0, 1, 0});
  const Report report = stage.apply({contact});
  EXPECT_GT(report.held_vertices, 0u);
  EXPECT_LE(report.held_vertices, report.moved_vertices);
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    if (!stage.moved(v).isZero(0.0)) continue;
    for (const Index w : stage.skin.neighbours[v]) {
      const double edge = (stage.skin.restPosition(v) - stage.skin.restPosition(w)).norm();
      EXPECT_LE(stage.moved(w).norm(), 0.6 * edge + 1e-4);
    }
  }
}

/// What the deformer says of contacts as a hand makes them is what the formulae say, to the last bit.
void expectUnheld(const mesh::TriangleMesh& mesh, const std::vector<Vec3>& places, Way way) {
  Stage held(mesh, {}, way);
  Stage free(mesh, test::formulaeAlone(), way);
  for (const Vec3& place : places) {
    for (const double depth : {2.0, 6.0, 10.0}) {
      const Contact pressed = press(mesh, triangleNear(mesh, place), depth);
      for (const Contact& contact : {pressed, drag(pressed, {12, 5, 0})}) {
        EXPECT_EQ(held.apply({contact}).held_vertices, 0u);
        free.apply({contact});
        EXPECT_EQ(bits(held.surface), bits(free.surface));
      }
    }
  }
}

TEST(ShearLimit, LeavesSmoothBodiesAsTheyWere) {
  for (const Way way : bothWays()) {
    expectUnheld(lab::backMesh(8163), {{175, 200, 90}, {120, 150, 80}, {200, 260, 80}}, way);
    expectUnheld(test::torso(5), {{0, 0, 100}, {40, 90, 90}, {0, 0, -100}, {-60, -100, 80}}, way);
  }
}

TEST(ShearLimit, FormulaeAloneAndLiteralReadingsAreNotHeld) {
  EXPECT_TRUE(limitsShear({}));
  EXPECT_FALSE(limitsShear(test::formulaeAlone()));
  EXPECT_FALSE(limitsShear(test::literally({Erratum::E23_region_search})));
  FormSettings all;
  all.fidelity = literalFidelity();
  EXPECT_FALSE(limitsShear(all));
  Stage printed(test::twoFingers(), all);
  Stage formulae(test::twoFingers(), test::formulaeAlone());
  const Contact contact = deepest(press(printed.mesh, triangleNear(printed.mesh, {-9.5, 60, 8}), 10.0), {1, 0, 0});
  EXPECT_EQ(printed.apply({contact}).held_vertices, 0u);
  EXPECT_EQ(formulae.apply({contact}).held_vertices, 0u);
  EXPECT_GT(judged(formulae, {contact}).turned, 0u) << "the case shows nothing";
}

// ---- no triangle turns over ---------------------------------------------------------------------------------------

TEST(ShearLimit, NothingFoldsOnARidgeHoweverFine) {
  for (const double cell : {0.7, 2.0, 9.0}) {
    for (const Way way : bothWays()) {
      Stage stage(test::ridge(cell), {}, way);
      Random random(3);
      for (int i = 0; i < 12; ++i) {
        const Vec3 place(random.uniform(-15, 15), random.uniform(-20, 20), 0.0);
        const Contact pressed = press(stage.mesh, triangleNear(stage.mesh, place), 10.0);
        const Contact contact = deepest(pressed, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
        stage.apply({contact});
        expectSound(stage, {contact}, "ridge of " + std::to_string(cell));
      }
    }
  }
}

// 20 mm along a half axis of 15: flat skin would turn over.
TEST(ShearLimit, ALongDragInANarrowRegionIsShortened) {
  for (const Way way : bothWays()) {
    Stage stage(zoo::grid(100, 100.0), {}, way);
    Contact contact = press(stage.mesh, triangleNear(stage.mesh, {50, 50, 0}), 0.0);
    contact.tangential_region = maps::liftedOntoSurface({15.0, 1.0}, contact.normal);
    contact = deepest(contact, {1, 0, 0});
    stage.apply({contact});
    expectSound(stage, {contact}, "narrow drag");
    const double most = farthestMove(stage, [](const Vec3&) { return true; });
    EXPECT_GT(most, 6.0);
    EXPECT_LT(most, 7.1);
  }
}

// Two fingers that push the skin between them together: some triangles on a coarse mesh, thousands on a fine one, where
// the whole displacement is shortened.
TEST(ShearLimit, FingersThatMeetDoNotFoldWhatIsBetween) {
  for (const int cells : {100, 400}) {
    Stage stage(zoo::grid(cells, 200.0));
    std::vector<Contact> contacts;
    for (const double side : {-1.0, 1.0}) {
      Contact contact = press(stage.mesh, triangleNear(stage.mesh, {100 + 22 * side, 100, 0}), 6.0);
      contact.tangential_region = maps::liftedOntoSurface({50.0, 1.0}, contact.normal);
      contacts.push_back(deepest(contact, {-side, 0, 0}));
    }
    const Report report = stage.apply(contacts);
    expectSound(stage, contacts, "fingers that meet on " + std::to_string(cells));
    EXPECT_GT(farthestMove(stage, [](const Vec3&) { return true; }), 5.0);
    EXPECT_EQ(report.held_vertices == report.moved_vertices, cells == 400) << report.held_vertices;
  }
}

/// Vertices in the plane shifted by shares of an edge, some triangles thin: what scanned skin looks like.
mesh::TriangleMesh shakenGrid(Random& random) {
  auto mesh = zoo::grid(50, 100.0);
  for (Vec3& p : mesh.positions) {
    p += Vec3(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6));
  }
  return mesh;
}

TEST(ShearLimit, ThinTrianglesDoNotTurnOver) {
  Random random(9);
  Index held = 0;
  for (int i = 0; i < 10; ++i) {
    Stage stage(shakenGrid(random));
    const Contact pressed = press(stage.mesh, triangleNear(stage.mesh, {50, 50, 0}), 10.0);
    const Contact contact = deepest(pressed, {random.uniform(-1, 1), random.uniform(-1, 1), 0});
    held += stage.apply({contact}).held_vertices;
    expectSound(stage, {contact}, "shaken " + std::to_string(i));
  }
  EXPECT_GT(held, 0u) << "the case shows nothing";
}

// PALPATE_HEAVY=1: a hundred bodies instead of ten.
TEST(ShearLimit, RandomPressesAndDragsOnRandomBodiesAreSound) {
  const int bodies = std::getenv("PALPATE_HEAVY") == nullptr ? 10 : 100;
  Random random(17);
  for (int body = 0; body < bodies; ++body) {
    auto mesh = test::lumpyBody(random, 3 + static_cast<int>(random.below(3)));
    mesh::reorderSpatially(mesh);
    Stage stage(mesh, {}, body % 3 == 0 ? Way::general : Way::chosen);
    const auto rest = bits(stage.surface);
    for (int i = 0; i < 20; ++i) {
      std::vector<Contact> contacts;
      for (std::uint64_t n = 1 + random.below(2); n > 0; --n) {
        const auto triangle = static_cast<Index>(random.below(mesh.triangles.size()));
        const Contact pressed = press(mesh, triangle, i % 3 == 0 ? 0.0 : 10.0);
        const Vec3 along = random.uniform3(-1, 1);
        contacts.push_back(deepest(pressed, i % 3 == 1 ? Vec3(Vec3::Zero()) : along));
      }
      if (stage.apply(contacts).moved_vertices == 0) continue;
      const lab::DeformReport report = judged(stage, contacts);
      EXPECT_TRUE(report.isSound()) << body << " " << i << ": " << report.unconnected << " unconnected, "
                                    << report.off_plane << " off the plane, " << report.turned << " turned";
    }
    stage.apply({});
    EXPECT_EQ(bits(stage.surface), rest);
  }
}

// Held, drawn together or left alone: what came before leaves no trace.
TEST(ShearLimit, DoesNotDependOnWhatWasHeldBefore) {
  Random random(31);
  for (const Way way : bothWays()) {
    auto mesh = test::lumpyBody(random, 4);
    mesh::reorderSpatially(mesh);
    Stage used(mesh, {}, way);
    Index held = 0;
    for (int i = 0; i < 12; ++i) {
      std::vector<Contact> contacts;
      for (int n = 0; n <= i % 3; ++n) {
        const auto triangle = static_cast<Index>(random.below(mesh.triangles.size()));
        const Vec3 along = random.uniform3(-1, 1);
        contacts.push_back(deepest(press(mesh, triangle, 10.0), along));
      }
      held += used.apply(contacts).held_vertices;
      Stage fresh(mesh, {}, way);
      fresh.apply(contacts);
      EXPECT_EQ(bits(used.surface), bits(fresh.surface)) << i;
    }
    EXPECT_GT(held, 0u) << "the case shows nothing";
  }
}

TEST(ShearLimit, HoldsWithoutAllocating) {
  for (const Way way : bothWays()) {
    Stage stage(test::twoToes(), {}, way);
    std::vector<Contact> contacts;
    for (const double x : {-4.0, 6.0}) {
      contacts.push_back(deepest(press(stage.mesh, triangleNear(stage.mesh, {x, 15, 0}), 10.0), {0, 1, 0}));
    }
    Report report;
    support::expectNoAllocation([&] { report = stage.apply(contacts); });
    EXPECT_GT(report.held_vertices, 0u);
    expectSound(stage, contacts, "two contacts on toes");
  }
}

// The vertices of what was held have the normals of their triangles.
TEST(ShearLimit, HeldSkinHasTheNormalsOfItsTriangles) {
  Stage stage(test::twoFingers());
  const Contact contact = deepest(press(stage.mesh, triangleNear(stage.mesh, {-9.5, 60, 8}), 10.0), {0, 1, 0});
  stage.apply({contact});
  const PositionStreams places{stage.surface.position(0).data(), stage.surface.position(1).data(),
                               stage.surface.position(2).data()};
  double worst = 1.0;
  for (Index v = 0; v < stage.skin.vertices; ++v) {
    if (stage.moved(v).isZero(0.0)) continue;
    worst = std::min<double>(worst, stage.surface.normalAt(v).dot(areaWeightedNormal(stage.skin, places, v)));
  }
  EXPECT_GT(worst, 0.95);
}

}  // namespace palpate::deform
